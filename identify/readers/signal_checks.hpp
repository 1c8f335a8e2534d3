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

/// The same where noise, that of the converter say, is added behind the place that clips. A plateau is a run of at
/// least four samples within a band at the largest or the smallest value, eight deviations of the noise or two
/// steps of the resolution wide, and at most 1.5 % of the range. A parabola through the samples beside it, on both
/// sides, says how much higher the swing would have gone: more than 1 % of the range and three bands. A smooth top
/// goes no higher than about the band, and a mass that sticks arrives without speed. A velocity may really stop
/// short, as that of a mass carried along, and so may an acceleration. A single place counts.
[[nodiscard]] Clipping noisy_clipping_of(std::span<const double> signal);

[[nodiscard]] bool is_constant(std::span<const double> signal);

}  // namespace dualdamp::identify
