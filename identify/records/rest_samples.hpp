#pragma once
/// Samples at which a measured motion rests.
///
/// A mass that rests under rigid friction is held by a force that only the other forces determine, anywhere within
/// the bounds of the friction. A sample rests if its speed is zero. Samples of a speed with noise rest if there are
/// eight of them in succession, or more behind a filter, that do not exceed four deviations of the noise and do not
/// lie along a line through all of it, as a reversal does.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "identify/records/signals.hpp"

namespace dualdamp::identify {

/// The noise of a velocity, by its roughness.
[[nodiscard]] double noise_of_speed(const std::vector<double>& v);

/// The noise of `sharp_difference` of a position behind a filter, if there is one, by the roughness of the
/// position.
[[nodiscard]] double noise_of_speed(const std::vector<double>& x, double rate,
                                    const std::optional<ZeroPhaseFilter>& filter);

/// Which samples of `v` rest; `noise` is its deviation. A stretch of at least three is continued by `spread`
/// samples to both sides: a filter mixes them with the motion before and after.
[[nodiscard]] std::vector<bool> rest_samples(std::span<const double> v, double noise, std::size_t spread);

}  // namespace dualdamp::identify
