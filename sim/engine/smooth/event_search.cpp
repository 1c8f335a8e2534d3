#include "sim/engine/smooth/event_search.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <string>

#include "friction_models/law_fault.hpp"
#include "sim/engine/law_name.hpp"

namespace dualdamp::sim {

namespace {

/// Guards this close to zero, relative to their size, are zero: steps end at a crossing to within this.
constexpr double resolution = 1e-13;
/// The part of the longest step by which a motion is followed first to see where a guard goes.
constexpr double shortest_probe = 1e-20;
/// A guard that has grown by this part of what cancels in it has grown beyond rounding.
constexpr double risen = 1e-14;

}  // namespace

EventSearch::EventSearch(const Model& model, const Flow& flow) : model_(model), flow_(flow), guards_(model, flow) {}

void EventSearch::begin_interval(std::span<const double> X, double t, double force) {
  guards_.list(X, t);
  guards_.resolve_speeds_to(0.0);
  watches_.assign(guards_.size(), {});
  const bool sticks = !watches_.empty() && is<StickEnd>(guards_.ending(0));
  const double pulls = sticks ? force + flow_.limit(X, t) : 0.0;
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    if (is<SlipEnd>(guards_.ending(w))) watches_[w].scale = flow_.scales()[1];
    if (is<StickEnd>(guards_.ending(w))) watches_[w].scale = pulls;
  }
  if (guards_.may_be_of_laws()) size_up(X, t);
}

/// The size of a law's guard: its value and what the sizes of x, v and the states make of it; and the size of what
/// cancels in it now.
void EventSearch::size_up(std::span<const double> X, double t) {
  constexpr double part = 1e-3;
  std::vector<double> here;
  guards_.evaluate(X, t, here);
  const auto add = [&](const std::vector<double>& values, double factor, double present) {
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      if (!is<LawGuard>(guards_.ending(w))) continue;
      watches_[w].scale += factor * std::abs(values[w]);
      watches_[w].parts += present * std::abs(values[w]);
    }
  };
  state_.assign(X.begin(), X.end());
  for (std::size_t k = 0; k < X.size(); ++k) {
    state_[k] = X[k] + part * flow_.scales()[k];
    guards_.evaluate(state_, t, values_);
    for (std::size_t w = 0; w < here.size(); ++w) values_[w] -= here[w];
    add(values_, 1.0 / part, std::abs(X[k]) / (part * flow_.scales()[k]));
    state_[k] = X[k];
  }
  for (Watch& watch : watches_) watch.reach = watch.scale;
  add(here, 1.0, 1.0);
}

/// On the dense output of the step.
double EventSearch::value(std::size_t guard, const SmoothStep& step, double part) const {
  state_.resize(step.end.size());
  step.stepper.at(part, state_);
  return guards_.value(guard, state_, step.time(part));
}

/// Of a guard, `length` [s] after the start of the step by steps of the classical Runge-Kutta method. They would
/// not follow a creep, the speed of which stays as it is here.
double EventSearch::value_along_flow(std::size_t guard, const SmoothStep& step, double length, int steps) const {
  constexpr std::array<double, 4> next = {0.5, 0.5, 1.0, 0.0};
  constexpr std::array<double, 4> at = {0.0, 0.5, 0.5, 1.0};
  constexpr std::array<double, 4> weights = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const double s = length / steps;
  std::vector<double> X(step.begin.begin(), step.begin.end());
  std::vector<double> sum(X.size());
  rates_.resize(X.size());
  const bool creeps = guards_.would_creep(X, step.t);
  for (int i = 0; i < steps; ++i) {
    const double t = step.t + i * s;
    std::ranges::fill(sum, 0.0);
    state_ = X;
    for (std::size_t stage = 0; stage < weights.size(); ++stage) {
      flow_.evaluate(state_, t + at[stage] * s, rates_);
      if (creeps) rates_[1] = 0.0;
      for (std::size_t k = 0; k < X.size(); ++k) {
        sum[k] += weights[stage] * s * rates_[k];
        state_[k] = X[k] + next[stage] * s * rates_[k];
      }
    }
    for (std::size_t k = 0; k < X.size(); ++k) X[k] += sum[k];
  }
  return guards_.value(guard, X, step.t + length);
}

