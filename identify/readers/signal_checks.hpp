#pragma once
/// Faults that the samples of any sensor can have.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dualdamp::identify {

/// Samples at an end of the range of a sensor, which cuts off the swings.
struct Clipping {
  std::size_t samples = 0;
  std::size_t places = 0;
  std::size_t first = 0;  ///< index of the first such sample
  double value = 0.0;
  std::vector<std::pair<std::size_t, std::size_t>> stretches = {};  ///< [begin, end) of each place
};

/// `samples` is 0 if the signal is not clipped. A swing is clipped if it stays at the largest or the smallest value
/// of the signal and would have gone further. Parabolas through the samples beside the plateau, on both sides, say
/// how much: more than three times the resolution and 1 % of the range. The least of them counts, through as few
/// samples as their noise allows. A mass that sticks arrives without speed. There must be two such places. A mass
/// that is held before its release does not count as one.
[[nodiscard]] Clipping clipping_of(std::span<const double> signal);

/// The same where noise, that of the converter say, is added behind the place that clips. A plateau is a run of at
/// least four samples within a band at the largest or the smallest value, eight deviations of the noise or two
/// steps of the resolution wide, and at most 1.5 % of the range. The swing would have gone further by more than 1 %
/// of the range and three bands; a smooth top goes no higher than about the band. A velocity may really stop short,
/// as that of a mass carried along, and so may an acceleration. A single place counts.
[[nodiscard]] Clipping noisy_clipping_of(std::span<const double> signal);

/// Whether the measured velocity says that the mass stands still where its displacement stays at the end of the
/// range: there its median speed is below a tenth of that beside these places. It would be a quarter or more if the
/// displacement were clipped.
[[nodiscard]] bool is_still_at(const Clipping& clipping, std::span<const double> v);

/// The same without the places where the mass sticks because its drive stops or turns: a mass that a ramp carries
/// along arrives with speed, and stays where the ramp ends. `drive`: the force on the mass or the position of the
/// base, of the same samples. The drive has a corner there, between lines through an eighth of the plateau's length
/// on both sides: before it, the drive moves outwards at half its usual speed or more, and after it not at all or
/// back. The mass slows down from there to the plateau. The corner is not behind the start of the plateau by more
/// than a twentieth of its length: an end of the range is reached while the drive still moves on. A harmonic drive
/// has no corner. Nothing is left of fewer places than `fewest_places`.
[[nodiscard]] Clipping without_sticks(const Clipping& clipping, std::span<const double> x,
                                      std::span<const double> drive, std::size_t fewest_places);

/// The samples with the number that a logger writes where it measured nothing or too much: -9999, 9.9e37. It is the
/// largest or the smallest value, appears at least twice and in less than a tenth of the samples, and is further
/// from all others than five times their range. Samples of a motion come and go through values between.
[[nodiscard]] std::vector<std::size_t> placeholders_in(std::span<const double> signal);

[[nodiscard]] bool is_constant(std::span<const double> signal);

}  // namespace dualdamp::identify
