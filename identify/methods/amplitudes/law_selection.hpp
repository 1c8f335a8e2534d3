#pragma once
/// Law selection: which friction law describes x-Y pairs, Coulomb + viscous or another one.
///
/// Candidates, by the fundamental of their force (identify/methods/amplitudes/fundamental_laws.hpp):
/// coulomb_viscous; quadratic_drag,
/// + d v|v|; power, F0 + C |v|^n; saturating_viscous, F0 + c v/(1 + |v|/v0); stribeck, + dF exp(-(v/vs)^2);
/// position_quadratic, F0 + c v + s x^2; position_linear. Each is fitted by least squares in x: X solves
///
///   ((k - m w^2) X)^2 + Phi(w X, X)^2 = (k Y)^2
///
/// What harmonic balance leaves of the exact amplitude law at its fit (den_hartog_fit) is taken out of the data
/// first, so that Coulomb + viscous friction is not rejected for the error of harmonic balance. zeta and F0 of the
/// estimate, their uncertainty and the pairs left out are those of den_hartog_fit. A law may have at most two
/// parameters less than there are levels. Ranking: by AICc, or by BIC where the pairs are too few for the AICc of
/// one law; with N for independent pairs, less where the residuals of a sweep go together (block-effective N).
/// Residuals below 5e-4 of the range of x count as that. Diagnostic: an F test of the best law with one more
/// parameter, its p value times the number of those.
///
/// The curve of amplitudes at one frequency does not tell laws of velocity, position and amplitude apart; the
/// warning says so whenever another law wins. Source: burnham2002; schwarz1978; the aliasing: docs/theory.md,
/// section 9. Errors: `outcome`. Cost: 0.2 ms for five pairs, 0.7 ms for fifty.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate law_selection(const Record& record, const KnownConstants& constants,
                                     const KnownDeviations& options = {});

extern const MethodEntry law_selection_method;

}  // namespace dualdamp::identify
