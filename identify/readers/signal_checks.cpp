#include "identify/readers/signal_checks.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::identify {

namespace {

constexpr std::size_t fewest_at_end = 3;
constexpr double least_height = 0.01;
constexpr double resolutions = 3.0;

/// The smallest step between two samples, as an estimate of the resolution.
double resolution_of(std::span<const double> signal, double range) {
  double smallest = range;
  for (std::size_t i = 1; i < signal.size(); ++i)
    if (const double step = std::abs(signal[i] - signal[i - 1]); step > 0.0) smallest = std::min(smallest, step);
  return smallest;
}

Clipping clipping_at(std::span<const double> signal, double value, double range) {
  const double least = std::max(least_height * range, resolutions * resolution_of(signal, range));
  Clipping found;
  for (std::size_t i = 1; i < signal.size();) {
    std::size_t end = i;
    while (end < signal.size() && signal[end] == value) ++end;
    const std::size_t length = end - i;
    if (length >= fewest_at_end && end < signal.size()) {
      // A parabola that enters with this slope and leaves after this length is higher by slope length/4. The slope
      // is taken over half the length, in which a rounded top falls by at most three steps of the resolution.
      const std::size_t reach = std::max<std::size_t>(length / 2, 1);
      const double before = std::abs(value - signal[i > reach ? i - reach : 0]);
      const double after = std::abs(value - signal[std::min(end + reach - 1, signal.size() - 1)]);
      const double slope = std::min(before, after) / static_cast<double>(reach);
      if (0.25 * slope * static_cast<double>(length) > least) {
        if (found.places == 0) found.first = i;
        ++found.places;
        found.samples += length;
        found.value = value;
      }
    }
    i = end + 1;
  }
  return found;
}

}  // namespace

Clipping clipping_of(std::span<const double> signal) {
  if (signal.empty()) return {};
  const auto [low, high] = std::ranges::minmax(signal);
  const Clipping top = clipping_at(signal, high, high - low);
  const Clipping bottom = clipping_at(signal, low, high - low);
  if (top.places + bottom.places < 2) return {};
  Clipping all = top.places > 0 ? top : bottom;
  if (top.places > 0 && bottom.places > 0) all.first = std::min(top.first, bottom.first);
  all.samples = top.samples + bottom.samples;
  all.places = top.places + bottom.places;
  return all;
}

bool is_constant(std::span<const double> signal) {
  return std::ranges::adjacent_find(signal, std::ranges::not_equal_to{}) == signal.end();
}

}  // namespace dualdamp::identify
