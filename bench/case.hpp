#pragma once
/// One motion of a stress test, measured and identified: the finished cases as lines of `cases.jsonl`.

#include <cstddef>
#include <functional>
#include <string>

#include "bench/grid.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/rigs/rigs.hpp"

namespace dualdamp::bench {

/// A finished case: its line without line end.
using TakeLine = std::function<void(const std::string& line)>;

/// Computes motion `number` once and those of its cases that are `wanted`. A case that cannot be measured is a line
/// with a reason.
void run_motion(const Grid& grid, const Truth& truth, const sim::SteadyStateOptions& options, std::size_t number,
                const std::function<bool(std::size_t)>& wanted, const TakeLine& take);

}  // namespace dualdamp::bench
