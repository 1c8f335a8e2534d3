#pragma once
/// The friction force itself, from the other forces: over velocity and over displacement, with the contact
/// stiffness from its reversals.
///
///   F = k (y - x) + f - m a;   F = c v + F0 sgn v + offset  for |v| > `least_speed`
///   contact stiffness: slope of the dry part over x after a reversal, while it has changed by less than 80 % of 2
///   F0 K = 2 F0/(X - sqrt(X^2 - (V/w)^2)), V the speed at which it has changed by 2 F0           inverse of Eq
///   (18)
///
/// Curves: friction_velocity (v, F, F - c v), friction_displacement (x, F). Velocity as in the paper.
///
/// Biases, first order, at resonance: a delay t of a adds -m w^2 t to c, of x +k t; a gain error e of a (or of k or
/// m) does not change c and F0 and opens a loop of 2 e k X at v = 0, which looks like a compliant contact. Checked:
/// such a loop, by a term in x. Uncertainty: from the parametric bootstrap
/// (`identify/uncertainty/parametric_bootstrap.hpp`). Source: liang2004identifying. Errors: `outcome`. Cost: some
/// 100 operations a sample.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate friction_force(const Record& record, const KnownConstants& constants,
                                      const RegressionOptions& options = {});

extern const MethodEntry friction_force_method;

}  // namespace dualdamp::identify
