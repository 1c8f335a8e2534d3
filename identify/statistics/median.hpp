#pragma once
/// The middle one of some values, the upper of two. It is one of the values: a step of a time axis, a number of
/// samples; Boost's median is the mean of two.

#include <vector>

namespace dualdamp::identify {

/// `values` is not empty. Cost: linear.
[[nodiscard]] double upper_median(std::vector<double> values);

}  // namespace dualdamp::identify
