// Events of the smooth engine: guards watched on the dense output, landing on a crossing, what happens at v = 0.

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "friction_models/law_fault.hpp"
#include "sim/engine/smooth_engine.hpp"
#include "sim/engine/sticking_gate.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Guards this close to zero, relative to their size, are zero: steps end at a crossing to within this.
constexpr double resolution = 1e-13;
/// Crossings within this part of the longest step are at the start of the interval.
constexpr double shortest_part = 1e-15;
/// The part of the longest step by which a motion is followed first to see where a guard goes.
constexpr double shortest_probe = 1e-20;
/// Sums of forces within this part of their parts' sizes are equal.
constexpr double equal = 1e-12;
/// A guard that has grown by this part of what cancels in it has grown beyond rounding.
constexpr double risen = 1e-14;
/// Steps to a crossing, and the last correction of their length, as a part of it, where Newton's method converges.
constexpr int most_corrections = 5;
constexpr double settled = 1e-6;
/// The rate of a guard is a difference over this part of a step.
constexpr double part_of_rate = 1e-5;

}  // namespace

void SmoothEngine::build_watches() {
  watches_.clear();
  if (direction_ != Direction::none) {
    watches_.push_back({.ending = SlipEnd{}, .scale = flow_.scales()[1]});
  } else if (can_stick_) {
    const double scale = drive_.force_scale() + flow_.limit(X_, local_time_);
    for (const Direction release : {Direction::forward, Direction::backward})
      watches_.push_back({.ending = StickEnd{release}, .scale = scale});
  }
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (!has_memory_[i]) continue;
    guard_values_.clear();
    flow_.guards(i, X_, local_time_, guard_values_);
    for (std::size_t j = 0; j < guard_values_.size(); ++j) {
      watches_.push_back({.ending = LawGuard{i, static_cast<int>(j)}});
    }
  }
  size_up_guards();
}

/// The size of a law's guard: its value and what the sizes of x, v and the states make of it; and the size of what
/// cancels in it now.
void SmoothEngine::size_up_guards() {
  constexpr double part = 1e-3;
  if (!some_memory_) return;
  std::vector<double> here;
  evaluate_guards(X_, local_time_, here);
  const auto add = [&](const std::vector<double>& values, double factor, double present) {
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      if (!is<LawGuard>(watches_[w].ending)) continue;
      watches_[w].scale += factor * std::abs(values[w]);
      watches_[w].parts += present * std::abs(values[w]);
    }
  };
  probe_ = X_;
  for (std::size_t k = 0; k < X_.size(); ++k) {
    probe_[k] = X_[k] + part * flow_.scales()[k];
    evaluate_guards(probe_, local_time_, guard_values_);
    for (std::size_t w = 0; w < here.size(); ++w) guard_values_[w] -= here[w];
    add(guard_values_, 1.0 / part, std::abs(X_[k]) / (part * flow_.scales()[k]));
    probe_[k] = X_[k];
  }
  for (Watch& watch : watches_) watch.reach = watch.scale;
  add(here, 1.0, 1.0);
}

/// Values of all guards, in the order of watches_.
void SmoothEngine::evaluate_guards(std::span<const double> X, double t, std::vector<double>& values) const {
  values.clear();
  if (direction_ != Direction::none) {
    values.push_back(friction::sign(direction_) * X[1]);
  } else if (can_stick_) {
    const double pull = flow_.pull(X, t);
    const double limit = flow_.limit(X, t);
    values.push_back(limit - pull);
    values.push_back(limit + pull);
  }
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (has_memory_[i]) flow_.guards(i, X, t, values);
  }
}

/// On the dense output of the step taken last.
double SmoothEngine::guard(std::size_t watch, double part) const {
  probe_.resize(end_.size());
  stepper_->at(part, probe_);
  evaluate_guards(probe_, local_time_ + part * taken_, guard_values_);
  return guard_values_[watch];
}

/// Its rate along the motion, by a central difference along the flow over a small part of `length` [s].
double SmoothEngine::guard_rate(std::size_t watch, std::span<const double> X, double t, double length) const {
  flow_.evaluate(X, t, rates_);
  if (is<SlipEnd>(watches_[watch].ending)) return friction::sign(direction_) * rates_[1];
  const double step = part_of_rate * length;
  const auto value_after = [&](double s) {
    probe_.assign(X.begin(), X.end());
    for (std::size_t k = 0; k < probe_.size(); ++k) probe_[k] += s * rates_[k];
    evaluate_guards(probe_, t + s, guard_values_);
    return guard_values_[watch];
  };
  const double above = value_after(step);
  return (above - value_after(-step)) / (2.0 * step);
}

