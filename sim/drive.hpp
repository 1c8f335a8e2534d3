#pragma once
/// The excitation as the exact engine sees it: phasors that turn with time, a constant and a ramp.

#include <vector>

#include "core/exponential_basis.hpp"
#include "sim/excitation.hpp"
#include "sim/oscillator.hpp"

namespace dualdamp::sim {

class Drive {
 public:
  Drive(const Oscillator& oscillator, const Excitation& excitation);

  /// Angular frequencies of fundamental and harmonics [rad/s].
  [[nodiscard]] const std::vector<double>& frequencies() const { return frequencies_; }
  /// s; infinite without a harmonic excitation.
  [[nodiscard]] double period() const { return period_; }
  [[nodiscard]] bool ramped() const { return ramp_ != 0.0; }

  /// Sets the drive to time t [s] after the start of a period, or of the ramp.
  void reset(double t);
  /// Turns phasor j by exp(i w_j s).
  void turn(std::size_t j, core::Complex rotation) { turns_[j] *= rotation; }
  /// Moves a ramp on by s.
  void pass(double s) { ramp_time_ += s; }

  /// Force on the mass from base and external force, spring k y and, with the damper to base, c y' [N].
  [[nodiscard]] core::Complex force_phasor(std::size_t j) const { return force_[j] * turns_[j]; }
  [[nodiscard]] double force_constant() const;
  [[nodiscard]] double force_ramp() const { return force_ramp_; }
  /// Sum of moduli of all force parts now [N].
  [[nodiscard]] double force_scale() const;

  /// Phasor j of base [m] or external force [N] now; their constant part is offset(), of the force alone.
  [[nodiscard]] core::Complex phasor(std::size_t j) const { return amplitudes_[j] * turns_[j]; }
  [[nodiscard]] double offset() const { return offset_; }
  [[nodiscard]] bool moves_base() const { return base_; }

  /// The drive `s` after now.
  struct Value {
    double y = 0.0;
    double y_rate = 0.0;
    double external = 0.0;
  };
  [[nodiscard]] Value at(double s) const;

 private:
  std::vector<double> frequencies_;
  std::vector<core::Complex> amplitudes_;  ///< m or N
  std::vector<core::Complex> force_;       ///< N
  std::vector<core::Complex> turns_;
  double period_;
  double offset_ = 0.0;           ///< N
  double ramp_ = 0.0;             ///< m/s or N/s
  double ramp_time_ = 0.0;        ///< s
  double force_ramp_ = 0.0;       ///< N/s
  double force_from_rate_ = 0.0;  ///< N, from c y' of a base ramp
  double steady_scale_ = 0.0;     ///< N, sum of moduli of all parts but the ramp
  bool base_ = false;
};

}  // namespace dualdamp::sim
