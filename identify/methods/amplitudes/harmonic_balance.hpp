#pragma once
/// Harmonic-balance identification: the fundamental of the friction force over speed amplitude, and the friction
/// law that it comes from.
///
///   Phi(V) = k Y sin(phi),   V = w X;   Phi^2 = (k Y)^2 - ((k - m w^2) X)^2 where no phase was measured
///   f(v) = sum_n C_n |v|^n sgn(v)   <=>   Phi(V) = sum_n C_n kappa_n V^n
///   kappa_n = 2/sqrt(pi) Gamma(n/2 + 1)/Gamma(n/2 + 3/2):   4/pi, 1, 8/(3 pi), 3/4 for n = 0 ... 3
///
/// C_0 = F0 and C_1 = c by linear least squares in Phi are the estimate. Terms n = 2 and 3 are added to the curve
/// as long as an F test rejects the curve without them and two degrees of freedom are left. Then no single zeta and
/// F0 describes the data, and the curve `friction_velocity` is the result. The curve also holds the Abel inversion
/// of the measured Phi,
///
///   f(u) = 1/(2 u) d/du int_0^u V^2 Phi(V)/sqrt(u^2 - V^2) dV,
///
/// which needs no basis. It shows the effect of the basis, and the noise of the data.
///
/// The curve Phi at one frequency does not distinguish laws of velocity, position and amplitude: for any Phi there
/// is one of each. Holds in the sense of harmonic balance, without sticking; errors of equal size in Phi. Harmonic
/// balance biases by one or two percent; the method computes its bias from exact states at its own estimate.
/// Uncertainty: least squares, n - 2 degrees of freedom. Source: iourtchenko2002 (the inversion), tomlinson1980.
/// Errors: `outcome`. Cost: about 100 us, most of it for the inversion.

#include <functional>

#include "identify/method.hpp"

namespace dualdamp::identify {

/// kappa_n for n >= 0.
[[nodiscard]] double fundamental_factor(double exponent);

/// f(u) of an odd law of velocity from the fundamental of its force and its derivative, u > 0. Error: that of
/// 30-point Gauss quadrature of sin^3(theta) Phi'(u sin(theta)).
[[nodiscard]] double friction_from_fundamental(const std::function<double(double)>& Phi,
                                               const std::function<double(double)>& Phi_slope, double u);

[[nodiscard]] Estimate harmonic_balance(const Record& record, const KnownConstants& constants);

extern const MethodEntry harmonic_balance_method;

}  // namespace dualdamp::identify
