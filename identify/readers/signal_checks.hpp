#pragma once
/// What can be wrong with the samples of a sensor, whatever it measures.

#include <cstddef>
#include <span>

namespace dualdamp::identify {

/// Samples at the end of the range of a sensor, which cuts off the swings beyond it.
struct Clipping {
  std::size_t samples = 0;
  std::size_t places = 0;
  std::size_t first = 0;  ///< index of the first such sample
  double value = 0.0;
};

/// No samples when nothing is clipped. A swing is clipped when it stays at the largest or the smallest value of all
/// and comes there too steeply for a rounded top: the height that its slope would still reach is above the
/// resolution and above 1 % of the range. Two such places at least; a mass that is held before its release is no
/// such place.
[[nodiscard]] Clipping clipping_of(std::span<const double> signal);

[[nodiscard]] bool is_constant(std::span<const double> signal);

}  // namespace dualdamp::identify
