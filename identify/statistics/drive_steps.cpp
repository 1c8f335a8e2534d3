#include "identify/statistics/drive_steps.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::identify {

namespace {

/// The value that three of four of these do not exceed in size.
double upper_quartile(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 3 / 4);
  std::ranges::nth_element(values, at);
  return *at;
}

void add_steps(const std::vector<double>& signal, std::vector<std::size_t>& steps) {
  constexpr std::size_t fewest = 16;
  if (signal.size() < fewest) return;
  const auto difference = [&](std::size_t i) { return signal[i + 1] - signal[i]; };
  // What a difference is beyond the mean of those beside it: of a step, all of it.
  std::vector<double> beyond(signal.size() - 1, 0.0);
  for (std::size_t i = 1; i + 2 < signal.size(); ++i)
    beyond[i] = difference(i) - 0.5 * (difference(i - 1) + difference(i + 1));
  constexpr double share = 0.03;  // of the range
  constexpr double times_usual = 5.0;
  constexpr double times_near = 4.0;
  constexpr double times_kink = 2.0;
  constexpr std::size_t wide = 5;
  const auto [low, high] = std::ranges::minmax(signal);
  const double least = std::max(share * (high - low), times_usual * upper_quartile(beyond));
  for (std::size_t i = 1; i + 2 < signal.size(); ++i) {
    // At a kink it is at most half of the change of the slope.
    const double kink = std::abs(difference(i + 1) - difference(i - 1));
    double near = 0.0;
    for (std::size_t j = i > wide ? i - wide : 1; j < std::min(i + wide + 1, beyond.size()); ++j)
      if (j + 1 < i || j > i + 1) near = std::max(near, std::abs(beyond[j]));
    if (std::abs(beyond[i]) > std::max({least, times_kink * kink, times_near * near})) steps.push_back(i);
  }
}

}  // namespace

std::vector<std::size_t> drive_steps(const History& history) {
  std::vector<std::size_t> steps;
  add_steps(history.y, steps);
  add_steps(history.force, steps);
  std::ranges::sort(steps);
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  constexpr std::size_t most = 4;
  if (steps.size() > most) steps.clear();
  return steps;
}

}  // namespace dualdamp::identify
