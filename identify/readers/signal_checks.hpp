#pragma once
/// Faults that the samples of any sensor can have.

#include <cstddef>
#include <span>

namespace dualdamp::identify {

/// Samples at an end of the range of a sensor, which cuts off the swings.
struct Clipping {
  std::size_t samples = 0;
  std::size_t places = 0;
  std::size_t first = 0;  ///< index of the first such sample
  double value = 0.0;
};

/// `samples` is 0 if the signal is not clipped. A swing is clipped if it stays at the largest or the smallest value
/// of the signal and its slope is too steep for a rounded top: the height that the slope would still reach is above
/// three times the resolution and above 1 % of the range. There must be two such places. A mass that is held before
/// its release does not count as one.
[[nodiscard]] Clipping clipping_of(std::span<const double> signal);

[[nodiscard]] bool is_constant(std::span<const double> signal);

}  // namespace dualdamp::identify