/// Whether a guard that is zero at the start of the interval goes negative: by where a step of the classical
/// Runge-Kutta method leads, a longer one where the first leaves it within rounding. At a release velocity and
/// acceleration may both be zero, so that a guard on the position begins with the third power of time, which a
/// method of second order does not see. The first step is shorter than any decay of a law; one that is longer than
/// a decay leads nowhere, which two steps of half the length show. A guard that rises beyond the rounding of what
/// cancels in it does not go negative at once, even if it stays within `level` of zero and falls later: a stiff
/// bond that the mass relieves and stretches again may do so, and where it moves hardly at all only the slope shows
/// it.
bool EventSearch::goes_negative(std::size_t guard, const SmoothStep& step, double value, double level) const {
  const double rounding = risen * watches_[guard].parts;
  const double longest = step.longest;
  if (guards_.rate(guard, step.begin, step.t, longest) * Guards::part_of_rate * longest > rounding) return false;
  for (double part = shortest_probe; part < 0.1; part *= 10.0) {
    const double length = part * longest;
    const double later = value_along_flow(guard, step, length, 1);
    const bool rises = later - value > rounding;
    if (std::abs(later) <= level && !rises) continue;
    const double again = value_along_flow(guard, step, length, 2);
    if (rises && std::abs(later - again) <= 0.5 * (again - value)) return false;
    if (std::abs(later) <= level) continue;
    return again < 0.0 && std::abs(later - again) <= 0.5 * std::abs(again);
  }
  return false;
}

/// What the step that ended at a mode change leaves to the interval after it: that law's guards are known no better
/// than by what they do in the time by which the step may have missed the change, however small they are there.
void EventSearch::note_landing(const Hit& hit, const SmoothStep& step) {
  const auto* guard = std::get_if<LawGuard>(&guards_.ending(hit.guard));
  if (guard == nullptr) return;
  const double error = resolution * watches_[hit.guard].scale;
  const double most = std::max(step.length, shortest_part * step.longest);
  const double rate = std::abs(guards_.rate(hit.guard, step.end, step.time(1.0), most));
  landing_ = {guard->law, error < rate * most ? error / rate : most};
}

/// Values within it of zero are zero at the start of the interval.
double EventSearch::level_at_start(std::size_t guard, const SmoothStep& step) const {
  return std::max(Guards::equal * watches_[guard].scale, landing_error(guard, step));
}

/// What the step before this interval left of a guard of the law that changed its mode there; of others 0.
double EventSearch::landing_error(std::size_t guard, const SmoothStep& step) const {
  const auto* of = std::get_if<LawGuard>(&guards_.ending(guard));
  if (of == nullptr || of->law != landing_.law || landing_.error == 0.0) return 0.0;
  return landing_.error * std::abs(guards_.rate(guard, step.begin, step.t, step.longest));
}

/// Whether a guard has its zero ahead, however near, so that a step finds it: a law asked to change its mode before
/// would see forces that do not belong together yet. Zero itself is known to the rounding of what cancels.
bool EventSearch::is_clearly_positive(std::size_t guard, const SmoothStep& step, double value) const {
  if (value > level_at_start(guard, step)) return true;
  return is<LawGuard>(guards_.ending(guard)) &&
         value > std::max(resolution * watches_[guard].parts, landing_error(guard, step));
}

std::optional<EventSearch::Hit> EventSearch::find_violated(const SmoothStep& step) const {
  std::vector<double> values;
  guards_.evaluate(step.begin, step.t, values);
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    const Ending& ending = guards_.ending(w);
    // The direction of a slip was decided by the forces.
    if (is<SlipEnd>(ending)) continue;
    if (is_clearly_positive(w, step, values[w])) continue;
    const double level = level_at_start(w, step);
    if (values[w] >= -level && (is<StickEnd>(ending) || !goes_negative(w, step, values[w], level))) continue;
    return Hit{w, 0.0};
  }
  return {};
}

bool EventSearch::coincides(const Hit& hit, const SmoothStep& step) const {
  const auto* guard = std::get_if<LawGuard>(&guards_.ending(hit.guard));
  if (guard == nullptr || !(landing_.error > 0.0)) return false;
  return guards_.value(hit.guard, step.begin, step.t) >= -level_at_start(hit.guard, step);
}

std::optional<EventSearch::Hit> EventSearch::find(const SmoothStep& step) {
  grazings_.clear();
  state_.resize(step.end.size());
  for (std::size_t k = 0; k < points; ++k) {
    const double part = static_cast<double>(k) / (points - 1);
    step.stepper.at(part, state_);
    guards_.evaluate(state_, step.time(part), values_);
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      watches_[w].values[k] = values_[w];
      watches_[w].scale = std::max(watches_[w].scale, std::abs(values_[w]));
    }
  }
  // The end of a slip is the first guard.
  if (flow_.direction() != friction::Direction::none) guards_.resolve_speeds_to(resolution * watches_[0].scale);
  std::optional<Hit> first;
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    const double part = first_negative(w, step);
    if (part < 0.0 || (first && (part >= first->part || cross_together(*first, part, step)))) continue;
    first = Hit{w, part};
  }
  return first;
}

