#pragma once
/// Steps of a measured drive between two samples: it is switched on or off, or a wire is cut. Where in between it
/// steps is not known.

#include <cstddef>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// The first sample of each interval in which y or the force steps, in order of time. A kink, noise and few samples
/// in a period are no steps, nor is a blow of a few samples. Nothing where there are more than four, as in a square
/// wave. Cost: linear.
[[nodiscard]] std::vector<std::size_t> drive_steps(const History& history);

}  // namespace dualdamp::identify
