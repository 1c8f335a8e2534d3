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

// Sums of the squared coefficients: variance of a difference over that of the noise.
constexpr double second_gain = 6.0;
constexpr double fourth_gain = 70.0;

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
  return std::sqrt(sum / ((order == 2 ? second_gain : fourth_gain) * static_cast<double>(count)));
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

void RobustNoiseLevel::add(std::span<const double> signal) {
  for (std::size_t i = 0; i + 4 < signal.size(); ++i)
    differences_.push_back(std::abs(fourth_difference(signal, i)) / std::sqrt(fourth_gain));
}

double RobustNoiseLevel::deviation() const {
  if (differences_.empty()) return 0.0;
  constexpr double rare = 4.0;  // deviations: one normal variable in 16,000
  const double largest = rare * median_deviation(differences_);
  double sum = 0.0;
  double count = 0.0;
  for (const double difference : differences_) {
    if (difference > largest) continue;
    sum += difference * difference;
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

double robust_noise_level(std::span<const double> signal) {
  RobustNoiseLevel level;
  level.add(signal);
  return level.deviation();
}

}  // namespace dualdamp::identify