/// Whether a guard that is found to cross a little later crosses at the same instant: a step that ends at `part`
/// ends on both. A slider that stops with the mass is such a case: what its spring still gives up is rounding.
/// Guards act in the order of the list then, the turn of the mass first, and rounding does not choose.
bool EventSearch::cross_together(const Hit& later, double part, const SmoothStep& step) const {
  return (later.part - part) * step.length <= resolution * step.longest &&
         std::abs(value(later.guard, step, part)) <= zero(later.guard, 0.0);
}

bool EventSearch::has_faded() const {
  constexpr double far = 1e-3;
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    if (!is<LawGuard>(guards_.ending(w))) continue;
    double largest = watches_[w].reach;
    for (const double value : watches_[w].values) largest = std::max(largest, std::abs(value));
    if (largest < far * watches_[w].scale) return true;
  }
  return false;
}

/// Where a guard crosses first, as a part of the step; below zero: nowhere.
double EventSearch::first_negative(std::size_t guard, const SmoothStep& step) {
  const Watch& w = watches_[guard];
  const double floor = -resolution * w.scale;
  const auto part = [](std::size_t k) { return static_cast<double>(k) / (points - 1); };
  Triple edge;
  // Of the points alone, none shows a minimum before the second or behind the last but one.
  if (falls_at_edge(guard, step, 0, edge)) {
    const double lowest = dip(guard, step, edge);
    if (lowest >= 0.0) return crossing(guard, step, 0.0, lowest);
  }
  for (std::size_t k = 1; k < points; ++k) {
    if (w.values[k] < floor) return crossing(guard, step, part(k - 1), part(k));
    if (k + 1 == points || w.values[k] > w.values[k - 1] || w.values[k] > w.values[k + 1]) continue;
    const double lowest =
        dip(guard, step, {{part(k - 1), part(k), part(k + 1)}, {w.values[k - 1], w.values[k], w.values[k + 1]}});
    if (lowest >= 0.0) return crossing(guard, step, part(k - 1), lowest);
  }
  if (falls_at_edge(guard, step, points - 1, edge)) {
    const double lowest = dip(guard, step, edge);
    if (lowest >= 0.0) return crossing(guard, step, part(points - 2), lowest);
  }
  return -1.0;
}

/// Whether a guard that is lowest, of the points, at the start or the end of the step falls from there into the
/// step, and may reach zero: three points around that minimum.
bool EventSearch::falls_at_edge(std::size_t guard, const SmoothStep& step, std::size_t edge, Triple& around) const {
  constexpr double near = 1e-5;
  const Watch& w = watches_[guard];
  const bool begins = edge == 0;
  const std::size_t next = begins ? 1 : edge - 1;
  const auto [least, largest] = std::ranges::minmax(w.values);
  // A guard that begins at zero rises from it; what lies just beside is rounding.
  if (begins && w.values[edge] <= Guards::equal * w.scale) return false;
  if (w.values[edge] > w.values[next] || w.values[edge] > largest - least) return false;
  const double at = begins ? near : 1.0 - near;
  const double beside = value(guard, step, at);
  if (!(beside < w.values[edge])) return false;
  const double part = static_cast<double>(next) / (points - 1);
  around = begins ? Triple{{0.0, at, part}, {w.values[edge], beside, w.values[next]}}
                  : Triple{{part, at, 1.0}, {w.values[next], beside, w.values[edge]}};
  return true;
}

/// Whether the minimum between these points goes below zero: where, as a part of the step; below zero when not. One
/// that only grazes is a grazing.
double EventSearch::dip(std::size_t guard, const SmoothStep& step, Triple around) {
  const Watch& w = watches_[guard];
  auto& [at, values] = around;
  const double before = values[0];
  const double after = values[2];
  for (int i = 0; i < 3; ++i) {
    const double left = (values[1] - values[0]) / (at[1] - at[0]);
    const double right = (values[2] - values[1]) / (at[2] - at[1]);
    const double bend = (right - left) / (at[2] - at[0]);
    const double lowest = 0.5 * (at[0] + at[1]) - 0.5 * left / bend;
    // Nearer than rounding lets a parabola tell.
    if (!(bend > 0.0 && lowest > at[0] && lowest < at[2]) || std::abs(lowest - at[1]) < 1e-9) break;
    const double there = value(guard, step, lowest);
    if (there < -resolution * w.scale) return lowest;
    const std::size_t replaced = lowest < at[1] ? 2 : 0;
    at[replaced] = at[1];
    values[replaced] = values[1];
    at[1] = lowest;
    values[1] = there;
  }
  const double grazed = 100.0 * model_.solver.tolerance * w.scale;
  // A creep below that has no minimum that the dense output could tell from its own error.
  const double sides = values[1] + grazed;
  if (values[1] < grazed && before > sides && after > sides && !creeps_beside(guard, step, at))
    grazings_.push_back({static_cast<int>(guard), at[1] * step.length});
  return -1.0;
}

