#pragma once
/// Turning points of a free vibration with viscous damping and Coulomb friction.
///
/// m x'' + c x' + k x + F0 sgn(x') = 0, released from rest: the magnitudes of successive extremes obey
///   X_(n+1) = R X_n - x_f (1 + R),   R = exp(-pi zeta/sqrt(1 - zeta^2)),   x_f = F0/k
///   X_n = (X_0 + kappa) R^n - kappa,   kappa = x_f (1 + R)/(1 - R)
/// and X_n = X_0 - 2 n x_f for zeta = 0.
///
/// Holds for 0 <= zeta < 1 while X_n > x_f. At a smaller extreme the spring does not overcome the friction (static
/// friction equal to kinetic) and the mass stays. The last extreme may lie on the side from which the mass came:
/// X_n < 0.
/// Source: feeny1996decrement, liang1998decrement. Cost: one exponential for each extreme.

#include <vector>

namespace dualdamp::sim::analytic {

/// R [-] for a damping ratio 0 <= zeta < 1.
[[nodiscard]] double half_swing_decay(double zeta);

/// X_n [m] by the closed form, even if the mass stops at an earlier extreme.
[[nodiscard]] double decrement_amplitude(double zeta, double x_f, double X_0, int n);

/// Signed extremes [m] after a release from rest at `x_0`: at most `count`, x_0 first; the last one is where the
/// mass stays.
[[nodiscard]] std::vector<double> free_decay_extremes(double zeta, double x_f, double x_0, int count);

}  // namespace dualdamp::sim::analytic
