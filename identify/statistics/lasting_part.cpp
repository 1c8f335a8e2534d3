#include "identify/statistics/lasting_part.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dualdamp::identify {

void LastingPart::add(std::span<const double> signal) {
  if (signal.empty()) return;
  for (std::size_t i = 0; i + 1 < signal.size(); ++i) products_ += signal[i] * signal[i + 1];
  for (const double value : signal) squares_ += value * value;
  pairs_ += static_cast<double>(signal.size() - 1);
  samples_ += static_cast<double>(signal.size());
}

double LastingPart::correlation() const {
  const double variance = squares_ / samples_;
  return variance > 0.0 ? mean_product() / variance : 0.0;
}

double LastingPart::at_most(double noise) const {
  return std::max(0.0, mean_product()) + 3.0 * noise * noise / std::sqrt(pairs_);
}

}  // namespace dualdamp::identify
