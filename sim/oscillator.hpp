#pragma once
/// The oscillator:  m x'' + c x' + k x + F = k y(t) + f(t)          (damper to ground, Liang and Feeny)
///                  m x'' + c (x' - y') + k x + F = k y(t) + f(t)   (damper to base, Hundal)
/// with k3 (y - x)^3 beside k (y - x) for a cubic spring; base motion y(t) [m], external force f(t) [N] and
/// friction force F [N], F > 0 opposing x' > 0.

namespace dualdamp::sim {

enum class DamperTo { ground, base };

struct Oscillator {
  double mass = 1.0;       ///< m [kg], > 0
  double stiffness = 1.0;  ///< k [N/m], > 0
  double damping = 0.0;    ///< c [N.s/m], any sign
  DamperTo damper_to = DamperTo::ground;
  double cubic_stiffness = 0.0;  ///< k3 [N/m^3] on the elongation y - x, any sign
};

/// wn = sqrt(k/m) [rad/s]
[[nodiscard]] double natural_frequency(const Oscillator& oscillator);
/// zeta = c / (2 sqrt(m k)) [-]
[[nodiscard]] double damping_ratio(const Oscillator& oscillator);

}  // namespace dualdamp::sim
