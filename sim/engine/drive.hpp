#pragma once
/// The excitation as the engines use it: phasors that turn with time, and a polynomial that changes from piece to
/// piece (`sim/engine/drive_pieces.hpp`).

#include <array>
#include <memory>
#include <vector>

#include "core/crossing/exponential_basis.hpp"
#include "sim/engine/drive_pieces.hpp"
#include "sim/excitation.hpp"
#include "sim/oscillator.hpp"

namespace dualdamp::sim {

class Drive {
 public:
  Drive(const Oscillator& oscillator, const Excitation& excitation);

  /// Angular frequencies of fundamental and harmonics [rad/s].
  [[nodiscard]] const std::vector<double>& frequencies() const { return frequencies_; }
  /// The forcing period or the duration of the present piece [s], modulo which time is counted; may be infinite.
  [[nodiscard]] double period() const { return period_; }
  /// Time at which period or piece n begins [s].
  [[nodiscard]] double begin_of(long n) const;
  /// Highest power of time in the polynomials.
  [[nodiscard]] int degree() const { return pieces_ == nullptr ? 0 : pieces_->degree(); }

  [[nodiscard]] bool has_pieces() const { return pieces_ != nullptr; }

  /// Sets the drive to time t [s] after the start of a period; a drive with pieces is set to its start.
  void reset(double t);
  /// Sets the drive to time t [s], the end of a period; a drive with pieces stays at the end of the present piece.
  void end_period(double t);
  /// The present piece, counted from 0.
  [[nodiscard]] long piece() const { return piece_; }
  /// Sets the drive to the start of a piece.
  void enter(long piece);
  /// Turns phasor j by exp(i w_j s).
  void turn(std::size_t j, core::Complex rotation) { turns_[j] *= rotation; }
  /// Moves the polynomial on by s.
  void pass(double s);

  /// Phasor j of the drive's force on the mass [N]: k y, with the damper to base also c y', and f.
  [[nodiscard]] core::Complex force_phasor(std::size_t j) const { return force_[j] * turns_[j]; }
  /// Polynomial part of that force now: its derivatives by time [N, N/s, N/s^2, N/s^3].
  [[nodiscard]] const std::array<double, 4>& force_polynomial() const { return force_polynomial_; }
  /// Sum of the moduli of all parts of the force now [N].
  [[nodiscard]] double force_scale() const { return phasor_scale_ + polynomial_scale_; }
  /// Size of the force within `time` [s] from now [N]: a drive may begin at zero.
  [[nodiscard]] double force_size(double time) const;

  /// Phasor j of the base motion [m] or the external force [N] now. offset() is their constant part in this piece.
  [[nodiscard]] core::Complex phasor(std::size_t j) const { return amplitudes_[j] * turns_[j]; }
  [[nodiscard]] double offset() const { return polynomial_[0]; }
  [[nodiscard]] bool moves_base() const { return base_; }

  /// The drive `s` after now; the polynomial is that of the present piece.
  struct Value {
    double y = 0.0;
    double y_rate = 0.0;
    double external = 0.0;
  };
  [[nodiscard]] Value at(double s) const;

 private:
  void set_force();

  std::vector<double> frequencies_;
  std::vector<core::Complex> amplitudes_;  ///< m or N
  std::vector<core::Complex> force_;       ///< N
  std::vector<core::Complex> turns_;
  std::shared_ptr<const DrivePieces> pieces_;
  long piece_ = 0;
  double period_;
  std::array<double, 4> polynomial_{};        ///< derivatives at the start of the piece [m or N, by s^n]
  double piece_time_ = 0.0;                   ///< time since the start of the piece [s]
  std::array<double, 4> force_polynomial_{};  ///< now [N/s^n]
  double polynomial_scale_ = 0.0;             ///< N, sum of the polynomial's parts now
  double phasor_scale_ = 0.0;                 ///< N, sum of the phasors' moduli
  double through_spring_ = 1.0;               ///< force on the mass for each unit of the drive
  double through_damper_ = 0.0;               ///< force on the mass for each unit of the drive's rate
  bool base_ = false;
};

/// The displacement by the drive's force against the spring or the inertia, whichever is less [m].
[[nodiscard]] double driven_displacement(const Oscillator& oscillator, const Excitation& excitation);

}  // namespace dualdamp::sim
