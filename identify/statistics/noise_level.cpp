#include "identify/statistics/noise_level.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

double second_difference(std::span<const double> x, std::size_t i) { return x[i] - 2.0 * x[i + 1] + x[i + 2]; }

double fourth_difference(std::span<const double> x, std::size_t i) {
  return x[i] - 4.0 * x[i + 1] + 6.0 * x[i + 2] - 4.0 * x[i + 3] + x[i + 4];
}

constexpr double fourth_difference_gain = 70.0;

}  // namespace

double noise_level(std::span<const double> signal, int order) {
  const auto reach = static_cast<std::size_t>(order);
  if (signal.size() <= reach) return 0.0;
  const std::size_t count = signal.size() - reach;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double difference = order == 2 ? second_difference(signal, i) : fourth_difference(signal, i);
    sum += difference * difference;
  }
  return std::sqrt(sum /
                   ((order == 2 ? second_difference_gain : fourth_difference_gain) * static_cast<double>(count)));
}

double converter_step(std::vector<double> signal, std::size_t fewest) {
  if (signal.empty()) return 0.0;
  std::ranges::sort(signal);
  constexpr double last_bits = 1e-9;
  const double least = last_bits * (signal.back() - signal.front());
  double step = signal.back() - signal.front();
  std::size_t levels = 1;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    const double rise = signal[i] - signal[i - 1];
    if (!(rise > least)) continue;
    step = std::min(step, rise);
    ++levels;
  }
  return levels < fewest || 2 * levels > signal.size() ? 0.0 : step;
}

NoisePart noise_part(std::span<const double> magnitudes, double deviation) {
  const double largest = most_of_noise * deviation;
  double sum = 0.0;
  double count = 0.0;
  for (const double magnitude : magnitudes) {
    if (magnitude > largest) continue;
    sum += magnitude * magnitude;
    count += 1.0;
  }
  return {std::sqrt(sum / count), count};
}

void RobustNoiseLevel::add(std::span<const double> signal) {
  for (std::size_t i = 0; i + 4 < signal.size(); ++i)
    differences_.push_back(std::abs(fourth_difference(signal, i)) / std::sqrt(fourth_difference_gain));
}

double RobustNoiseLevel::deviation() const {
  if (differences_.empty()) return 0.0;
  return noise_part(differences_, median_deviation(differences_)).root_mean_square;
}

double robust_noise_level(std::span<const double> signal) {
  RobustNoiseLevel level;
  level.add(signal);
  return level.deviation();
}

}  // namespace dualdamp::identify
