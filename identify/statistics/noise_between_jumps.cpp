#include "identify/statistics/noise_between_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

/// Samples of a fourth difference.
constexpr std::size_t reach_of_difference = 5;

/// Those of the values that share no sample with one beyond `largest`.
std::vector<double> away_from_larger(const std::vector<double>& values, double largest) {
  std::vector<double> kept;
  std::size_t clear = 0;  // of the larger ones so far
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] > largest)) {
      if (i >= clear) kept.push_back(values[i]);
      continue;
    }
    // Those before it that were kept since the last larger one.
    const std::size_t since = i > clear ? i - clear : 0;
    kept.resize(kept.size() - std::min(since, reach_of_difference - 1));
    clear = i + reach_of_difference;
  }
  return kept;
}

}  // namespace

double noise_between_jumps(std::span<const double> signal) {
  if (signal.size() < reach_of_difference) return 0.0;
  std::vector<double> differences;  // in units of the noise
  for (std::size_t i = 0; i + reach_of_difference <= signal.size(); ++i)
    differences.push_back(noise_level(signal.subspan(i, reach_of_difference)));
  constexpr int most_rounds = 10;
  constexpr double settled = 1e-3;
  constexpr std::size_t least_part = 4;
  std::vector<double> kept = differences;
  double deviation = median_deviation(kept);
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<double> away = away_from_larger(differences, most_of_noise * deviation);
    if (away.size() < differences.size() / least_part || away.empty()) break;
    kept = std::move(away);
    const double before = deviation;
    deviation = median_deviation(kept);
    if (!(deviation < (1.0 - settled) * before)) break;
  }
  const auto [between, count] = noise_part(kept, deviation);
  // Fewer differences tell the noise less well. By chance alone, the ratio of the two has a standard deviation of
  // 0.6 over the root of their number.
  constexpr double beyond_chance = 2.0;
  const double of_all = robust_noise_level(signal);
  return between < (1.0 - beyond_chance / std::sqrt(count)) * of_all ? between : of_all;
}

}  // namespace dualdamp::identify
