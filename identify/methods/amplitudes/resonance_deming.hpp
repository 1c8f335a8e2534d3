#pragma once
/// Resonance method with errors in both amplitudes: viscous and Coulomb friction from Deming's line x = a + b Y.
///
///   b = [d + sqrt(d^2 + 4 lambda S_xY^2)]/(2 S_xY),   d = S_xx - lambda S_YY,   lambda = sigma_x^2/sigma_Y^2
///   zeta = 1/(2 b),   x_f = -a/G(zeta)                                                Eqs (9), (14), (13)
///
/// lambda comes from `sigma_x` and `sigma_Y` in the options; without them both amplitudes are assumed to have the
/// same relative error, lambda = (mean x/mean Y)^2. `sigma_x` alone gives the least-squares line, `sigma_Y` alone
/// that of errors in Y. Errors of Y lower the slope of a least-squares line: 0.1 mm over 4.45 to 6.75 mm in five
/// levels raise zeta by 1.5 % and lower F0 by 1.1 %. Deming's line does not have this bias if lambda is correct.
///
/// Holds for small zeta near w = wn, without sticking, with independent errors of constant size. Uncertainty:
/// covariance of Deming's line for large samples with n - 2 degrees of freedom (or from the given deviations),
/// propagated to (zeta, F0). Diagnostics: those of resonance_least_squares. Source: deming1943, fuller1987,
/// liang2004identifying. Errors: `outcome`. Cost: n log n.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate resonance_deming(const Record& record, const KnownConstants& constants,
                                        const LineOptions& options = {});

extern const MethodEntry resonance_deming_method;

}  // namespace dualdamp::identify
