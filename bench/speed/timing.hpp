#pragma once
/// Times of several contenders, one batch of each in turn, so that a slow moment of the machine affects all of
/// them.

#include <functional>
#include <span>
#include <vector>

namespace dualdamp::bench::speed {

/// Seconds of processor time for one unit of work.
struct Time {
  double median = 0.0;
  double low = 0.0;   ///< first quartile of the batches
  double high = 0.0;  ///< third quartile
};

/// Median and quartiles of `times`, which is not empty.
[[nodiscard]] Time quartiles(std::vector<double> times);

/// works[i](units) does that many units of work. Each work is warmed up, its batch sized to `batch_seconds`, and
/// then timed `batches` times, one batch of each work after the other.
[[nodiscard]] std::vector<Time> time_alternately(std::span<const std::function<void(int)>> works, int batches,
                                                 double batch_seconds);

}  // namespace dualdamp::bench::speed
