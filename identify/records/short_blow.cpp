#include "identify/records/short_blow.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "core/numbers.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/turning_points.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t longest_blow = 64;
/// Largest relative error of the impulse of a spline through n samples of a half sine, times n^2.
constexpr double half_sine_error = 0.8;

/// Whether a force about zero is no more than noise of this level, or of its own.
bool is_quiet(std::span<const double> force, double peak) {
  if (force.empty()) return true;
  double sum = 0.0;
  for (const double value : force) sum += value * value;
  const double size = std::sqrt(sum / static_cast<double>(force.size()));
  // Noise that a filter has smoothed is larger than its differences say.
  constexpr double smoothed = 3.0;
  constexpr double share = 0.05;
  constexpr double rounding = 1e-3;
  constexpr std::size_t fewest = 32;  // that tell their noise
  return size < share * peak &&
         (force.size() < fewest || size <= std::max(smoothed * noise_level(force), rounding * peak));
}

double range_of_part(const std::vector<double>& x, const FreeVibration& part) {
  return range_of(std::span(x).subspan(part.first, part.samples()));
}

/// Whether the impulse of a blow of `length` samples is less known than the motion after it.
bool is_short(std::size_t length, const std::vector<double>& x) {
  constexpr std::size_t always = 12;
  if (length <= always) return true;
  const auto n = static_cast<double>(length);
  const double noise = 2.0 * robust_noise_level(x) / range_of(x);
  return half_sine_error / (n * n) > noise * std::sqrt(8.0 / static_cast<double>(x.size()));
}

/// Samples on each side of a blow that may belong to it. Of a half sine a fifteenth of its length is below a tenth
/// of its peak.
std::size_t feet_of(const Blow& blow) { return 2 + blow.samples() / 4; }

std::size_t rise_of(const Blow& blow) { return blow.first - std::min(blow.first, feet_of(blow)); }

double peak_of(std::span<const double> pushes) {
  double peak = 0.0;
  for (const double push : pushes) peak = std::max(peak, std::abs(push));
  return peak;
}

/// The samples above a tenth of the largest value within [first, last).
Blow blow_within(const std::vector<double>& pushes, std::size_t first, std::size_t last) {
  constexpr double foot = 0.1;
  const double least = foot * peak_of(std::span(pushes).subspan(first, last - first));
  while (!(std::abs(pushes[first]) > least)) ++first;
  while (!(std::abs(pushes[last - 1]) > least)) --last;
  Blow blow{.first = first, .last = last - 1};
  blow.end = last + feet_of(blow);
  return blow;
}

/// The blows of a force about zero.
std::vector<Blow> blows_of(const std::vector<double>& pushes) {
  constexpr double share = 0.05;
  constexpr double deviations = 6.0;
  constexpr double of_median = 1.4826;
  std::vector<double> sizes(pushes.size());
  std::ranges::transform(pushes, sizes.begin(), [](double push) { return std::abs(push); });
  const double least = std::max(share * peak_of(pushes), deviations * of_median * upper_median(std::move(sizes)));
  std::vector<Blow> blows;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    if (!(std::abs(pushes[i]) > least)) continue;
    Blow blow{.first = i, .last = i};
    blow.end = i + 1 + feet_of(blow);
    // A hammer that bounces strikes again before a motion can be read.
    const bool goes_on = !blows.empty() && blows.back().end + feet_of(blow) >= i;
    blow = blow_within(pushes, goes_on ? blows.back().first : i, i + 1);
    (goes_on ? blows.back() : blows.emplace_back()) = blow;
  }
  return blows;
}

/// The parts of a motion between the blows, and after the last.
std::vector<FreeVibration> parts_after(const std::vector<Blow>& blows, std::size_t size) {
  std::vector<FreeVibration> parts;
  for (std::size_t i = 0; i < blows.size(); ++i) {
    const std::size_t last = i + 1 < blows.size() ? rise_of(blows[i + 1]) : size;
    const std::size_t first = std::min(blows[i].end, last);
    parts.push_back({first, last});
  }
  return parts;
}

/// The blows of a force that is quiet otherwise; empty if it is not, or if one is no blow.
std::vector<Blow> only_blows(const std::vector<double>& force) {
  constexpr std::size_t fewest = 32;
  if (force.size() < fewest) return {};
  const double zero = upper_median(force);
  std::vector<double> pushes(force.size());
  std::ranges::transform(force, pushes.begin(), [zero](double value) { return value - zero; });
  const double peak = peak_of(pushes);
  if (!(peak > 0.0)) return {};
  std::vector<Blow> blows = blows_of(pushes);
  const auto is_long = [](const Blow& blow) { return blow.samples() > longest_blow; };
  if (blows.empty() || blows.front().first == 0 || std::ranges::any_of(blows, is_long)) return {};
  std::vector<FreeVibration> quiet = parts_after(blows, force.size());
  quiet.push_back({0, rise_of(blows.front())});
  const auto is_driven = [&](const FreeVibration& part) {
    return !is_quiet(std::span(pushes).subspan(part.first, part.samples()), peak);
  };
  if (std::ranges::any_of(quiet, is_driven)) return {};
  return blows;
}

/// Sorts the parts after the blows into those that can be used and the others.
void choose_vibrations(const std::vector<double>& x, ShortBlows& found) {
  constexpr std::size_t fewest = 16;
  constexpr std::size_t shorter = 4;
  constexpr double smaller = 0.05;
  constexpr double most_of_motion = 0.5;
  const std::vector<FreeVibration> parts = parts_after(found.blows, x.size());
  std::size_t longest = 0;
  double largest = 0.0;
  for (const FreeVibration& part : parts) {
    longest = std::max(longest, part.samples());
    if (part.samples() >= fewest) largest = std::max(largest, range_of_part(x, part));
  }
  std::size_t samples = 0;
  for (const FreeVibration& part : parts) {
    const bool is_used = part.samples() >= fewest && shorter * part.samples() >= longest &&
                         range_of_part(x, part) >= smaller * largest;
    (is_used ? found.vibrations : found.unused).push_back(part);
    if (is_used) samples += part.samples();
  }
  if (2 * samples < x.size() || largest < most_of_motion * range_of(x)) found.vibrations.clear();
}

