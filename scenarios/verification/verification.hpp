#pragma once
/// The result of a run computed again in another way: by the other engine, or by other steps of the smooth engine,
/// at a tight tolerance; a steady state also by following the transient. Then every quantity is compared. If one
/// kind of steps does not confirm a result of the exact engine, the other kind computes it too, and one of both
/// must agree. The reason: errors of many steps add up, and neither kind would repeat a fault of the exact engine.

#include "scenarios/results/answer.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/verification/answer_comparison.hpp"
#include "sim/model.hpp"

namespace dualdamp::scenarios {

/// Reference sizes, by unit, for which a difference of the tolerance is the accuracy of a motion that is as large
/// as the drive and the initial state. A smaller motion is not known better.
[[nodiscard]] SizesOfUnits finest_sizes(const sim::Model& model);

/// Computes the answer of this scenario again and compares it. The scenario's analysis must be verifiable.
[[nodiscard]] Verification verify(const Scenario& scenario, const RunOptions& options, const Answer& answer);

}  // namespace dualdamp::scenarios
