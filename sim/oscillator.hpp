#pragma once
/// The oscillator:  m x'' + c x' + k x + F = k y(t) + f(t)          (damper to ground, Liang and Feeny)
///                  m x'' + c (x' - y') + k x + F = k y(t) + f(t)   (damper to base, Hundal)
/// with base motion y(t) [m], external force f(t) [N] and friction force F [N]; F > 0 opposes x' > 0.
/// A cubic spring adds k3 (y - x)^3 to k (y - x). For a pendulum G sin(y - x) replaces the part G (y - x) of
/// k (y - x), G = m g l. The equations of an angle x are the same: the units here and everywhere in the engines are
/// those of a displacement (core/coordinate.hpp).

#include <cmath>

#include "core/constants.hpp"
#include "core/coordinate.hpp"

namespace dualdamp::sim {

enum class DamperTo { ground, base };

struct Oscillator {
  double mass = 1.0;       ///< m [kg], > 0
  double stiffness = 1.0;  ///< k [N/m], > 0
  double damping = 0.0;    ///< c [N.s/m], any sign
  DamperTo damper_to = DamperTo::ground;
  double cubic_stiffness = 0.0;                                  ///< k3 [N/m^3] on the elongation y - x, any sign
  double gravity_stiffness = 0.0;                                ///< G [N.m], part of k by gravity, for an angle
  core::Coordinate coordinate = core::Coordinate::displacement;  ///< only for the units in messages
  double loss_factor = 0.0;  ///< eta >= 0, stiffness k (1 + i eta); steady vibrations only
};

/// The spring follows Hooke's law.
[[nodiscard]] inline bool is_linear(const Oscillator& o) {
  return o.cubic_stiffness == 0.0 && o.gravity_stiffness == 0.0;
}

/// Force of the spring [N] over its elongation, y - x [m].
[[nodiscard]] inline double spring_force(const Oscillator& o, double stretch) {
  const double force = (o.stiffness + o.cubic_stiffness * stretch * stretch) * stretch;
  return o.gravity_stiffness == 0.0 ? force : force + o.gravity_stiffness * (std::sin(stretch) - stretch);
}

/// Derivative of the spring force by the elongation [N/m].
[[nodiscard]] inline double spring_slope(const Oscillator& o, double stretch) {
  const double slope = o.stiffness + 3.0 * o.cubic_stiffness * stretch * stretch;
  return o.gravity_stiffness == 0.0 ? slope : slope + o.gravity_stiffness * (std::cos(stretch) - 1.0);
}

/// Energy stored in the spring [J].
[[nodiscard]] inline double spring_energy(const Oscillator& o, double stretch) {
  const double square = stretch * stretch;
  const double energy = 0.5 * (o.stiffness + 0.5 * o.cubic_stiffness * square) * square;
  if (o.gravity_stiffness == 0.0) return energy;
  const double half = std::sin(0.5 * stretch);
  return energy + o.gravity_stiffness * (2.0 * half * half - 0.5 * square);
}

/// wn = sqrt(k/m) [rad/s]
[[nodiscard]] inline double natural_frequency(const Oscillator& o) { return std::sqrt(o.stiffness / o.mass); }

/// 2 pi/wn [s]
[[nodiscard]] inline double natural_period(const Oscillator& o) { return core::two_pi / natural_frequency(o); }

/// zeta = c / (2 sqrt(m k)) [-]
[[nodiscard]] inline double damping_ratio(const Oscillator& o) {
  return o.damping / (2.0 * std::sqrt(o.mass * o.stiffness));
}

}  // namespace dualdamp::sim