std::string list_of_times(const History& history, const std::vector<Blow>& blows) {
  constexpr int digits = 4;
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, blows.size()); ++i)
    text += (i > 0 ? ", " : "") +
            core::format_number(history.start + static_cast<double>(blows[i].first) / history.sample_rate, digits);
  return text + (blows.size() > most ? ", ..." : "");
}

std::string blows_text(const History& history, const std::vector<Blow>& blows) {
  const auto [fewest, most] = std::ranges::minmax(blows, {}, &Blow::samples);
  const std::string count = std::to_string(fewest.samples()) +
                            (most.samples() > fewest.samples() ? " to " + std::to_string(most.samples()) : "") +
                            (most.samples() == 1 ? " sample" : " samples");
  const std::string times = " of force at t = " + list_of_times(history, blows) + " s ";
  if (blows.size() == 1) return "the blow" + times + "has " + count;
  return "the " + std::to_string(blows.size()) + " blows" + times + "have " + count;
}

History part_of(const History& history, const FreeVibration& part, std::string& kept) {
  History free = history;
  free.force.clear();
  kept = keep_free_motion(free, part.first, part.last);
  free.begins_free = true;
  return free;
}

std::string unused_text(const History& history, const std::vector<FreeVibration>& unused) {
  constexpr int digits = 4;
  const auto time = [&](std::size_t sample) {
    return core::format_number(history.start + static_cast<double>(sample) / history.sample_rate, digits);
  };
  std::string text;
  for (const FreeVibration& part : unused)
    text += (text.empty() ? "" : ", ") + time(part.first) + " to " + time(part.last);
  return "the motion from t = " + text + " s is too short or too small beside the others, and is not used";
}

}  // namespace

std::optional<ShortBlows> short_blows(const std::vector<double>& force, const std::vector<double>& x) {
  if (force.size() != x.size()) return std::nullopt;
  ShortBlows found;
  found.blows = only_blows(force);
  if (std::ranges::none_of(found.blows, [&](const Blow& blow) { return is_short(blow.samples(), x); }))
    return std::nullopt;
  choose_vibrations(x, found);
  return found;
}

std::optional<ShortBlows> short_blows(const History& history) {
  if (!history.x.empty()) return short_blows(history.force, history.x);
  if (!history.v.empty()) return short_blows(history.force, history.v);
  std::vector<double> a = history.a;
  if (a.size() != history.force.size()) return std::nullopt;
  // A blow accelerates the mass far more than the spring does later.
  for (const Blow& blow : only_blows(history.force)) {
    const std::size_t end = std::min(blow.end, a.size());
    for (std::size_t i = rise_of(blow); i < end; ++i) a[i] = a[std::min(end, a.size() - 1)];
  }
  return short_blows(history.force, a);
}

std::string impulse_warning(const History& history, const ShortBlows& found) {
  const auto n = static_cast<double>(std::ranges::min(found.blows, {}, &Blow::samples).samples());
  const bool is_one = found.blows.size() == 1;
  return blows_text(history, found.blows) + (is_one ? ": its impulse" : ": an impulse") + " may be wrong by " +
         core::percent(half_sine_error / (n * n), 2) + ", and the estimates by as much or more";
}

std::vector<History> without_blows(const History& history, const ShortBlows& found,
                                   std::vector<std::string>& warnings) {
  const bool is_one = found.blows.size() == 1;
  const std::size_t count = found.vibrations.size();
  warnings.push_back(
      blows_text(history, found.blows) + ", too few to know " + (is_one ? "its impulse" : "their impulses") +
      ": force is left out, and the motion after " +
      (is_one ? "it is read as a free vibration"
              : "them is read as " + std::to_string(count) +
                    (count == 1 ? " free vibration" : " free vibrations, each with a first state of its own")));
  if (!found.unused.empty()) warnings.push_back(unused_text(history, found.unused));
  std::vector<History> parts;
  for (const FreeVibration& vibration : found.vibrations) {
    std::string kept;
    parts.push_back(part_of(history, vibration, kept));
    if (count == 1) warnings.push_back(std::move(kept));
    const auto blow = std::ranges::find_if(found.blows, [&](const Blow& b) { return b.end == vibration.first; });
    if (count > 1)
      parts.back().sweep +=
          (history.sweep.empty() ? "blow " : ", blow ") + std::to_string(blow - found.blows.begin() + 1);
  }
  return parts;
}

std::vector<std::string> leave_out_short_blows(std::vector<History>& histories) {
  std::vector<std::string> warnings;
  std::vector<History> all;
  int number = 0;
  for (History& history : histories) {
    ++number;
    const std::optional<ShortBlows> found =
        history.y.empty() ? short_blows(history.force, history.x) : std::nullopt;
    std::vector<std::string> done;
    if (found && found->vibrations.empty()) done.push_back(impulse_warning(history, *found));
    const std::string name = history.sweep.empty() ? "" : "test '" + history.sweep + "': ";
    if (!found || found->vibrations.empty())
      all.push_back(std::move(history));
    else
      for (History& part : without_blows(history, *found, done)) {
        part.part_of = number;
        all.push_back(std::move(part));
      }
    for (const std::string& warning : done) warnings.push_back(name + warning);
  }
  histories = std::move(all);
  return warnings;
}

}  // namespace dualdamp::identify
