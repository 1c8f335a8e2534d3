#include "identify/records/spikes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t neighbours = 2;  ///< on each side

/// The cubic through the four neighbours, at sample i.
double smooth_at(const std::vector<double>& signal, std::size_t i) {
  return (4.0 * (signal[i - 1] + signal[i + 1]) - (signal[i - 2] + signal[i + 2])) / 6.0;
}

std::vector<double> differences(const std::vector<double>& signal) {
  std::vector<double> list(signal.size(), 0.0);
  for (std::size_t i = neighbours; i + neighbours < signal.size(); ++i)
    list[i] = std::abs(signal[i] - smooth_at(signal, i));
  return list;
}

/// The smallest step between neighbouring samples: the resolution of a rounded signal.
double resolution_of(const std::vector<double>& signal) {
  double least = core::infinity;
  for (std::size_t i = 1; i < signal.size(); ++i)
    if (signal[i] != signal[i - 1]) least = std::min(least, std::abs(signal[i] - signal[i - 1]));
  return std::isfinite(least) ? least : 0.0;
}

/// The values within 20 samples of sample i.
std::vector<double> around(const std::vector<double>& list, std::size_t i) {
  constexpr std::size_t reach = 20;
  const auto begin = static_cast<std::ptrdiff_t>(i - std::min(i, reach));
  const auto end = static_cast<std::ptrdiff_t>(std::min(list.size(), i + reach + 1));
  return {list.begin() + begin, list.begin() + end};
}

/// The range from trough to peak around sample i, without its value.
double range_around(const std::vector<double>& signal, std::size_t i) {
  std::vector<double> others = around(signal, i);
  std::erase(others, signal[i]);
  const auto [low, high] = std::ranges::minmax(others);
  return high - low;
}

/// Second difference about sample i; nothing at the ends.
std::optional<double> bend(const std::vector<double>& signal, std::ptrdiff_t i) {
  if (i < 1 || i + 1 >= std::ssize(signal)) return std::nullopt;
  const auto at = static_cast<std::size_t>(i);
  return signal[at - 1] - 2.0 * signal[at] + signal[at + 1];
}

/// Whether the signal returns beside sample i. A spike of height h has the second differences h, -2 h, h; a corner,
/// as at the start and the end of a blow, has one, or two of one sign. Those of the smooth signal count as known
/// from two samples further on. Near an end of the signal no neighbour tells a step, which has two of both signs
/// side by side: there both beside must be those of a spike as high as the sample is `off`.
bool returns(const std::vector<double>& signal, std::size_t sample, double off) {
  const auto i = static_cast<std::ptrdiff_t>(sample);
  double smooth = 0.0;
  const std::optional<double> before = bend(signal, i - 2);
  const std::optional<double> after = bend(signal, i + 2);
  if (before || after) smooth = (before.value_or(0.0) + after.value_or(0.0)) / (before && after ? 2.0 : 1.0);
  const double here = *bend(signal, i) - smooth;
  const double earlier = *bend(signal, i - 1) - smooth;
  const double later = *bend(signal, i + 1) - smooth;
  const double back = here > 0.0 ? -1.0 : 1.0;
  if (!before || !after) return std::min(back * earlier, back * later) > 0.5 * off;
  const double beside = 0.5 * (earlier + later);
  constexpr double share = 0.25;  // half of it for a spike, none for a corner
  return here * beside < 0.0 && std::abs(beside) > share * std::abs(here);
}

}  // namespace

std::vector<Spike> spikes_of(const std::vector<double>& signal) {
  constexpr std::size_t fewest = 50;
  if (signal.size() < fewest) return {};
  constexpr double far = 8.0;
  constexpr double clearly = 1.3;
  const std::vector<double> off = differences(signal);
  const double deviation = std::max(median_deviation(off), resolution_of(signal));
  std::vector<Spike> spikes;
  for (std::size_t i = neighbours; i + neighbours < signal.size(); ++i) {
    if (!(off[i] > far * deviation) || !(off[i] > clearly * std::max(off[i - 1], off[i + 1]))) continue;
    const double noise = std::max(deviation, median_deviation(around(off, i)));
    // The acceleration jumps where the friction changes its sign. Without noise, this bend is many deviations off,
    // but small relative to the range.
    constexpr double share = 0.03;
    const bool large = off[i] > share * range_around(signal, i);
    if (large && off[i] > far * noise && returns(signal, i, off[i]))
      spikes.push_back({i, off[i] / noise, smooth_at(signal, i)});
  }
  return spikes;
}

std::vector<std::string> treat_spikes(std::vector<History>& histories, bool replace) {
  constexpr std::array<std::pair<std::string_view, std::vector<double> History::*>, 5> signals = {
      {{"y", &History::y}, {"x", &History::x}, {"v", &History::v}, {"a", &History::a}, {"force", &History::force}}};
  std::vector<std::string> sentences;
  for (History& history : histories) {
    for (const auto& [name, member] : signals) {
      std::vector<double>& signal = history.*member;
      const std::vector<Spike> spikes = spikes_of(signal);
      if (spikes.empty()) continue;
      if (replace)
        for (const Spike& spike : spikes) signal[spike.sample] = spike.smooth;
      constexpr int digits = 4;
      const double first = history.start + static_cast<double>(spikes.front().sample) / history.sample_rate;
      sentences.push_back(std::string(name) + (history.sweep.empty() ? "" : " of " + history.sweep) + " holds " +
                          std::to_string(spikes.size()) + (spikes.size() == 1 ? " spike" : " spikes") +
                          ", the first at t = " + core::format_number(first, digits) + " s, " +
                          core::format_number(spikes.front().deviations, 2) + " standard deviations off: " +
                          (replace ? "replaced by values from the neighbours" : "'robust' replaces them"));
    }
  }
  return sentences;
}

}  // namespace dualdamp::identify
