#include "bench/crosscheck/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace dualdamp::crosscheck {

namespace {

constexpr double amplification = 100.0;
/// Factor on the effect of another tolerance, of which the looser is ten times as far from the true motion.
constexpr double beyond_unresolved = 3.0;
/// With a larger allowed difference a comparison is meaningless.
constexpr double most_allowed = 1e-3;
/// Events closer than this fraction of the walk are coincident.
constexpr double same_instant = 1e-7;
/// Where the mass hardly moves, an event at the same position may be earlier or later by this fraction of the walk.
constexpr double slow_instant = 1e-4;

/// The largest |x| and |v| up to a twentieth of the walk after each sample, since a motion that has just begun
/// gives no size yet. Positions of events and speeds between the samples count, too.
struct WalkSizes {
  std::vector<double> x;
  std::vector<double> v;
};

WalkSizes sizes(const Walk& walk) {
  constexpr std::size_t ahead = walk_samples / 20;
  const std::size_t count = walk.samples.size();
  WalkSizes result{std::vector<double>(count), std::vector<double>(count)};
  double x = 0.0;
  double v = 0.0;
  std::size_t seen = 0;
  std::size_t event = 0;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (; seen < std::min(count, i + ahead + 1); ++seen) {
      const sim::Sample& sample = walk.samples[seen];
      x = std::max(x, std::abs(sample.x));
      v = std::max(v, std::abs(sample.v));
      for (; event < walk.events.size() && walk.events[event].t <= sample.t; ++event)
        x = std::max(x, std::abs(walk.events[event].x));
      for (; piece < walk.pieces.size() && walk.pieces[piece].end <= sample.t; ++piece)
        v = std::max(v, walk.pieces[piece].speed);
    }
    result.x[i] = x;
    result.v[i] = std::max(v, walk.slowest * x);
  }
  return result;
}

double ratio(double gap, double size) { return gap == 0.0 ? 0.0 : std::abs(gap) / size; }

std::string text_of(const std::vector<sim::Event>& list, std::size_t i) {
  if (i >= list.size()) return "no event";
  return fmt::format("{} at t = {:.17g} s, x = {:.10g} m", sim::name_of(list[i].kind), list[i].t, list[i].x);
}

/// Compares the events of two walks one after the other.
class Events {
 public:
  /// `window`: of time [s]; `speeds`: allowed differences of speed at the samples that are compared [m/s].
  Events(const Walk& a, const Walk& b, double window, std::vector<double> speeds)
      : a_(a), b_(b), window_(window), speeds_(std::move(speeds)) {
    if (a.samples.empty()) return;
    spacing_ = a.samples.front().t;
    slow_window_ = slow_instant * a.samples.back().t;
    const double size = sizes(a).x.back();
    place_ = 0.1 * same_instant * size;
    resolved_ = 1e-13 * size;
    turned_ = 10.0 * resolved_;
  }

  void compare(Difference& result);

 private:
  /// Numbers of events of both lists at the same instant.
  struct Cluster {
    std::size_t a = 0;
    std::size_t b = 0;
    bool at_rest = false;  ///< no single instant: the masses are at rest between them
  };

  [[nodiscard]] bool rest_between(double from, double to) const;
  [[nodiscard]] bool is_same(const sim::Event& a, const sim::Event& b) const;
  [[nodiscard]] Cluster cluster() const;
  [[nodiscard]] bool rests_beside(double t) const;
  [[nodiscard]] bool turns_at_guard() const;
  [[nodiscard]] std::optional<Cluster> ringing() const;
  [[nodiscard]] bool is_lone_switching(const Cluster& group) const;
  [[nodiscard]] bool name(const Cluster& group, Difference& result) const;

  const Walk& a_;
  const Walk& b_;
  double window_;
  std::vector<double> speeds_;
  double spacing_ = 0.0;
  double slow_window_ = 0.0;
  double place_ = 0.0;
  double resolved_ = -1.0;
  double turned_ = -1.0;
  std::size_t i_ = 0;  ///< next event of a
  std::size_t j_ = 0;  ///< next event of b
};

/// Whether neither velocity differs from zero by more than allowed, or neither position changes by more than
/// engines resolve.
bool Events::rest_between(double from, double to) const {
  if (std::max(way(a_, from, to), way(b_, from, to)) <= resolved_) return true;
  if (speeds_.empty()) return false;
  const auto last = static_cast<double>(speeds_.size() - 1);
  const auto index = static_cast<std::size_t>(std::clamp(std::floor(from / spacing_) - 1.0, 0.0, last));
  return is_slow(a_, from, to, speeds_[index]) && is_slow(b_, from, to, speeds_[index]);
}

