#pragma once
/// Law selection: whether Coulomb and viscous friction or another law describes x-Y pairs.
///
/// Candidates, by the fundamental of their force (identify/methods/amplitudes/fundamental_laws.hpp):
/// coulomb_viscous; quadratic_drag,
/// + d v|v|; viscous_power, F0 + C |v|^n; viscous_saturating, F0 + c v/(1 + |v|/v0); stribeck, + dF exp(-(v/vs)^2);
/// position_quadratic, F0 + c v + s x^2; position_linear. Each is fitted by least squares in x: X solves
///
///   ((k - m w^2) X)^2 + Phi(w X, X)^2 = (k Y)^2
///
/// The error of harmonic balance, computed from the exact amplitude law at its fit (den_hartog_fit), is first
/// subtracted from the data, so that Coulomb and viscous friction is not rejected because of this error. zeta and
/// F0 of the estimate, their uncertainty and the pairs left out are those of den_hartog_fit. A law may have as many
/// parameters as there are levels, less two. Ranking: by AICc, or by BIC if the AICc of at least one law would need
/// more pairs. N is the number of independent pairs, which is smaller if the residuals of a sweep are correlated
/// (block-effective N). Residuals below 5e-4 of the range of x count as 5e-4. Diagnostic: an F test of the best law
/// with one more parameter, with its p value times the number of such laws.
///
/// The curve of amplitudes at one frequency does not distinguish laws of velocity, position and amplitude; a
/// warning says so if another law ranks first. Source: burnham2002; schwarz1978; the aliasing: docs/theory.md,
/// section 9. Errors: `outcome`. Cost: 0.2 ms for five pairs, 0.7 ms for fifty.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate law_selection(const Record& record, const KnownConstants& constants,
                                     const KnownDeviations& options = {});

extern const MethodEntry law_selection_method;

}  // namespace dualdamp::identify