/// Whether a guard that is zero at the start of the interval goes negative: by where a step of the classical
/// Runge-Kutta method leads, a longer one where the first leaves it within rounding. At a release velocity and
/// acceleration may both be zero, so that a guard on the position begins with the third power of time, which a
/// method of second order does not see. The first step is shorter than any decay of a law; one that is longer than
/// a decay leads nowhere, which two steps of half the length show. A guard that rises beyond the rounding of what
/// cancels in it does not go negative at once, even if it stays within `level` of zero and falls later: a stiff
/// bond that the mass relieves and stretches again may do so, and where it moves hardly at all only the slope shows
/// it.
bool SmoothEngine::goes_negative(std::size_t watch, double value, double level) const {
  const auto value_after = [&](double length, int steps) {
    const double s = length / steps;
    std::vector<double> X = X_;
    std::vector<double> sum(X.size());
    for (int i = 0; i < steps; ++i) {
      const double t = local_time_ + i * s;
      std::ranges::fill(sum, 0.0);
      probe_ = X;
      constexpr std::array<double, 4> next = {0.5, 0.5, 1.0, 0.0};
      constexpr std::array<double, 4> at = {0.0, 0.5, 0.5, 1.0};
      constexpr std::array<double, 4> weights = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
      for (std::size_t stage = 0; stage < weights.size(); ++stage) {
        flow_.evaluate(probe_, t + at[stage] * s, rates_);
        for (std::size_t k = 0; k < X.size(); ++k) {
          sum[k] += weights[stage] * s * rates_[k];
          probe_[k] = X[k] + next[stage] * s * rates_[k];
        }
      }
      for (std::size_t k = 0; k < X.size(); ++k) X[k] += sum[k];
    }
    evaluate_guards(X, local_time_ + length, guard_values_);
    return guard_values_[watch];
  };
  const double rounding = risen * watches_[watch].parts;
  const double longest = longest_step();
  if (guard_rate(watch, X_, local_time_, longest) * part_of_rate * longest > rounding) return false;
  for (double part = shortest_probe; part < 0.1; part *= 10.0) {
    const double length = part * longest;
    const double later = value_after(length, 1);
    const bool rises = later - value > rounding;
    if (std::abs(later) <= level && !rises) continue;
    const double again = value_after(length, 2);
    if (rises && std::abs(later - again) <= 0.5 * (again - value)) return false;
    if (std::abs(later) <= level) continue;
    return again < 0.0 && std::abs(later - again) <= 0.5 * std::abs(again);
  }
  return false;
}

/// What the step that ended at a mode change leaves to the interval after it: that law's guards are known no better
/// than by what they do in the time by which the step may have missed the change, however small they are there.
void SmoothEngine::note_landing(const Hit& hit) {
  const Watch& watch = watches_[hit.watch];
  const auto* guard = std::get_if<LawGuard>(&watch.ending);
  if (guard == nullptr) return;
  const double error = resolution * watch.scale;
  const double most = std::max(taken_, shortest_part * longest_step());
  const double rate = std::abs(guard_rate(hit.watch, end_, local_time_ + taken_, most));
  landing_ = {guard->law, error < rate * most ? error / rate : most};
}

/// Values within it of zero are zero at the start of the interval.
double SmoothEngine::level_at_start(const Watch& watch) const {
  return std::max(equal * watch.scale, landing_error(watch));
}

/// What the step before this interval left of a guard of the law that changed its mode there; of others 0.
double SmoothEngine::landing_error(const Watch& watch) const {
  const auto* guard = std::get_if<LawGuard>(&watch.ending);
  if (guard == nullptr || guard->law != landing_.law || landing_.error == 0.0) return 0.0;
  const auto index = static_cast<std::size_t>(&watch - watches_.data());
  return landing_.error * std::abs(guard_rate(index, X_, local_time_, longest_step()));
}

