#pragma once
/// A blow of the measured force that has too few samples.
///
/// Between its samples the force of a blow is not known. The impulse of the cubic spline through n samples of a
/// half sine is wrong by up to 0.8/n^2, because it has corners: 3 % at five samples, which is many times the noise
/// of the motion. The motion after it then seems to contradict sensors or friction. That motion is a free
/// vibration, whose first state a fit finds, and about which the force tells nothing more.
///
/// The force of a blow is more than a tenth of its largest value away from its median in n samples, counted from
/// the first to the last of them. It is short if n is at most 12, or at most 64 where 0.8/n^2 is more than the
/// error r sqrt(8/N) of the amplitude of the motion: r is the noise of x over its amplitude, N the number of
/// samples. Outside of it the force must be no more than its noise, and less than 5 % of the blow: any other force
/// goes on driving the mass. It must not begin with the record, and at least half of the record and half of the
/// range of x must follow.
///
/// Errors: none thrown. Cost: linear.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct ShortBlow {
  std::size_t first = 0;  ///< first sample of the blow
  std::size_t last = 0;   ///< its last sample
  std::size_t end = 0;    ///< first sample of the motion after it

  [[nodiscard]] std::size_t samples() const { return last - first + 1; }
};

/// `x`: the motion, as many samples.
[[nodiscard]] std::optional<ShortBlow> short_blow(const std::vector<double>& force, const std::vector<double>& x);

/// By the first measured signal of x, v and a. Of a, the samples within the blow do not count: the force itself
/// makes them large.
[[nodiscard]] std::optional<ShortBlow> short_blow(const History& history);

/// By how much the impulse of the interpolated force may be wrong, where the force cannot be left out.
[[nodiscard]] std::string impulse_warning(const History& history, const ShortBlow& blow);

/// Leaves out the force, and the samples up to the end of the blow. Returns what was done, in sentences.
[[nodiscard]] std::vector<std::string> leave_out_short_blow(History& history, const ShortBlow& blow);

/// Leaves out the force of a short blow, and the samples up to its end, of each history whose base is at rest.
/// Returns a warning for each of them.
[[nodiscard]] std::vector<std::string> leave_out_short_blows(std::vector<History>& histories);

}  // namespace dualdamp::identify
