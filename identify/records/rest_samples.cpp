#include "identify/records/rest_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

double noise_of_speed(const std::vector<double>& v) { return robust_noise_level(v); }

double noise_of_speed(const std::vector<double>& x, double rate, const std::optional<ZeroPhaseFilter>& filter) {
  // White noise behind linear operations: the root of the sum of squares of their answer to one sample of 1.
  constexpr std::size_t half = 200;
  std::vector<double> answer(2 * half + 1, 0.0);
  answer[half] = 1.0;
  if (filter) answer = (*filter)(answer);
  double square = 0.0;
  for (const double value : sharp_difference(answer, rate)) square += value * value;
  return robust_noise_level(x) * std::sqrt(square);
}

namespace {

/// Whether samples within four deviations of their noise rest. Those of a reversal lie along a line from one side
/// to the other: 2.3 deviations and the noise, of which the line makes up five sixths of the square.
bool stays(std::span<const double> v, double noise) {
  const double middle = 0.5 * static_cast<double>(v.size() - 1);
  double square = 0.0;
  double along = 0.0;
  double times = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double time = static_cast<double>(i) - middle;
    square += v[i] * v[i];
    along += v[i] * time;
    times += time * time;
  }
  constexpr double large = 1.6;
  constexpr double most = 0.6;
  return square <= std::pow(large * noise, 2) * static_cast<double>(v.size()) ||
         along * along <= most * square * times;
}

}  // namespace

std::vector<bool> rest_samples(std::span<const double> v, double noise, std::size_t spread) {
  double largest = 0.0;
  for (const double speed : v) largest = std::max(largest, std::abs(speed));
  constexpr double rounding = 1e-9;
  const auto is_zero = [&](std::size_t i) { return std::abs(v[i]) <= rounding * largest; };
  constexpr double wide = 4.0;
  const auto is_slow = [&](std::size_t i) { return is_zero(i) || std::abs(v[i]) <= wide * noise; };
  const auto is_among_slow = [&](std::size_t i) {
    return is_slow(i) || (i > 0 && i + 1 < v.size() && is_slow(i - 1) && is_slow(i + 1));
  };
  constexpr std::size_t least = 3;
  constexpr std::size_t least_noisy = 8;
  std::vector<bool> rests(v.size());
  const auto take_stretches = [&](const auto& belongs, const auto& counts) {
    for (std::size_t begin = 0; begin < v.size();) {
      std::size_t end = begin;
      while (end < v.size() && belongs(end)) ++end;
      const std::size_t wider = end - begin >= least ? spread : 0;
      if (end > begin && counts(begin, end))
        for (std::size_t i = begin - std::min(begin, wider); i < std::min(v.size(), end + wider); ++i)
          rests[i] = true;
      begin = std::max(end, begin + 1);
    }
  };
  take_stretches(is_zero, [](std::size_t, std::size_t) { return true; });
  // The filter correlates the noise over its spread.
  take_stretches(is_among_slow, [&](std::size_t begin, std::size_t end) {
    return end - begin >= least_noisy + 2 * spread && stays(v.subspan(begin, end - begin), noise);
  });
  return rests;
}

}  // namespace dualdamp::identify
