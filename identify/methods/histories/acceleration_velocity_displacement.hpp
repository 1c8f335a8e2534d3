#pragma once
/// Regression of the forces on acceleration, velocity and displacement: mass, stiffness, viscous and Coulomb
/// friction and a constant force from time histories.
///
///   k (y - x) + f = m a + c v + F0 sgn v + offset
///
/// by linear least squares over all samples with |v| > `least_speed`. Mass and stiffness are taken from the
/// constants where they are known and are unknowns otherwise; at least one of them, or the force f, must be known,
/// for the equation has no scale without. Stiffness 0: a machine on a rail, whose zeta and x_f do not exist.
///
/// Velocity and acceleration that were not measured are differentiated from x. All signals, sgn v among them, pass
/// through the same zero-phase filter (`cutoffs`; `identify/records/signals.hpp`); the estimate is that of the
/// first cut-off, the others show among `subsets` what the choice matters. With exact x, v, a: exact.
///
/// Checked: columns that nearly depend on each other (a = -w^2 x at one level and frequency); a term v|v|; how far
/// the cut-offs agree. Uncertainty: from the parametric bootstrap
/// (`identify/uncertainty/parametric_bootstrap.hpp`), for errors in a, v and x bias the fit; residuals that are
/// alike from sample to sample beyond them widen it. Source: after chen1996, janot2019. Errors: `outcome`. Cost:
/// some 100 operations a sample.

#include <optional>

#include "identify/method.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

struct ForceParameters;

[[nodiscard]] Estimate acceleration_velocity_displacement(const Record& record, const KnownConstants& constants,
                                                          const RegressionOptions& options = {});

/// Its values alone, without their uncertainty, which costs forty times as much; nothing where it refuses.
[[nodiscard]] std::optional<ForceParameters> regressed_forces(const Record& record, const KnownConstants& constants,
                                                              const RegressionOptions& options);

extern const MethodEntry acceleration_velocity_displacement_method;

}  // namespace dualdamp::identify
