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

constexpr std::size_t longest_blow = 64;
/// Largest relative error of the impulse of a spline through n samples of a half sine, times n^2.
constexpr double half_sine_error = 0.8;

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
  if (length <= always) return true;
  const auto n = static_cast<double>(length);
  const double noise = 2.0 * robust_noise_level(x) / range_of(x);
  return half_sine_error / (n * n) > noise * std::sqrt(8.0 / static_cast<double>(x.size()));
}

/// `feet`: samples on each side of the blow that may belong to it.
bool is_quiet_outside(const std::vector<double>& pushes, const ShortBlow& blow, std::size_t feet, double peak) {
  const std::size_t rise = blow.first - std::min(blow.first, feet);
  const std::vector<double> before(pushes.begin(), pushes.begin() + static_cast<std::ptrdiff_t>(rise));
  const std::vector<double> after(pushes.begin() + static_cast<std::ptrdiff_t>(blow.end), pushes.end());
  return is_quiet(before, peak) && is_quiet(after, peak);
}

/// The only blow of a force that is quiet otherwise, if it has this many samples or fewer.
std::optional<ShortBlow> only_blow(const std::vector<double>& force, std::size_t longest) {
  constexpr std::size_t fewest = 32;
  constexpr double foot = 0.1;
  if (force.size() < fewest) return std::nullopt;
  const double zero = upper_median(force);
  std::vector<double> pushes(force.size());
  std::ranges::transform(force, pushes.begin(), [zero](double value) { return value - zero; });
  double peak = 0.0;
  for (const double push : pushes) peak = std::max(peak, std::abs(push));
  if (!(peak > 0.0)) return std::nullopt;
  const auto is_high = [&](double push) { return std::abs(push) > foot * peak; };
  const auto begin = std::ranges::find_if(pushes, is_high);
  const auto last = std::find_if(pushes.rbegin(), pushes.rend(), is_high).base();  // one behind it
  ShortBlow blow{.first = static_cast<std::size_t>(begin - pushes.begin()),
                 .last = static_cast<std::size_t>(last - pushes.begin()) - 1};
  if (blow.first == 0 || blow.samples() > longest) return std::nullopt;
  // Of a half sine a fifteenth of its length is below a tenth of its peak.
  const std::size_t feet = 2 + blow.samples() / 4;
  blow.end = blow.last + 1 + feet;
  if (2 * blow.end > pushes.size() || !is_quiet_outside(pushes, blow, feet, peak)) return std::nullopt;
  return blow;
}

std::string blow_text(const History& history, const ShortBlow& blow) {
  constexpr int digits = 4;
  const double time = history.start + static_cast<double>(blow.first) / history.sample_rate;
  return "the blow of force at t = " + core::format_number(time, digits) + " s has " +
         std::to_string(blow.samples()) + (blow.samples() == 1 ? " sample" : " samples");
}

}  // namespace

std::optional<ShortBlow> short_blow(const std::vector<double>& force, const std::vector<double>& x) {
  if (force.size() != x.size()) return std::nullopt;
  const std::optional<ShortBlow> blow = only_blow(force, longest_blow);
  constexpr double most_of_motion = 0.5;
  const bool is_followed = blow && range_of(std::span(x).subspan(blow->end)) >= most_of_motion * range_of(x);
  return is_followed && is_short(blow->samples(), x) ? blow : std::nullopt;
}

std::optional<ShortBlow> short_blow(const History& history) {
  if (!history.x.empty()) return short_blow(history.force, history.x);
  if (!history.v.empty()) return short_blow(history.force, history.v);
  std::vector<double> a = history.a;
  const std::optional<ShortBlow> blow = only_blow(history.force, longest_blow);
  if (!blow || a.size() != history.force.size()) return std::nullopt;
  // The blow accelerates the mass far more than the spring does later.
  const std::size_t rise = blow->first - std::min(blow->first, blow->end - blow->last);
  std::fill(a.begin() + static_cast<std::ptrdiff_t>(rise), a.begin() + static_cast<std::ptrdiff_t>(blow->end),
            a[blow->end]);
  return short_blow(history.force, a);
}

std::string impulse_warning(const History& history, const ShortBlow& blow) {
  const auto n = static_cast<double>(blow.samples());
  return blow_text(history, blow) + ": its impulse may be wrong by " + core::percent(half_sine_error / (n * n), 2) +
         ", and the estimates by as much or more";
}

std::vector<std::string> leave_out_short_blow(History& history, const ShortBlow& blow) {
  std::vector<std::string> warnings = {
      blow_text(history, blow) +
      ", too few to know its impulse: force is left out, and the motion after it is read as a free vibration"};
  history.force.clear();
  if (std::string kept =
          keep_free_motion(history, blow.end, std::max({history.x.size(), history.v.size(), history.a.size()}));
      !kept.empty())
    warnings.push_back(std::move(kept));
  return warnings;
}

std::vector<std::string> leave_out_short_blows(std::vector<History>& histories) {
  std::vector<std::string> warnings;
  for (History& history : histories) {
    if (!history.y.empty()) continue;
    const std::optional<ShortBlow> blow = short_blow(history.force, history.x);
    if (!blow) continue;
    for (const std::string& warning : leave_out_short_blow(history, *blow))
      warnings.push_back((history.sweep.empty() ? "" : "test '" + history.sweep + "': ") + warning);
  }
  return warnings;
}

}  // namespace dualdamp::identify
