#include "identify/records/swings.hpp"

#include <Eigen/Core>
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

namespace {

/// A line through swings over their numbers.
struct SwingLine {
  double mean = 0.0, slope = 0.0, slope_error = 0.0, largest_distance = 0.0;  ///< distance of a swing from the mean
};

SwingLine line_through(const Eigen::ArrayXd& swing, double error) {
  const Eigen::Index n = swing.size();
  const double half = 0.5 * static_cast<double>(n - 1);
  const Eigen::ArrayXd u = Eigen::ArrayXd::LinSpaced(n, -half, half);
  SwingLine line{.mean = swing.mean(), .slope = (u * swing).sum() / u.square().sum()};
  const double scatter = (swing - line.mean - line.slope * u).square().sum() / static_cast<double>(n - 2);
  line.slope_error = std::sqrt(std::max(scatter, error * error) / u.square().sum());
  line.largest_distance = (swing - line.mean).abs().maxCoeff();
  return line;
}

Eigen::ArrayXd swings_between(std::span<const double> extremes) {
  const auto n = static_cast<Eigen::Index>(extremes.size()) - 1;
  const Eigen::Map<const Eigen::ArrayXd> x(extremes.data(), n + 1);
  return (x.tail(n) - x.head(n)).abs();
}

/// Of a swing, from those of its two ends.
double error_of_swings(std::span<const double> standard_errors) {
  const Eigen::Map<const Eigen::ArrayXd> errors(standard_errors.data(),
                                                static_cast<Eigen::Index>(standard_errors.size()));
  return std::sqrt(2.0 * errors.square().mean());
}

}  // namespace

bool swings_shrink(std::span<const double> extremes, std::span<const double> standard_errors) {
  constexpr std::size_t fewest = 8;
  if (extremes.size() <= fewest) return true;
  const SwingLine line = line_through(swings_between(extremes), error_of_swings(standard_errors));
  constexpr double deviations = 3.0;
  return line.slope < -deviations * line.slope_error;
}

std::size_t first_of_largest(std::span<const double> extremes, std::span<const double> standard_errors,
                             std::size_t first) {
  const auto swing = [&](std::size_t i) { return std::abs(extremes[i] - extremes[i - 1]); };
  const auto error = [&](std::size_t i) { return std::hypot(standard_errors[i], standard_errors[i - 1]); };
  std::size_t largest = first;
  for (std::size_t i = first + 1; i < extremes.size(); ++i)
    if (swing(i) > swing(largest)) largest = i;
  constexpr double deviations = 4.0;
  for (std::size_t i = first; i < largest; ++i)
    if (swing(largest) - swing(i) < deviations * std::hypot(error(i), error(largest))) return i;
  return largest;
}

std::size_t steady_swings(std::span<const double> extremes, std::span<const double> standard_errors) {
  constexpr std::size_t fewest = 6;
  constexpr double equal = 0.01;
  constexpr double deviations = 4.0;
  constexpr double faster = 8.0;
  constexpr std::size_t hidden = 2;  // that the drive leaves within the errors of equal ones
  std::size_t steady = 0;
  if (extremes.size() < 2 * fewest + 1) return 0;
  const Eigen::ArrayXd swings = swings_between(extremes);
  const double error = error_of_swings(standard_errors);
  for (std::size_t n = fewest; n + fewest < extremes.size(); ++n) {
    const SwingLine before = line_through(swings.head(static_cast<Eigen::Index>(n)), error);
    if (before.largest_distance > std::max(equal * before.mean, deviations * error)) break;
    const SwingLine behind =
        line_through(swings.segment(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(fewest)), error);
    const double least =
        faster * std::abs(before.slope) + deviations * std::hypot(before.slope_error, behind.slope_error);
    if (-behind.slope > least) steady = n + hidden;
  }
  return steady;
}

}  // namespace dualdamp::identify
