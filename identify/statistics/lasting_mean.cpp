#include "identify/statistics/lasting_mean.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "identify/statistics/lasting_part.hpp"

namespace dualdamp::identify {

LastingMean lasting_mean(std::span<const double> samples) {
  const auto n = static_cast<double>(samples.size());
  const double mean = std::reduce(samples.begin(), samples.end()) / n;
  std::vector<double> errors(samples.begin(), samples.end());
  double square = 0.0;
  for (double& error : errors) {
    error -= mean;
    square += error * error;
  }
  const double scatter = std::sqrt(square / std::max(n - 1.0, 1.0));
  LastingPart lasting;
  lasting.add(errors);
  // The mean takes about 1/n of the correlation from neighbours.
  constexpr double most = 0.98;
  const double correlation = square > 0.0 ? std::clamp(lasting.correlation() + 1.0 / n, 0.0, most) : 0.0;
  const double longer = std::sqrt((1.0 + correlation) / (1.0 - correlation));
  return {mean, longer * scatter / std::sqrt(n), scatter, longer};
}

}  // namespace dualdamp::identify
