#pragma once
/// The measured path of a mass, without the noise of the sensors while it rests.
///
/// A law that remembers the path takes noise for motion to and fro, which relaxes its states and costs time. A
/// stretch of samples at rest has the mean position and no speed. Its ends, where the mass still moves, are left as
/// they were measured: those at which the mean of eight samples is more than a standard error off. A stretch
/// whose means of eight samples are not constant within their noise is left, too: the mass creeps there.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace dualdamp::identify {

/// A measured signal with white noise. Empty: not measured.
struct WhiteSignal {
  std::span<const double> samples;
  double noise = 0.0;  ///< standard deviation
};

/// Stretches [begin, end) of samples at which the mass is still, from the samples at rest (`rest_samples`).
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> still_stretches(const std::vector<bool>& rests,
                                                                               const WhiteSignal& x,
                                                                               const WhiteSignal& v);

/// Gives the samples of `x` and `v` in each stretch the mean of `x` and zero.
void hold(const std::vector<std::pair<std::size_t, std::size_t>>& stretches, std::vector<double>& x,
          std::vector<double>& v);

}  // namespace dualdamp::identify
