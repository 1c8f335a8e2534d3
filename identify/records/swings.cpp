#include "identify/records/swings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dualdamp::identify {

namespace {

double mean_of(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  return mean;
}

/// At least one.
int mean_crossings(const std::vector<double>& samples) {
  const double mean = mean_of(samples);
  const double margin = 0.1 * largest_swing(samples);
  int crossings = 0;
  int side = 0;
  for (const double value : samples) {
    const int now = value > mean + margin ? 1 : value < mean - margin ? -1 : side;
    if (side != 0 && now != side) ++crossings;
    side = now;
  }
  return std::max(crossings, 1);
}

}  // namespace

double largest_swing(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value - mean));
  return result;
}

double swings_of(const std::vector<double>& values) { return 0.5 * mean_crossings(values); }

double crossing_frequency(const std::vector<double>& samples, double duration) {
  return std::numbers::pi * mean_crossings(samples) / duration;
}

}  // namespace dualdamp::identify
