#pragma once
/// A law under modifiers. Every force limit of the law, nominally L, becomes
///
///   max(0, max(0, 1 + drift t) max(0, 1 + ratio n) exp(-p/power) L + position_slope |x|)     [N]
///
/// the factors first, the slope after. n: the process of `fluctuation.hpp`, over time, stationary from the start,
/// or over position, cell 0 about x = 0. p [W] is a state: time_constant p' = P - p, P what the law turns to heat,
/// p = 0 at first.
///
/// The law inside sees `Instant::modification` and stays affine in every mode, unless it warms: between the changes
/// below limits are affine in t and x. The wrapper adds
///   times    the ends of cells; the end of a falling drift at t = -1/drift.
///   guards   the ends of cells over position; x = 0, where the slope changes its sign; a limit that vanishes, or
///            returns.
/// Where limits rise by a step the law first gets `Trigger::limit_change` at the old ones. While no limit is left
/// the law has no force; it begins anew, unstretched, where a limit returns.
///
/// Cost: a copy of what the law remembers at each call.

#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

/// `law` under the modifiers among `values`; itself when there is none, or none does anything. `limits`: the
/// nominal force limits of a law that supports `position_slope` [N].
[[nodiscard]] Law modified(const Law& law, const ParameterValues& values, std::vector<double> limits = {});

}  // namespace dualdamp::friction
