#include "identify/records/faults/sensor_agreement.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "identify/record.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

ArrayXd differences(const ArrayXd& signal, Index window) {
  return signal.tail(signal.size() - window) - signal.head(signal.size() - window);
}

/// Integrals over windows, by trapezoids.
ArrayXd integrals(const ArrayXd& signal, Index window, double step) {
  ArrayXd sums = ArrayXd::Zero(signal.size());
  for (Index i = 1; i < signal.size(); ++i) sums[i] = sums[i - 1] + 0.5 * step * (signal[i - 1] + signal[i]);
  return differences(sums, window);
}

/// The least window over which the signal changes by as much as it deviates from its mean, up to `most`.
Index window_of(const ArrayXd& signal, Index most) {
  constexpr Index enough = 10'000;  // samples that tell the deviation of a change
  const double wanted = (signal - signal.mean()).square().mean();
  Index window = 1;
  while (window < most) {
    const Index count = signal.size() - window;
    const Index stride = std::max<Index>(1, count / enough);
    double sum = 0.0;
    double terms = 0.0;
    for (Index i = 0; i < count; i += stride, terms += 1.0) sum += std::pow(signal[i + window] - signal[i], 2);
    if (sum >= wanted * terms) break;
    window += (window + 3) / 4;
  }
  return std::min(window, most);
}

}  // namespace

SensorAgreement sensor_agreement(const std::vector<double>& signal, const std::vector<double>& derivative,
                                 int order, double sample_rate) {
  constexpr std::size_t least_samples = 16;
  const std::size_t size = std::min(signal.size(), derivative.size());
  if (size < least_samples) return {unknown, unknown};
  const auto count = static_cast<Index>(size);
  ArrayXd moved = Eigen::Map<const ArrayXd>(signal.data(), count);
  ArrayXd made = Eigen::Map<const ArrayXd>(derivative.data(), count);
  moved -= moved.mean();
  made -= made.mean();
  const Index window = window_of(moved, count / 4);
  for (int i = 0; i < order; ++i) {
    moved = differences(moved, window);
    made = integrals(made, window, 1.0 / sample_rate);
  }
  moved -= moved.mean();
  made -= made.mean();
  const double squares = std::sqrt(moved.square().sum() * made.square().sum());
  if (!(squares > 0.0)) return {unknown, unknown};
  return {std::sqrt(made.square().sum() / moved.square().sum()), (moved * made).sum() / squares};
}

}  // namespace dualdamp::identify