bool Events::is_same(const sim::Event& a, const sim::Event& b) const {
  if (a.kind != b.kind) return false;
  const double shift = std::abs(a.t - b.t);
  return shift <= window_ || (shift <= slow_window_ && std::abs(a.x - b.x) <= place_);
}

Events::Cluster Events::cluster() const {
  Cluster result;
  const double none = std::numeric_limits<double>::infinity();
  const auto time_of = [&](const std::vector<sim::Event>& list, std::size_t k) {
    return k < list.size() ? list[k].t : none;
  };
  double last = std::min(time_of(a_.events, i_), time_of(b_.events, j_));
  for (;;) {
    const double t_a = time_of(a_.events, i_ + result.a);
    const double t_b = time_of(b_.events, j_ + result.b);
    const double next = std::min(t_a, t_b);
    if (next == none) return result;
    if (next > last + window_) {
      if (!rest_between(last, next)) return result;
      result.at_rest = true;
    }
    ++(t_a <= t_b ? result.a : result.b);
    last = std::max(last, next);
  }
}

/// Whether the masses are at rest from the event before to this one, or from this one to the next. At the start it
/// is always true: a mass that begins at rest may reverse.
bool Events::rests_beside(double t) const {
  if (t <= window_) return true;
  double before = 0.0;
  if (i_ > 0) before = std::max(before, a_.events[i_ - 1].t);
  if (j_ > 0) before = std::max(before, b_.events[j_ - 1].t);
  double after = std::min(a_.end, b_.end);
  for (const Walk* walk : {&a_, &b_}) {
    const auto next = std::ranges::upper_bound(walk->events, t, {}, &sim::Event::t);
    if (next != walk->events.end()) after = std::min(after, next->t);
  }
  return (before < t && rest_between(before, t)) || (after > t && rest_between(t, after));
}

/// Whether one computation has a mode change where the mass of the other turns just before it: by less than the
/// place at which a law changes its mode is known.
bool Events::turns_at_guard() const {
  if (i_ >= a_.events.size() || j_ >= b_.events.size()) return false;
  const sim::Event& a = a_.events[i_];
  const sim::Event& b = b_.events[j_];
  const auto is_pair = [](const sim::Event& one, const sim::Event& other) {
    return one.kind == sim::EventKind::switching && other.kind == sim::EventKind::reversal;
  };
  return (is_pair(a, b) || is_pair(b, a)) && std::abs(a.t - b.t) <= slow_window_ && std::abs(a.x - b.x) <= turned_;
}

/// The events until both lists go on together, where the mass hardly moves: it rings on behind such a turn, and the
/// other one does not. Nothing if they do not.
std::optional<Events::Cluster> Events::ringing() const {
  const sim::Event& first = a_.events[i_];
  const auto count_here = [&](const std::vector<sim::Event>& list, std::size_t from) {
    std::size_t end = from;
    while (end < list.size() && list[end].t <= first.t + slow_window_ && std::abs(list[end].x - first.x) <= place_)
      ++end;
    return end - from;
  };
  const Cluster result{count_here(a_.events, i_), count_here(b_.events, j_)};
  const std::size_t i = i_ + result.a;
  const std::size_t j = j_ + result.b;
  const bool both_end = i >= a_.events.size() && j >= b_.events.size();
  const bool go_on = i < a_.events.size() && j < b_.events.size() && is_same(a_.events[i], b_.events[j]);
  if (both_end || go_on) return result;
  return std::nullopt;
}

bool Events::is_lone_switching(const Cluster& group) const {
  const sim::Event& event = group.a == 1 ? a_.events[i_] : b_.events[j_];
  return group.a + group.b == 1 &&
         (event.kind == sim::EventKind::switching || event.kind == sim::EventKind::grazing);
}

/// Explains a difference of the events, if it can. Coincident events may be listed in another order, and an even
/// number of further ones (a stop and its release, two switchings) may be a grazing within rounding. A single
/// switching is no event of the mass: where both modes have the same force (at the start, while the mass sticks),
/// rounding decides which holds. A grazing does not change the motion. A mass that is at rest within the allowed
/// speed may reverse at any time.
bool Events::name(const Cluster& group, Difference& result) const {
  const bool is_lone = group.a + group.b == 1;
  const double t = group.a > 0 ? a_.events[i_].t : b_.events[j_].t;
  if (group.at_rest || (is_lone && !is_lone_switching(group) && rests_beside(t))) {
    ++result.resting;
  } else if (std::max(group.a, group.b) >= 2) {
    ++result.coincident;
  } else if (is_lone_switching(group)) {
    ++result.silent;
  } else {
    return false;
  }
  return true;
}

