#include "identify/records/held_path.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t block = 8;

using Stretch = std::pair<std::size_t, std::size_t>;

double mean_of(std::span<const double> samples, std::size_t begin, std::size_t end) {
  return std::accumulate(samples.begin() + static_cast<std::ptrdiff_t>(begin),
                         samples.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
         static_cast<double>(end - begin);
}

/// How far the mean of a block is from `level`, in standard errors. A signal without noise has that of rounding.
double distance(const WhiteSignal& signal, std::size_t begin, double level, double rounding) {
  const double error = std::max(signal.noise, rounding) / std::sqrt(static_cast<double>(block));
  return std::abs(mean_of(signal.samples, begin, begin + block) - level) / error;
}

/// A stretch without the ends at which the mean of a block is away from `level`.
Stretch trimmed(Stretch stretch, const WhiteSignal& signal, double level, double rounding) {
  constexpr double off = 1.0;  // two would lose some of the path at the ends
  auto [begin, end] = stretch;
  while (end - begin >= block && distance(signal, begin, level, rounding) > off) ++begin;
  while (end - begin >= block && distance(signal, end - block, level, rounding) > off) --end;
  return {begin, end};
}

/// Whether the means of the blocks scatter about `level` as their noise does. Sensors have some noise of low
/// frequency, too: up to twice the deviation counts as noise.
bool is_constant(const Stretch& stretch, const WhiteSignal& signal, double level, double rounding) {
  double square = 0.0;
  std::size_t count = 0;
  for (std::size_t begin = stretch.first; begin + block <= stretch.second; begin += block, ++count)
    square += std::pow(distance(signal, begin, level, rounding), 2);
  constexpr double most = 2.0;
  return square <= most * most * static_cast<double>(count);
}

double rounding_of(const WhiteSignal& signal) {
  constexpr double rounding = 1e-9;
  double largest = 0.0;
  for (const double value : signal.samples) largest = std::max(largest, std::abs(value));
  return rounding * largest;
}

}  // namespace

std::vector<Stretch> still_stretches(const std::vector<bool>& rests, const WhiteSignal& x, const WhiteSignal& v) {
  const double rounding_x = rounding_of(x);
  const double rounding_v = rounding_of(v);
  std::vector<Stretch> found;
  for (std::size_t begin = 0; begin < rests.size();) {
    std::size_t end = begin;
    while (end < rests.size() && rests[end]) ++end;
    Stretch stretch{begin, end};
    begin = std::max(end, begin + 1);
    if (stretch.second - stretch.first < block) continue;
    if (!v.samples.empty()) stretch = trimmed(stretch, v, 0.0, rounding_v);
    if (stretch.second - stretch.first < block) continue;
    if (!x.samples.empty()) {
      const auto at = [&](std::size_t i) { return x.samples.begin() + static_cast<std::ptrdiff_t>(i); };
      const std::size_t whole = stretch.second - stretch.first;
      stretch = trimmed(stretch, x, upper_median({at(stretch.first), at(stretch.second)}), rounding_x);
      // The middle of a creep passes through its median.
      if (2 * (stretch.second - stretch.first) < whole) continue;
    }
    if (stretch.second - stretch.first < block) continue;
    if (!v.samples.empty() && !is_constant(stretch, v, 0.0, rounding_v)) continue;
    if (!x.samples.empty() &&
        !is_constant(stretch, x, mean_of(x.samples, stretch.first, stretch.second), rounding_x))
      continue;
    found.push_back(stretch);
  }
  return found;
}

void hold(const std::vector<Stretch>& stretches, std::vector<double>& x, std::vector<double>& v) {
  for (const auto& [begin, end] : stretches) {
    const double mean = mean_of(x, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      x[i] = mean;
      v[i] = 0.0;
    }
  }
}

}  // namespace dualdamp::identify
