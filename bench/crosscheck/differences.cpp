#include "bench/crosscheck/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dualdamp::crosscheck {

namespace {

constexpr double amplification = 100.0;
/// A larger uncertainty says nothing any more.
constexpr double most_allowed = 1e-3;
/// Events this much of the walk apart are coincident.
constexpr double same_instant = 1e-7;
/// Where the mass hardly moves an event at the same place may be this much of the walk earlier or later.
constexpr double slow_instant = 1e-4;

/// The largest of |x| or |v| so far, a twentieth of the walk ahead: a motion that has just begun is not yet a size.
template <typename Member>
std::vector<double> sizes(const Walk& walk, Member member) {
  constexpr std::size_t ahead = walk_samples / 20;
  const std::size_t count = walk.samples.size();
  std::vector<double> result(count);
  double largest = 0.0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (; seen < std::min(count, i + ahead + 1); ++seen)
      largest = std::max(largest, std::abs(walk.samples[seen].*member));
    result[i] = largest;
  }
  return result;
}

double ratio(double gap, double size) { return gap == 0.0 ? 0.0 : std::abs(gap) / size; }

/// Those that end an interval; grazings are no events of the motion.
struct Cluster {
  std::size_t count_a = 0;
  std::size_t count_b = 0;
};

/// Events of both lists from `a` and `b` on that follow each other within `window`.
Cluster cluster(const std::vector<sim::Event>& list_a, std::size_t a, const std::vector<sim::Event>& list_b,
                std::size_t b, double window) {
  Cluster result;
  double last = std::numeric_limits<double>::infinity();
  if (a < list_a.size()) last = std::min(last, list_a[a].t);
  if (b < list_b.size()) last = std::min(last, list_b[b].t);
  for (;;) {
    const std::size_t i = a + result.count_a;
    const std::size_t j = b + result.count_b;
    const bool takes_a = i < list_a.size() && list_a[i].t <= last + window;
    const bool takes_b = j < list_b.size() && list_b[j].t <= last + window;
    if (!takes_a && !takes_b) return result;
    if (takes_a && (!takes_b || list_a[i].t <= list_b[j].t)) {
      last = std::max(last, list_a[i].t);
      ++result.count_a;
    } else {
      last = std::max(last, list_b[j].t);
      ++result.count_b;
    }
  }
}

std::string text_of(const std::vector<sim::Event>& list, std::size_t i) {
  if (i >= list.size()) return "no event";
  return fmt::format("{} at t = {:.17g} s, x = {:.10g} m", sim::name(list[i].kind), list[i].t, list[i].x);
}

/// The same event of both walks. `window`: of time [s]; `place`: of position [m].
bool is_same(const sim::Event& a, const sim::Event& b, double window, double slow_window, double place) {
  if (a.kind != b.kind) return false;
  const double shift = std::abs(a.t - b.t);
  return shift <= window || (shift <= slow_window && std::abs(a.x - b.x) <= place);
}

bool is_switching(const std::vector<sim::Event>& list, std::size_t i) {
  return i < list.size() && list[i].kind == sim::EventKind::switching;
}

/// Walks along both lists up to `result.until`. A group of events that coincide may be listed in another order, and
/// an even number of events more (a stop and its release, two switchings) may be a grazing within rounding. A
/// switching of a law alone is no event of the mass: where the two modes are one formula (at the start, while the
/// mass sticks) rounding decides which of them holds.
void compare_events(const Walk& a, const Walk& b, double window, Difference& result) {
  std::size_t i = 0;
  std::size_t j = 0;
  const double slow_window = slow_instant * (a.samples.empty() ? 0.0 : a.samples.back().t);
  const double place = 0.1 * same_instant * (a.samples.empty() ? 0.0 : sizes(a, &sim::Sample::x).back());
  const auto is_over = [&](const std::vector<sim::Event>& list, std::size_t k) {
    return k >= list.size() || list[k].t > result.until - 2.0 * window;
  };
  while (!is_over(a.events, i) || !is_over(b.events, j)) {
    if (i < a.events.size() && j < b.events.size() &&
        is_same(a.events[i], b.events[j], window, slow_window, place)) {
      ++i;
      ++j;
      continue;
    }
    const Cluster group = cluster(a.events, i, b.events, j, window);
    const bool coincide = std::max(group.count_a, group.count_b) >= 2;
    if (!coincide && is_switching(group.count_a == 1 ? a.events : b.events, group.count_a == 1 ? i : j)) {
      ++result.silent;
      i += group.count_a;
      j += group.count_b;
      continue;
    }
    if (!coincide) {
      result.fault = text_of(a.events, i) + "; the other: " + text_of(b.events, j);
      return;
    }
    ++result.coincident;
    i += group.count_a;
    j += group.count_b;
  }
}

}  // namespace

std::vector<double> deviation(const Walk& a, const Walk& b) {
  const std::vector<double> x = sizes(a, &sim::Sample::x);
  const std::vector<double> v = sizes(a, &sim::Sample::v);
  std::vector<double> result(std::min(a.samples.size(), b.samples.size()));
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] =
        std::max(ratio(a.samples[i].x - b.samples[i].x, x[i]), ratio(a.samples[i].v - b.samples[i].v, v[i]));
  return result;
}

void widen(Sensitivity& sensitivity, const Walk& motion, const Walk& perturbed) {
  const std::vector<double> other = deviation(motion, perturbed);
  std::vector<double>& known = sensitivity.deviation;
  if (known.empty()) {
    known = other;
  } else {
    known.resize(std::min(known.size(), other.size()));
    for (std::size_t i = 0; i < known.size(); ++i) known[i] = std::max(known[i], other[i]);
  }
  for (std::size_t i = 0; i < std::min(motion.events.size(), perturbed.events.size()); ++i) {
    if (motion.events[i].kind != perturbed.events[i].kind) break;
    sensitivity.event_shift =
        std::max(sensitivity.event_shift, std::abs(motion.events[i].t - perturbed.events[i].t));
  }
}

Difference difference(const Walk& a, const Walk& b, const Sensitivity& sensitivity, double tolerance) {
  Difference result;
  const std::vector<double> apart = deviation(a, b);
  const std::size_t count = std::min(apart.size(), sensitivity.deviation.size());
  double course = 0.0;
  double worst_share = -1.0;
  for (std::size_t i = 0; i < count; ++i) {
    course = std::max(course, sensitivity.deviation[i]);
    const double allowed = tolerance + amplification * course;
    if (!(allowed < most_allowed)) {
      result.exception =
          fmt::format("from t = {:.6g} s on a change of the data by {:.0e} changes the motion by {:.1e}",
                      a.samples[i].t, sensitivity.change, course);
      break;
    }
    result.until = a.samples[i].t;
    if (apart[i] / allowed > worst_share || std::isnan(apart[i])) {
      worst_share = apart[i] / allowed;
      result.worst = apart[i];
      result.at = a.samples[i].t;
      result.allowed = allowed;
    }
    if (!(apart[i] <= allowed)) break;
  }
  const double length = a.samples.empty() ? 0.0 : a.samples.back().t;
  const double window = std::max(same_instant * length, amplification * sensitivity.event_shift);
  compare_events(a, b, std::min(window, most_allowed * length), result);
  if (worst_share > 1.0 || std::isnan(worst_share))
    result.fault = fmt::format("apart by {:.2e} of the motion at t = {:.10g} s, {:.1e} is allowed", result.worst,
                               result.at, result.allowed) +
                   (result.fault.empty() ? "" : "; first event: " + result.fault);
  return result;
}

}  // namespace dualdamp::crosscheck