/// Whether a guard has its zero ahead, however near, so that a step finds it: a law asked to change its mode before
/// would see forces that do not belong together yet. Zero itself is known to the rounding of what cancels.
bool SmoothEngine::is_clearly_positive(const Watch& watch, double value) const {
  if (value > level_at_start(watch)) return true;
  return is<LawGuard>(watch.ending) && value > std::max(resolution * watch.parts, landing_error(watch));
}

/// A guard that is negative at the start of the interval, or zero and going to be.
bool SmoothEngine::find_violated(Hit& hit) const {
  evaluate_guards(X_, local_time_, guard_values_);
  const std::vector<double> values = guard_values_;
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    // The direction of a slip was decided by the forces.
    if (is<SlipEnd>(watches_[w].ending)) continue;
    if (is_clearly_positive(watches_[w], values[w])) continue;
    const double level = level_at_start(watches_[w]);
    if (values[w] >= -level && (is<StickEnd>(watches_[w].ending) || !goes_negative(w, values[w], level))) continue;
    hit = {w, 0.0};
    return true;
  }
  return false;
}

/// Whether a second law reaches its guard at the same instant as the last event, independently of it.
bool SmoothEngine::coincides(const Hit& hit) const {
  const Watch& watch = watches_[hit.watch];
  const auto* guard = std::get_if<LawGuard>(&watch.ending);
  if (guard == nullptr || !(landing_.error > 0.0) || guard->law == landing_.law) return false;
  evaluate_guards(end_, local_time_, guard_values_);
  return guard_values_[hit.watch] >= -level_at_start(watch);
}

/// The first crossing on the step taken last.
bool SmoothEngine::find_hit(Hit& hit) {
  probe_.resize(end_.size());
  for (std::size_t k = 0; k < points; ++k) {
    const double part = static_cast<double>(k) / (points - 1);
    stepper_->at(part, probe_);
    evaluate_guards(probe_, local_time_ + part * taken_, guard_values_);
    for (std::size_t w = 0; w < watches_.size(); ++w) {
      watches_[w].values[k] = guard_values_[w];
      watches_[w].scale = std::max(watches_[w].scale, std::abs(guard_values_[w]));
    }
  }
  bool found = false;
  for (std::size_t w = 0; w < watches_.size(); ++w) {
    const double part = first_negative(w);
    if (part < 0.0 || (found && part >= hit.part)) continue;
    hit = {w, part};
    found = true;
  }
  return found;
}

/// Whether a law's guard is far below what it was earlier in this interval, as behind the fast decay of a state:
/// its size then has to be taken anew.
bool SmoothEngine::has_faded() const {
  constexpr double far = 1e-3;
  return std::ranges::any_of(watches_, [](const Watch& watch) {
    if (!is<LawGuard>(watch.ending)) return false;
    double largest = watch.reach;
    for (const double value : watch.values) largest = std::max(largest, std::abs(value));
    return largest < far * watch.scale;
  });
}

/// Where a guard crosses first, as a part of the step; below zero: nowhere.
double SmoothEngine::first_negative(std::size_t watch) {
  const Watch& w = watches_[watch];
  const double floor = -resolution * w.scale;
  const auto part = [](std::size_t k) { return static_cast<double>(k) / (points - 1); };
  Triple edge;
  // Of the points alone, none shows a minimum before the second or behind the last but one.
  if (falls_at_edge(watch, 0, edge)) {
    const double lowest = dip(watch, edge);
    if (lowest >= 0.0) return crossing(watch, 0.0, lowest);
  }
  for (std::size_t k = 1; k < points; ++k) {
    if (w.values[k] < floor) return crossing(watch, part(k - 1), part(k));
    if (k + 1 == points || w.values[k] > w.values[k - 1] || w.values[k] > w.values[k + 1]) continue;
    const double lowest =
        dip(watch, {{part(k - 1), part(k), part(k + 1)}, {w.values[k - 1], w.values[k], w.values[k + 1]}});
    if (lowest >= 0.0) return crossing(watch, part(k - 1), lowest);
  }
  if (falls_at_edge(watch, points - 1, edge)) {
    const double lowest = dip(watch, edge);
    if (lowest >= 0.0) return crossing(watch, part(points - 2), lowest);
  }
  return -1.0;
}

