#pragma once
/// One walk along a periodic orbit, for all that a steady state reports of it.

#include "sim/period_map.hpp"
#include "sim/steady_state.hpp"

namespace dualdamp::sim {

/// Fills the numbers of `result` from the orbit that begins at `result.start`; `full`: phase, largest speed and
/// energy too.
void account_for_orbit(const Model& model, PeriodMap& map, bool full, SteadyState& result);

}  // namespace dualdamp::sim
