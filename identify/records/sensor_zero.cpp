#include "identify/records/sensor_zero.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

double mean_of(std::span<const double> values) {
  return std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
}

std::string subtract(double zero, std::vector<double>& x) {
  for (double& value : x) value -= zero;
  constexpr int digits = 4;
  return "x swings about " + core::format_number(zero, digits) +
         " in SI units, further from zero than friction could hold the mass: this value is taken as the zero of the "
         "sensor and subtracted";
}

}  // namespace

std::string remove_zero(History& history, DecayRecord& decay) {
  const std::vector<double>& extremes = decay.extremes;
  const std::size_t n = extremes.size();
  if (n < 3) return {};
  // The middle of the last three extremes, and the amount by which their swings shrink.
  const double first = extremes[n - 3];
  const double middle = extremes[n - 2];
  const double last = extremes[n - 1];
  const double zero = (first + 2.0 * middle + last) / 4.0;
  const double shrink = std::abs(first - middle) - std::abs(middle - last);
  if (!(std::abs(zero) > 0.5 * shrink) || !(shrink > 0.0)) return {};
  // If the swings shrink little, the middle is no better known than the extremes.
  constexpr double least = 0.02;
  if (std::abs(zero) < least * std::abs(extremes[0] - extremes[1])) return {};
  for (double& extreme : decay.extremes) extreme -= zero;
  return subtract(zero, history.x);
}

std::string remove_zero(History& history, double stiffness) {
  const bool has_force = !history.force.empty();
  if (history.x.empty() || (history.y.empty() && !has_force)) return {};
  if (stiffness == 0.0 || (has_force && std::isnan(stiffness))) return {};
  std::vector<double> drive(history.x.size(), 0.0);
  for (std::size_t i = 0; i < drive.size(); ++i)
    drive[i] = (history.y.empty() ? 0.0 : history.y[i]) + (has_force ? history.force[i] / stiffness : 0.0);
  const double rest = mean_of(drive);
  double square = 0.0;
  for (const double value : drive) square += (value - rest) * (value - rest);
  return remove_zero(history, rest, std::numbers::sqrt2 * std::sqrt(square / static_cast<double>(drive.size())));
}

std::string remove_zero(History& history, double rest, double amplitude) {
  if (history.x.empty()) return {};
  const auto [low, high] = std::ranges::minmax(history.x);
  const double zero = mean_of(history.x) - rest;
  constexpr double sliding = 1.3;
  if (std::abs(zero) < std::max(sliding * amplitude, 0.5 * (high - low))) return {};
  return subtract(zero, history.x);
}

}  // namespace dualdamp::identify
