#pragma once
/// Turning points of sampled signals, as numbers of samples. Errors: none. Cost: linear.

#include <cstddef>
#include <span>
#include <vector>

namespace dualdamp::identify {

/// Alternating extremes that are farther apart than `band`. The signal has not yet turned back from the last one.
[[nodiscard]] std::vector<std::size_t> zigzag(std::span<const double> x, double band);

/// The largest value less the smallest one; 0 of no samples.
[[nodiscard]] double range_of(std::span<const double> x);

/// Number of samples behind which x turns back.
[[nodiscard]] std::size_t rows_that_turn(std::span<const double> x);

/// Removes ripple: swings that are smaller than both neighbours and last less than half of `half_period`. Of two
/// tops with a ripple between them, the higher one is left.
[[nodiscard]] std::vector<std::size_t> without_ripple(std::span<const double> x, std::vector<std::size_t> turns,
                                                      double half_period);

/// The first sample from which on x stays within this range.
[[nodiscard]] std::size_t begin_of_rest(std::span<const double> x, double range);

/// Removes turning points that are no swings: interpolated samples overshoot the position in which the mass stops,
/// by a share of its last steps. A last swing of this size would take half a period, the overshoot takes a few
/// samples. `rest`: the sample from which on x rests; `half_period` in samples.
void leave_out_overshoot(std::span<const double> x, std::vector<std::size_t>& turns, std::size_t rest,
                         double half_period);

/// Leaves the end of x in place of the turning points behind the sample `from`, if they are not all farther apart
/// than `least` and nearer than `most`, as the swings of a decay are. True if they were not.
[[nodiscard]] bool leave_out_irregular(std::span<const double> x, std::vector<std::size_t>& turns, std::size_t from,
                                       double least, double most);

}  // namespace dualdamp::identify
