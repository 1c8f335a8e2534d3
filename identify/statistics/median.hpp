#pragma once
/// The median as one of the values: the upper one of the middle two, where Boost's median is their mean. For steps
/// of a time axis, numbers of samples, or levels of a test in any order.

#include <vector>

namespace dualdamp::identify {

/// `values` is not empty. Cost: linear.
[[nodiscard]] double upper_median(std::vector<double> values);

/// Standard deviation of a normal variable whose magnitudes have this median, which a few outliers hardly move.
/// `magnitudes` is not empty.
[[nodiscard]] double median_deviation(std::vector<double> magnitudes);

}  // namespace dualdamp::identify
