#pragma once
/// Mean of samples whose errors may last from one to the next.
///
/// Each error is taken to have the correlation r with the next and r^2 with the one after it: the variance of a
/// slow sum of them is (1 + r)/(1 - r) times that of independent ones.

#include <span>

namespace dualdamp::identify {

struct LastingMean {
  double value = 0.0;
  double std = 0.0;      ///< of the mean
  double scatter = 0.0;  ///< standard deviation of the samples
  double longer = 1.0;   ///< standard error of a slow sum of them over that of independent ones
};

/// Of one sample or more. Cost: linear.
[[nodiscard]] LastingMean lasting_mean(std::span<const double> samples);

}  // namespace dualdamp::identify
