#pragma once
/// The work that every contender does: the standard case in steady state, one forcing period after the other.
///
///   m x'' + c x' + k x + F0 sgn x' = k Y cos(w t),   m = 1 kg, k = 100 N/m, c = 4 N.s/m, F0 = 2 N, w = 10 rad/s, Y
///   = 0.1 m

#include <cmath>

#include "sim/model.hpp"

namespace dualdamp::bench::speed {

struct StandardCase {
  double mass = 1.0;
  double stiffness = 100.0;
  double damping = 4.0;
  double friction = 2.0;
  double frequency = 10.0;
  double base_amplitude = 0.1;
  /// On the orbit at t = 0.
  double start_position = 0.0;
  double start_velocity = 0.0;
};

/// The right side of one interval, per mass, for the general solvers: sgn v is `direction` throughout.
struct IntervalField {
  double damping;
  double stiffness;
  double base;
  double friction;
  double frequency;
  double direction = 0.0;

  explicit IntervalField(const StandardCase& work)
      : damping(work.damping / work.mass),
        stiffness(work.stiffness / work.mass),
        base(work.stiffness * work.base_amplitude / work.mass),
        friction(work.friction / work.mass),
        frequency(work.frequency) {}

  [[nodiscard]] double pull(double x, double t) const { return base * std::cos(frequency * t) - stiffness * x; }
  [[nodiscard]] double acceleration(double x, double v, double t) const {
    return pull(x, t) - damping * v - friction * direction;
  }
  /// Direction of the interval after a reversal at x.
  [[nodiscard]] double direction_after(double x, double t) const;
};

/// Steady amplitude [m] of Den Hartog's closed form, evaluated with 40 digits.
inline constexpr double exact_amplitude = 0.186078097956786198557;

[[nodiscard]] sim::Model model_of(const StandardCase& work);

/// The numbers above with the start filled in from the periodic orbit.
[[nodiscard]] StandardCase standard_case();

}  // namespace dualdamp::bench::speed