/// Compares the events up to `result.until`.
void Events::compare(Difference& result) {
  const auto is_over = [&](const std::vector<sim::Event>& list, std::size_t k) {
    return k >= list.size() || list[k].t > result.until - 2.0 * window_;
  };
  while (!is_over(a_.events, i_) || !is_over(b_.events, j_)) {
    if (i_ < a_.events.size() && j_ < b_.events.size() && is_same(a_.events[i_], b_.events[j_])) {
      ++i_;
      ++j_;
      continue;
    }
    const std::optional<Cluster> rings = turns_at_guard() ? ringing() : std::nullopt;
    const Cluster group = rings ? *rings : cluster();
    if (rings) {
      ++result.coincident;
    } else if (!name(group, result)) {
      result.fault = text_of(a_.events, i_) + "; the other: " + text_of(b_.events, j_);
      return;
    }
    i_ += group.a;
    j_ += group.b;
  }
}

}  // namespace

std::vector<double> deviation(const Walk& a, const Walk& b) {
  const auto [x, v] = sizes(a);
  std::vector<double> result(std::min(a.samples.size(), b.samples.size()));
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] =
        std::max(ratio(a.samples[i].x - b.samples[i].x, x[i]), ratio(a.samples[i].v - b.samples[i].v, v[i]));
  return result;
}

std::vector<double> resolution(const Walk& a, const Walk& b) {
  std::vector<double> result = deviation(a, b);
  const double end = std::min(a.end, b.end);
  const auto is_same = [&](const sim::Event& one, const sim::Event& other) {
    return one.kind == other.kind && std::abs(one.t - other.t) <= slow_instant * end;
  };
  const auto [first, second] = std::ranges::mismatch(a.events, b.events, is_same);
  double same_until = end;
  if (first != a.events.end()) same_until = std::min(same_until, first->t);
  if (second != b.events.end()) same_until = std::min(same_until, second->t);
  std::size_t count = 0;
  while (count < result.size() && a.samples[count].t <= same_until) ++count;
  result.resize(count);
  return result;
}

std::vector<double> approach(const Walk& motion, const Walk& other, const Walk& tighter) {
  constexpr double closer = 3.0;
  std::vector<double> result = deviation(motion, other);
  const std::vector<double> near = deviation(motion, tighter);
  result.resize(std::min(result.size(), near.size()));
  for (std::size_t i = 0; i < result.size(); ++i)
    if (!(closer * near[i] <= result[i])) result[i] = 0.0;
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

std::size_t first_parted(const Sensitivity& sensitivity) {
  const std::vector<double>& list = sensitivity.deviation;
  const auto parted =
      std::ranges::find_if(list, [](double share) { return !(amplification * share < most_allowed); });
  return static_cast<std::size_t>(parted - list.begin());
}

Difference difference(const Walk& a, const Walk& b, const Sensitivity& sensitivity, double tolerance) {
  Difference result;
  const std::vector<double> apart = deviation(a, b);
  const std::size_t count = std::min(apart.size(), sensitivity.deviation.size());
  const std::vector<double> sizes_of_v = sizes(a).v;
  std::vector<double> speeds;
  double course = 0.0;
  double unresolved = 0.0;
  double worst_share = -1.0;
  for (std::size_t i = 0; i < count; ++i) {
    course = std::max(course, sensitivity.deviation[i]);
    if (i < sensitivity.unresolved.size()) unresolved = std::max(unresolved, sensitivity.unresolved[i]);
    const double share = unresolved > tolerance ? beyond_unresolved : 1.0;
    const double allowed = tolerance + amplification * course + share * unresolved;
    // From here on times of events are not compared; positions may differ only by the effect of the tolerance.
    if (unresolved > tolerance && result.exception.empty()) {
      result.exception =
          fmt::format("unresolved: from t = {:.6g} s on another tolerance changes the motion by {:.1e}",
                      a.samples[i].t, unresolved);
    }
    if (!(allowed < most_allowed)) {
      if (result.exception.empty()) {
        result.exception = fmt::format(
            "sensitive: from t = {:.6g} s on a change of the data by {:.0e} changes the motion by {:.1e}",
            a.samples[i].t, sensitivity.change, course);
      }
      break;
    }
    if (result.exception.empty()) result.until = a.samples[i].t;
    speeds.push_back(allowed * sizes_of_v[i]);
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
  Events(a, b, std::min(window, most_allowed * length), std::move(speeds)).compare(result);
  result.same_events = result.fault.empty();
  if (worst_share > 1.0 || std::isnan(worst_share))
    result.fault = fmt::format("apart by {:.2e} of the motion at t = {:.10g} s, {:.1e} is allowed", result.worst,
                               result.at, result.allowed) +
                   (result.fault.empty() ? "" : "; first event: " + result.fault);
  return result;
}

}  // namespace dualdamp::crosscheck
