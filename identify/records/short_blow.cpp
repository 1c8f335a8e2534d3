#include "identify/records/short_blow.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/numbers.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

/// Whether a force about zero is no more than noise of this level, or of its own.
bool is_quiet(const std::vector<double>& force, double peak) {
  constexpr std::size_t fewest = 8;
  if (force.size() < fewest) return true;
  double sum = 0.0;
  for (const double value : force) sum += value * value;
  const double size = std::sqrt(sum / static_cast<double>(force.size()));
  // Noise that a filter has smoothed is larger than its differences say.
  constexpr double smoothed = 3.0;
  constexpr double share = 0.05;
  constexpr double rounding = 1e-3;
  return size < share * peak && size <= std::max(smoothed * noise_level(force), rounding * peak);
}

double range_of(std::span<const double> x) {
  const auto [low, high] = std::ranges::minmax(x);
  return high - low;
}

/// Whether the impulse of a blow of `length` samples is less known than the motion after it.
bool is_short(std::size_t length, const std::vector<double>& x) {
  constexpr std::size_t always = 12;
  constexpr std::size_t longest = 64;
  if (length <= always || length > longest) return length <= always;
  const auto n = static_cast<double>(length);
  const double noise = 2.0 * robust_noise_level(x) / range_of(x);
  return 0.8 / (n * n) > noise * std::sqrt(8.0 / static_cast<double>(x.size()));
}

}  // namespace

std::optional<ShortBlow> short_blow(const std::vector<double>& force, const std::vector<double>& x) {
  constexpr std::size_t fewest = 32;
  constexpr double foot = 0.1;
  if (force.size() < fewest || force.size() != x.size()) return std::nullopt;
  const double zero = upper_median(force);
  std::vector<double> pushes(force.size());
  std::ranges::transform(force, pushes.begin(), [zero](double value) { return value - zero; });
  double peak = 0.0;
  for (const double push : pushes) peak = std::max(peak, std::abs(push));
  if (!(peak > 0.0)) return std::nullopt;
  const auto is_high = [&](double push) { return std::abs(push) > foot * peak; };
  const auto begin = std::ranges::find_if(pushes, is_high);
  const auto last = std::find_if(pushes.rbegin(), pushes.rend(), is_high).base();  // one behind it
  const auto length = static_cast<std::size_t>(last - begin);
  if (begin == pushes.begin() || !is_short(length, x)) return std::nullopt;
  ShortBlow blow{.first = static_cast<std::size_t>(begin - pushes.begin())};
  blow.last = blow.first + length - 1;
  // Of a half sine a fifteenth of its length is below a tenth of its peak.
  const std::size_t feet = 2 + length / 4;
  blow.end = blow.last + 1 + feet;
  if (2 * blow.end > pushes.size()) return std::nullopt;
  constexpr double most_of_motion = 0.5;
  if (range_of(std::span(x).subspan(blow.end)) < most_of_motion * range_of(x)) return std::nullopt;
  const std::size_t rise = blow.first - std::min(blow.first, feet);
  const std::vector<double> before(pushes.begin(), pushes.begin() + static_cast<std::ptrdiff_t>(rise));
  const std::vector<double> after(pushes.begin() + static_cast<std::ptrdiff_t>(blow.end), pushes.end());
  if (!is_quiet(before, peak) || !is_quiet(after, peak)) return std::nullopt;
  return blow;
}

std::vector<std::string> leave_out_short_blows(std::vector<History>& histories) {
  std::vector<std::string> warnings;
  for (History& history : histories) {
    if (!history.y.empty()) continue;
    const std::optional<ShortBlow> blow = short_blow(history.force, history.x);
    if (!blow) continue;
    constexpr int digits = 4;
    const double time = history.start + static_cast<double>(blow->first) / history.sample_rate;
    const std::size_t count = blow->last - blow->first + 1;
    std::string warning = history.sweep.empty() ? "" : "test '" + history.sweep + "': ";
    warning +=
        "the blow of force at t = " + core::format_number(time, digits) + " s has " + std::to_string(count) +
        (count == 1 ? " sample" : " samples") +
        ", too few to know its impulse: force is left out, and the motion after it is read as a free vibration";
    history.force.clear();
    warnings.push_back(std::move(warning));
    if (std::string kept = keep_free_motion(history, blow->end, history.x.size()); !kept.empty())
      warnings.push_back((history.sweep.empty() ? "" : "test '" + history.sweep + "': ") + std::move(kept));
  }
  return warnings;
}

}  // namespace dualdamp::identify
