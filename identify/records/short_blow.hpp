#pragma once
/// Blows of the measured force that have too few samples.
///
/// Between its samples the force of a blow is not known. The impulse of the cubic spline through n samples of a
/// half sine is wrong by up to 0.8/n^2, because it has corners: 3 % at five samples, which is many times the noise
/// of the motion. The motion after it then seems to contradict sensors or friction. That motion is a free
/// vibration, whose first state a fit finds, and about which the force tells nothing more. A record of several
/// blows holds a free vibration after each of them.
///
/// A blow is a part of the force that is more than a twentieth of its largest value, and more than six deviations
/// of its noise, away from its median; parts with hardly a sample between them are one blow. Its n samples are
/// those from the first to the last above a tenth of its own largest value. It is short if n is at most 12, or at
/// most 64 where 0.8/n^2 is more than the error r sqrt(8/N) of the amplitude of the motion: r is the noise of x
/// over its amplitude, N the number of samples. If one blow is short, the record is cut at all of them.
///
/// Outside of the blows the force must be no more than its noise, and less than 5 % of the largest blow: any other
/// force goes on driving the mass. No blow may begin with the record, or have more than 64 samples. The vibrations
/// that are used hold half of the record and half of the range of x; one is used if it has 16 samples, a quarter
/// of the samples of the longest, and a twentieth of the range of the largest.
///
/// Errors: none thrown. Cost: linear.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct Blow {
  std::size_t first = 0;  ///< first sample of the blow
  std::size_t last = 0;   ///< its last sample
  std::size_t end = 0;    ///< first sample of the motion after it

  [[nodiscard]] std::size_t samples() const { return last - first + 1; }
};

/// Samples [first, last) of a history.
struct FreeVibration {
  std::size_t first = 0;
  std::size_t last = 0;

  [[nodiscard]] std::size_t samples() const { return last - first; }
};

/// All blows of a force, of which one is short at least.
struct ShortBlows {
  std::vector<Blow> blows;
  std::vector<FreeVibration> vibrations;  ///< that can be used; empty: the motion does not do without the force
  std::vector<FreeVibration> unused;      ///< between blows, too short or too small
};

/// `x`: the motion, as many samples.
[[nodiscard]] std::optional<ShortBlows> short_blows(const std::vector<double>& force, const std::vector<double>& x);

/// By the first measured signal of x, v and a. Of a, the samples within the blows do not count: the force itself
/// makes them large.
[[nodiscard]] std::optional<ShortBlows> short_blows(const History& history);

/// By how much the impulse of the interpolated force may be wrong, where the force cannot be left out.
[[nodiscard]] std::string impulse_warning(const History& history, const ShortBlows& found);

/// The free vibrations that follow the blows, without the force. Of several, each is a test of its own, labelled
/// by its blow. Appends what was done to `warnings`, in sentences.
[[nodiscard]] std::vector<History> without_blows(const History& history, const ShortBlows& found,
                                                 std::vector<std::string>& warnings);

/// Puts the free vibrations that follow short blows in the place of each history whose base is at rest. Returns
/// warnings, also of blows whose force cannot be left out.
[[nodiscard]] std::vector<std::string> leave_out_short_blows(std::vector<History>& histories);

}  // namespace dualdamp::identify
