#pragma once
/// Noise level of sampled signals: standard deviation of white noise on a smooth motion, from differences of second
/// or fourth order. Those of a smooth motion are very small.
///
///   s^2 = mean(d_i^2)/g,   d = (1, -2, 1), g = 6   or   d = (1, -4, 6, -4, 1), g = 70

#include <cstddef>
#include <span>
#include <vector>

namespace dualdamp::identify {

/// Variance of a second difference over that of the noise: the sum of its squared coefficients.
inline constexpr double second_difference_gain = 6.0;

/// `order` is 2 or 4. 0 where there are not more than `order` samples. Cost: linear.
[[nodiscard]] double noise_level(std::span<const double> signal, int order = 4);

/// The smallest difference between unequal values of a signal: the step of a coarse converter. 0 if there are fewer
/// than `fewest` levels, as in a drive that switches, or if most values differ. Cost: n log n.
[[nodiscard]] double converter_step(std::vector<double> signal, std::size_t fewest = 32);

/// Standard deviations beyond which a difference is too large for noise: one normal variable in 16,000.
inline constexpr double most_of_noise = 4.0;

/// Magnitudes that noise may have.
struct NoisePart {
  double root_mean_square = 0.0;
  double count = 0.0;
};

/// Those of the magnitudes that are not too large for noise of this standard deviation; there is one at least.
[[nodiscard]] NoisePart noise_part(std::span<const double> magnitudes, double deviation);

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
