#pragma once
/// Regression of the forces on acceleration, velocity and displacement: mass, stiffness, viscous and Coulomb
/// friction and a constant force from time histories.
///
///   k (y - x) + f = m a + c v + F0 sgn v + offset
///
/// by linear least squares over all samples with |v| > `least_speed`. Mass and stiffness come from the constants if
/// they are known, and are unknowns of the fit otherwise. At least one of them, or the force f, must be known,
/// because the equation has no scale without it. Stiffness 0: a machine on a rail, for which zeta and x_f do not
/// exist.
///
/// Velocity and acceleration that were not measured are differentiated from x. All signals, including sgn v, pass
/// through the same zero-phase filter (`cutoffs`; `identify/records/signals.hpp`). The estimate is that of the
/// first cut-off; the others, among `subsets`, show the effect of the choice. With exact x, v, a the estimate is
/// exact.
///
/// Checked: columns that nearly depend on each other (a = -w^2 x at one level and frequency); a term v|v|; how far
/// the cut-offs agree. Uncertainty: from the parametric bootstrap
/// (`identify/uncertainty/parametric_bootstrap.hpp`), because errors in a, v and x bias the fit. Residuals that are
/// more correlated than those of the synthetic records widen the intervals. Source: after chen1996, janot2019.
/// Errors: `outcome`. Cost: some 100 operations a sample.

#include <optional>

#include "identify/method.hpp"

namespace dualdamp::identify {

struct ForceParameters;

[[nodiscard]] Estimate acceleration_velocity_displacement(const Record& record, const KnownConstants& constants,
                                                          const RegressionOptions& options = {});

/// The values alone, without their uncertainty, which costs forty times as much; nothing if the method refuses.
[[nodiscard]] std::optional<ForceParameters> regressed_forces(const Record& record, const KnownConstants& constants,
                                                              const RegressionOptions& options);

extern const MethodEntry acceleration_velocity_displacement_method;

}  // namespace dualdamp::identify