/// Whether a guard that is lowest, of the points, at the begin or the end of the step falls from there into the
/// step, and may reach zero: three points around that minimum.
bool SmoothEngine::falls_at_edge(std::size_t watch, std::size_t edge, Triple& around) const {
  constexpr double near = 1e-5;
  const Watch& w = watches_[watch];
  const bool begins = edge == 0;
  const std::size_t next = begins ? 1 : edge - 1;
  const auto [least, largest] = std::ranges::minmax(w.values);
  // A guard that begins at zero rises from it; what lies just beside is rounding.
  if (begins && w.values[edge] <= equal * w.scale) return false;
  if (w.values[edge] > w.values[next] || w.values[edge] > largest - least) return false;
  const double at = begins ? near : 1.0 - near;
  const double value = guard(watch, at);
  if (!(value < w.values[edge])) return false;
  const double part = static_cast<double>(next) / (points - 1);
  around = begins ? Triple{{0.0, at, part}, {w.values[edge], value, w.values[next]}}
                  : Triple{{part, at, 1.0}, {w.values[next], value, w.values[edge]}};
  return true;
}

/// Whether the minimum between these points goes below zero: where, as a part of the step; below zero when not. One
/// that only grazes is a grazing.
double SmoothEngine::dip(std::size_t watch, Triple around) {
  const Watch& w = watches_[watch];
  auto& [at, value] = around;
  const double before = value[0];
  const double after = value[2];
  for (int i = 0; i < 3; ++i) {
    const double left = (value[1] - value[0]) / (at[1] - at[0]);
    const double right = (value[2] - value[1]) / (at[2] - at[1]);
    const double bend = (right - left) / (at[2] - at[0]);
    const double lowest = 0.5 * (at[0] + at[1]) - 0.5 * left / bend;
    // Nearer than rounding lets a parabola tell.
    if (!(bend > 0.0 && lowest > at[0] && lowest < at[2]) || std::abs(lowest - at[1]) < 1e-9) break;
    const double there = guard(watch, lowest);
    if (there < -resolution * w.scale) return lowest;
    const std::size_t replaced = lowest < at[1] ? 2 : 0;
    at[replaced] = at[1];
    value[replaced] = value[1];
    at[1] = lowest;
    value[1] = there;
  }
  const double grazed = 100.0 * model_.solver.tolerance * w.scale;
  // A creep below that has no minimum that the dense output could tell from its own error.
  const double sides = value[1] + grazed;
  if (value[1] < grazed && before > sides && after > sides)
    grazings_.push_back({static_cast<int>(watch), at[1] * taken_});
  return -1.0;
}

/// The root between a point where the guard counts as positive and one where it is negative. At the begin of a
/// interval a guard may be zero: it is positive just after.
double SmoothEngine::crossing(std::size_t watch, double before, double negative) const {
  double low = before;
  double value_low = guard(watch, low);
  if (value_low <= 0.0 && before > 0.0) return before;
  for (double part = 0.5 * negative; value_low <= 0.0; part *= 0.5) {
    if (part < 1e-12) return 0.0;
    if (low > 0.0) negative = low;
    low = part;
    value_low = guard(watch, low);
  }
  const double value_negative = guard(watch, negative);
  if (value_negative > 0.0) {
    const auto* of = std::get_if<LawGuard>(&watches_[watch].ending);
    throw friction::LawFault("a guard of " + (of != nullptr ? name_in_list(of->law) : "a friction law") +
                             " changed its sign between two calls for the same instant, t = " +
                             std::to_string(time() + negative * taken_) + " s");
  }
  std::uintmax_t iterations = 60;
  const auto [left, right] =
      boost::math::tools::toms748_solve([&](double part) { return guard(watch, part); }, low, negative, value_low,
                                        value_negative, boost::math::tools::eps_tolerance<double>(48), iterations);
  return 0.5 * (left + right);
}

/// A slip that ends and begins again within one step may be the dense output alone: it swings below zero where the
/// velocity begins with a high power of time, as under a level that falls steeply at v = 0. Nor does a slip end
/// where it begins while the forces drive it on: the step passed over a swing that is within its error. A shorter
/// step swings less; a true reversal is met by a step that ends in it.
bool SmoothEngine::may_be_swing_of_output(const Hit& hit) const {
  const Watch& watch = watches_[hit.watch];
  if (!is<SlipEnd>(watch.ending) || !(taken_ > shortest_part * longest_step())) return false;
  if (watch.values.back() > 0.0) return true;
  if (hit.part != 0.0 || !(guard_rate(hit.watch, X_, local_time_, taken_) > 0.0)) return false;
  // A steep dashpot turns the force over at once.
  constexpr double soon = 1e-6;
  probe_ = X_;
  for (std::size_t k = 0; k < probe_.size(); ++k) probe_[k] += soon * taken_ * rates_[k];
  flow_.evaluate(probe_, local_time_ + soon * taken_, rates_);
  return friction::sign(direction_) * rates_[1] > 0.0;
}