/// Whether the mass creeps beside a minimum of its speed: there the forces stand for the speed, and a minimum where
/// the one takes over from the other is none.
bool EventSearch::creeps_beside(std::size_t guard, const SmoothStep& step, const std::array<double, 3>& at) const {
  if (!is<SlipEnd>(guards_.ending(guard))) return false;
  return std::ranges::any_of(at, [&](double part) {
    step.stepper.at(part, state_);
    return guards_.creeps(state_, step.time(part));
  });
}

/// The root between a point where the guard counts as positive and one where it is negative. At the start of a
/// interval a guard may be zero: it is positive just after.
double EventSearch::crossing(std::size_t guard, const SmoothStep& step, double before, double negative) const {
  double low = before;
  double value_low = value(guard, step, low);
  if (value_low <= 0.0 && before > 0.0) return before;
  for (double part = 0.5 * negative; value_low <= 0.0; part *= 0.5) {
    if (part < 1e-12) return 0.0;
    if (low > 0.0) negative = low;
    low = part;
    value_low = value(guard, step, low);
  }
  const double value_negative = value(guard, step, negative);
  if (value_negative > 0.0) {
    const auto* of = std::get_if<LawGuard>(&guards_.ending(guard));
    throw friction::LawFault("a guard of " + (of != nullptr ? name_in_list(model_, of->law) : "a friction law") +
                             " changed its sign between two calls for the same instant, t = " +
                             std::to_string(flow_.time(step.time(negative))) + " s");
  }
  std::uintmax_t iterations = 60;
  const auto [left, right] = boost::math::tools::toms748_solve(
      [&](double part) { return value(guard, step, part); }, low, negative, value_low, value_negative,
      boost::math::tools::eps_tolerance<double>(48), iterations);
  return 0.5 * (left + right);
}

bool EventSearch::ends_against_flow(const Hit& hit, const SmoothStep& step) const {
  if (!is<SlipEnd>(guards_.ending(hit.guard))) return false;
  constexpr double clear = 1e-6;
  rates_.resize(step.begin.size());
  flow_.evaluate(step.begin, step.t, rates_);
  const double before = std::abs(rates_[1]);
  state_.resize(step.end.size());
  step.stepper.at(hit.part, state_);
  state_[1] = 0.0;
  flow_.evaluate(state_, step.time(hit.part), rates_);
  return friction::sign(flow_.direction()) * rates_[1] > clear * before;
}

/// A slip that ends and begins again within one step may be the dense output alone: it swings below zero where the
/// velocity begins with a high power of time, as under a level that falls steeply at v = 0. Nor does a slip end
/// where it begins while the forces drive it on: the step passed over a swing that is within its error. A shorter
/// step swings less; a true reversal is met by a step that ends in it.
bool EventSearch::may_be_swing_of_output(const Hit& hit, const SmoothStep& step) const {
  if (!is<SlipEnd>(guards_.ending(hit.guard)) || !(step.length > shortest_part * step.longest)) return false;
  if (watches_[hit.guard].values.back() > 0.0) return true;
  if (hit.part != 0.0) return false;
  const double sign = friction::sign(flow_.direction());
  rates_.resize(step.begin.size());
  flow_.evaluate(step.begin, step.t, rates_);
  if (!(sign * rates_[1] > 0.0)) return false;
  // A steep dashpot turns the force over at once.
  constexpr double soon = 1e-6;
  state_.assign(step.begin.begin(), step.begin.end());
  for (std::size_t k = 0; k < state_.size(); ++k) state_[k] += soon * step.length * rates_[k];
  flow_.evaluate(state_, step.time(soon), rates_);
  return sign * rates_[1] > 0.0;
}

/// A law judges by the terms of its own force, which may be far below the size of the motion: a mass that rests
/// near the origin after it was far away. An implicit step knows its end to a thousandth of what is allowed; a law
/// with guards may stop its slider here too and is told the time as well as it can be.
double EventSearch::zero(std::size_t guard, double speed) const {
  const Watch& watch = watches_[guard];
  const Ending& ending = guards_.ending(guard);
  const double size = is<LawGuard>(ending) ? std::min(watch.scale, watch.parts) : watch.scale;
  const double known = watches_.size() == 1 && is<SlipEnd>(ending) ? 1e-3 * speed : 0.0;
  return std::max(0.1 * resolution * size, known);
}

}  // namespace dualdamp::sim
