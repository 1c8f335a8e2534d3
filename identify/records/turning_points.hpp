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

}  // namespace dualdamp::identify
