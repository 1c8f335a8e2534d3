#pragma once
/// Noise level of sampled signals: standard deviation of white noise on a smooth motion, from differences of second
/// or fourth order. Those of a smooth motion are very small.
///
///   s^2 = mean(d_i^2)/g,   d = (1, -2, 1), g = 6   or   d = (1, -4, 6, -4, 1), g = 70

#include <cstddef>
#include <span>
#include <vector>

namespace dualdamp::identify {

/// `order` is 2 or 4. 0 where there are not more than `order` samples. Cost: linear.
[[nodiscard]] double noise_level(std::span<const double> signal, int order = 4);

/// The smallest difference between unequal values of a signal: the step of a coarse converter. 0 if there are fewer
/// than `fewest` levels, as in a drive that switches, or if most values differ. Cost: n log n.
[[nodiscard]] double converter_step(std::vector<double> signal, std::size_t fewest = 32);

/// `noise_level` of several signals of one sensor that are smooth except for a few jumps: differences of fourth
/// order, without those that are too large for noise.
class RobustNoiseLevel {
 public:
  void add(std::span<const double> signal);

  /// 0 where nothing was added.
  [[nodiscard]] double deviation() const;

 private:
  std::vector<double> differences_;  ///< magnitudes, each in units of the noise
};

/// `RobustNoiseLevel` of one signal. Cost: linear.
[[nodiscard]] double robust_noise_level(std::span<const double> signal);

}  // namespace dualdamp::identify
