#pragma once
/// The excitation as the engines see it: phasors that turn with time, a constant and a ramp. A noise is a ramp from
/// node to node: a cell.

#include <optional>
#include <vector>

#include "core/exponential_basis.hpp"
#include "core/random.hpp"
#include "sim/excitation.hpp"
#include "sim/oscillator.hpp"

namespace dualdamp::sim {

class Drive {
 public:
  Drive(const Oscillator& oscillator, const Excitation& excitation);

  /// Angular frequencies of fundamental and harmonics [rad/s].
  [[nodiscard]] const std::vector<double>& frequencies() const { return frequencies_; }
  /// What time is counted modulo [s]: the forcing period, or the cell of a noise; else infinite.
  [[nodiscard]] double period() const { return period_; }
  [[nodiscard]] bool ramped() const { return is_noise() || ramp_ != 0.0; }

  [[nodiscard]] bool is_noise() const { return deviation_.has_value(); }

  /// Sets the drive to time t [s] after the start of a period, or of the ramp; a noise to its start.
  void reset(double t);
  /// The same at the end of a period; a noise stays at the end of its cell.
  void end_period(double t);
  /// Of a noise: the present cell, counted from 0.
  [[nodiscard]] long cell() const { return cell_; }
  /// Sets a noise to the start of a cell.
  void enter(long cell);
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

  /// Phasor j of base [m] or external force [N] now; their constant part is offset().
  [[nodiscard]] core::Complex phasor(std::size_t j) const { return amplitudes_[j] * turns_[j]; }
  [[nodiscard]] double offset() const { return offset_; }
  [[nodiscard]] bool moves_base() const { return base_; }

  /// The drive `s` after now, in the present cell of a noise.
  struct Value {
    double y = 0.0;
    double y_rate = 0.0;
    double external = 0.0;
  };
  [[nodiscard]] Value at(double s) const;

 private:
  void set_force();
  [[nodiscard]] double node(long n) const { return *deviation_ * draws_.normal(static_cast<std::uint64_t>(n)); }

  std::vector<double> frequencies_;
  std::vector<core::Complex> amplitudes_;  ///< m or N
  std::vector<core::Complex> force_;       ///< N
  std::vector<core::Complex> turns_;
  double period_;
  double offset_ = 0.0;          ///< m or N
  double ramp_ = 0.0;            ///< m/s or N/s
  double ramp_time_ = 0.0;       ///< s
  double force_offset_ = 0.0;    ///< N
  double force_ramp_ = 0.0;      ///< N/s
  double phasor_scale_ = 0.0;    ///< N, sum of the phasors' moduli
  double through_spring_ = 1.0;  ///< force on the mass for each unit of the drive
  double through_damper_ = 0.0;  ///< and of its rate
  bool base_ = false;

  std::optional<double> deviation_;  ///< of a noise's nodes [m or N]
  core::RandomStream draws_;
  long cell_ = 0;
};

}  // namespace dualdamp::sim
