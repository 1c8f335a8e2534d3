#pragma once
/// Warnings about how exactly an orbit was found: each says by how much the steady state may be off.

#include "sim/orbits/period_map.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

/// Warns if what is left to the orbit, or what errors of steps add up to, exceeds 1e-4 of its size. `period`: with
/// its monodromy matrix; `tolerance`: at which the motion counted as closed; `accuracy`: of the engine; `omega`:
/// forcing frequency [rad/s].
void warn_of_distance(const ForcingPeriod& period, double tolerance, double accuracy, double omega,
                      SteadyState& result);

/// The model with ten times as exact steps of the smooth engine; with ten times coarser ones where finer are not
/// allowed.
[[nodiscard]] Model with_other_steps(const Model& model);

/// Warns if the period with other steps, which `other` computes, differs by more than 1e-4 of its size. A creep may
/// multiply an error of a step by 1e8, and a later stick erase it, so that the monodromy matrix of the whole period
/// does not show it.
void warn_of_steps(const ForcingPeriod& period, PeriodMap& other, const Model& model, SteadyState& result);

}  // namespace dualdamp::sim
