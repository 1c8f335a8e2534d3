#pragma once
/// Least-squares resonance method: viscous and Coulomb friction from a straight line x = a + b Y through two or
/// more input-output amplitude pairs at resonance.
///
///   zeta = 1/(2 b),   x_f = -a/G(zeta)                                                Eqs (9), (14), (13)
///
/// with G from the exact Eq (4) at w = wn, or from Eq (15) with `approximate_G`.
///
/// Holds for small zeta near w = wn, without sticking, with errors in x that are independent and of equal size.
/// Errors in Y must be small against the spread of Y, because they lower the slope of the line. Uncertainty:
/// covariance of (a, b) from the scatter about the line with n - 2 degrees of freedom (or from `sigma_x` and
/// `sigma_Y`, when given), propagated to (zeta, F0) by the derivatives of the formulas; intervals by Student's t.
/// For small zeta  std(zeta) = 2 zeta^2 s/sqrt(S_YY)  and  std(F0) = (pi/4)(k s/b) sqrt(1/n + (mean Y +
/// a/b)^2/S_YY). Diagnostics: pairs that stick are left out (and named); an F test of a friction quadratic in x;
/// fits of the lower 4/5, 3/5, 2/5. Source: liang2004identifying. Errors: `outcome`. Cost: n log n.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate resonance_least_squares(const Record& record, const KnownConstants& constants,
                                               const LineOptions& options = {});

extern const MethodEntry resonance_least_squares_method;

}  // namespace dualdamp::identify