/// Repeats the step so that it ends at the crossing, and corrects its length by Newton's method. False: the shorter
/// step is not accurate; an implicit step that overran the crossing may have computed what only lies beyond it.
bool SmoothEngine::land(const Hit& hit) {
  const double whole = taken_;
  double h = hit.part * whole;
  if (h < shortest_part * longest_step()) {
    taken_ = 0.0;
    end_ = X_;
    return true;
  }
  // A law judges by the terms of its own force, which may be far below the size of the motion: a mass that rests
  // near the origin after it was far away.
  const Watch& watch = watches_[hit.watch];
  const double size = is<LawGuard>(watch.ending) ? std::min(watch.scale, watch.parts) : watch.scale;
  // An implicit step knows its end to a thousandth of what is allowed. A law with guards may stop its slider here
  // too and is told the time as well as it can be.
  const double known = watches_.size() == 1 && is<SlipEnd>(watch.ending) ? 1e-3 * allowed_[1] : 0.0;
  for (int i = 0;; ++i) {
    if (!stepper_->step(flow_, X_, local_time_, h, allowed_, end_, error_) || excess_error() > 1.0) return false;
    taken_ = h;
    evaluate_guards(end_, local_time_ + h, guard_values_);
    const double value = guard_values_[hit.watch];
    if (std::abs(value) <= std::max(0.1 * resolution * size, known)) return true;
    const double correction = -value / guard_rate(hit.watch, end_, local_time_ + h, h);
    const bool is_within_reach = std::abs(correction) < 0.1 * h;
    if (std::abs(correction) < 1e-16 * whole || (i == 0 && !is_within_reach)) return true;
    // Of a state that has died out, explicit steps at the limit of stability leave only their own swinging: its
    // zero recedes from each correction, past the crossings of other guards.
    if (i == most_corrections - 1 || !is_within_reach) return std::abs(correction) < settled * h;
    h += correction;
  }
}

/// Where a slip ends. Where the pull equals the limit within rounding, what both do next decides.
void SmoothEngine::settle() {
  const Direction slipped = direction_;
  change_direction(Direction::none);
  judge_.freeze(memories_, Direction::none, time() - local_time_);
  std::vector<double> X;
  judge_.gather(x_, 0.0, memories_, X);
  std::vector<double> rates(X.size());
  judge_.evaluate(X, local_time_, rates);
  const double pull = judge_.pull(X, local_time_);
  const double limit = judge_.limit(X, local_time_);
  const double parts = drive_.force_scale() + limit + model_.oscillator.stiffness * std::abs(x_);
  const double tolerance = equal * parts;
  const auto at_limit = [&] {
    double pull_then = pull;
    double limit_then = limit;
    for (const double part : {1e-6, 1e-4, 1e-2}) {
      const double later = part * longest_step();
      probe_ = X;
      for (std::size_t k = 2; k < probe_.size(); ++k) probe_[k] += later * rates[k];
      pull_then = judge_.pull(probe_, local_time_ + later);
      limit_then = judge_.limit(probe_, local_time_ + later);
      if (std::abs(std::abs(pull_then) - limit_then) > tolerance) break;
    }
    return direction_after_slip(pull_then, limit_then, tolerance, [&] {
      if (can_stick_) return Direction::none;
      // Without a law that holds it a mass that nothing moves slips, at no speed.
      return pull_then < 0.0 ? Direction::backward : Direction::forward;
    });
  };
  Direction direction = direction_after_slip(pull, limit, tolerance, at_limit);
  // Creep below the rounding of the velocity shows only where it leads: not in this direction.
  if (ended_at_once_ && limit == 0.0 && direction == slipped)
    direction = slipped == Direction::forward ? Direction::backward : Direction::forward;
  if (direction != Direction::none) change_direction(direction);
}

}  // namespace dualdamp::sim
