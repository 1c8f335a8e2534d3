#include "sim/engine/smooth/steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.hpp"

namespace dualdamp::sim {

namespace {

using core::infinity;

/// Errors of a step change by at most these factors.
constexpr double largest_growth = 5.0;
constexpr double largest_cut = 0.1;
/// The step after one whose equations were not solved.
constexpr double unsolved_cut = 0.25;
constexpr double safety = 0.9;

/// Friction that acts within this part of the longest step is not even tried by explicit steps.
constexpr double part_of_longest = 1e-3;

/// A step is at most this part of the shortest period.
constexpr double part_of_period = 0.125;

/// Kinks of a delayed velocity pass on this often, each time one derivative higher.
constexpr int echoes = 4;

/// Parts of a step, from the turn on, at which a law is asked how its states depend on the speed; the first is the
/// turn itself. And what the others make of the first as a parabola, as weights.
constexpr std::array<double, 4> from_turn = {0.0, 0.1, 0.3, 0.6};
constexpr std::array<double, 3> parabola = {1.8, -1.0, 0.2};

/// The speed is varied by this part of itself and of a hundredth of the largest one (`Flow::jacobian`).
constexpr double speed_variation = 1.5e-8;
constexpr double slow_part = 0.01;

/// A dependence that changes by less over the step matters to no state, relative to the sizes of both.
constexpr double sharp_change = 0.01;

/// A step goes this much beyond the turn that the loss of speed leads to expect, so that it finds the turn. The
/// loss of speed leads to a turn if it is more than this part of that in the step before.
constexpr double beyond_turn = 1.05;
constexpr double steady_loss = 0.8;

/// Steps shorter than this part of the longest one are not shortened further.
constexpr double shortest_with_turn = 1e-9;

}  // namespace

Steps::Steps(const Model& model, const Drive& drive, const Flow& flow)
    : model_(model),
      flow_(flow),
      is_implicit_(model.solver.kind == SolverKind::implicit_steps),
      frequencies_(drive.frequencies()) {
  stepper_ = is_implicit_ ? make_implicit_stepper() : make_explicit_stepper();
  double fastest = natural_frequency(model.oscillator);
  for (const double frequency : frequencies_) fastest = std::max(fastest, frequency);
  shortest_period_ = core::two_pi / fastest;
  limit();
}

/// Implicit steps do not see all periods: an overdamped oscillator has none of its own, and they pass over the fast
/// one of its two decays where nothing is left of it.
void Steps::limit() {
  const Oscillator& oscillator = model_.oscillator;
  const double own = natural_frequency(oscillator);
  const double ratio = oscillator.damping / (2.0 * oscillator.mass * own);
  double shortest_seen = shortest_period_;
  if (is_implicit_ && ratio > 1.0) {
    double fastest = own / (ratio + std::sqrt(ratio * ratio - 1.0));
    for (const double frequency : frequencies_) fastest = std::max(fastest, frequency);
    shortest_seen = core::two_pi / fastest;
  }
  longest_ = part_of_period * shortest_seen;
  for (const friction::Law& law : model_.friction) {
    if (law.delay() > 0.0) longest_ = std::min(longest_, law.delay());
  }
}

double Steps::longest(double t) const {
  double longest = longest_;
  for (const double kink : kinks_) {
    // Shorter than rounding of time: passed.
    const double ahead = kink - t;
    if (ahead > 1e-12 * longest) longest = std::min(longest, ahead);
  }
  return longest;
}

void Steps::begin_motion() {
  kinks_.clear();
  proposed_ = proposed_at_turn_ = 0.0;
  counted_to_ = 0.0;
}

void Steps::begin_interval(double x, double v, const std::vector<friction::Memory>& memories) {
  flow_.gather(x, v, memories, begin_);
  end_.resize(begin_.size());
  error_.resize(begin_.size());
  rates_.resize(begin_.size());
}

void Steps::stay(double t) {
  t_ = t;
  length_ = 0.0;
  end_ = begin_;
}

SmoothStep Steps::last() const {
  return {.flow = flow_,
          .stepper = *stepper_,
          .begin = begin_,
          .end = end_,
          .t = t_,
          .length = length_,
          .longest = longest(t_)};
}

/// Largest error of the last step over what is allowed.
double Steps::excess_error() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < error_.size(); ++k) {
    const double excess = std::abs(error_[k]) / allowed_[k];
    // max() would pass over what is not a number.
    if (!std::isfinite(excess)) return infinity;
    largest = std::max(largest, excess);
  }
  return largest;
}

/// A step whose second-order term is a hundredth of what is allowed at the method's order (hairer1993, II.4).
double Steps::first() {
  flow_.evaluate(begin_, t_, rates_);
  const auto norm = [&](const std::vector<double>& values) {
    double largest = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k)
      largest = std::max(largest, std::abs(values[k]) / flow_.scales()[k]);
    return largest;
  };
  const double slope = norm(rates_);
  const double trial = slope > 0.0 ? 1e-4 / slope : 1e-4 * longest(t_);
  state_ = begin_;
  for (std::size_t k = 0; k < state_.size(); ++k) state_[k] += trial * rates_[k];
  std::vector<double> later(rates_.size());
  flow_.evaluate(state_, t_ + trial, later);
  for (std::size_t k = 0; k < later.size(); ++k) later[k] = (later[k] - rates_[k]) / trial;
  const double rate = std::max(slope, std::sqrt(norm(later)));
  const double exponent = 1.0 / (stepper_->order() + 1);
  return rate > 0.0 ? std::pow(0.01 * model_.solver.tolerance, exponent) / rate : longest(t_);
}

bool Steps::make_implicit() {
  if (is_implicit_ || model_.solver.kind != SolverKind::automatic) return false;
  is_implicit_ = true;
  stepper_ = make_implicit_stepper();
  proposed_at_turn_ = 0.0;
  limit();
  return true;
}

/// Whether friction turns the acceleration over within a thousandth of the longest step: a dashpot that holds the
/// mass. Explicit steps would be lost on it.
bool Steps::begins_stiff() {
  if (flow_.direction() == friction::Direction::none) return false;
  const double s = part_of_longest * longest(t_);
  flow_.evaluate(begin_, t_, rates_);
  const double acceleration = rates_[1];
  state_ = begin_;
  for (std::size_t k = 0; k < state_.size(); ++k) state_[k] += s * rates_[k];
  flow_.evaluate(state_, t_ + s, rates_);
  return acceleration * rates_[1] < 0.0 && std::abs(rates_[1]) > 0.1 * std::abs(acceleration);
}

/// Counts one more.
bool Steps::are_too_many(double now) {
  if (now >= counted_to_) {
    counted_to_ = now + shortest_period_;
    count_ = 0;
  }
  const bool stands = now == stood_at_;
  stood_at_ = now;
  standing_ = stands ? standing_ + 1 : 0;
  return ++count_ > most_in_period || standing_ > most_at_instant;
}

/// When the speed is zero if it goes on to fall as in the last step [s]. Beyond its turn a step runs on a
/// continuation of the branch on which friction may be far steeper than on the motion: bristles grow there instead
/// of yielding, and the step is refused for what the motion never meets. A speed that decays has no turn: its loss
/// falls from step to step. Nor is a turn to be expected from a speed below what a step resolves.
double Steps::time_to_turn() const {
  if (!(std::abs(begin_[1]) > allowed_[1])) return infinity;
  if (!(loss_of_speed_ > 0.0 && earlier_loss_ > 0.0 && loss_of_speed_ > steady_loss * earlier_loss_))
    return infinity;
  return std::abs(begin_[1]) / loss_of_speed_;
}

Steps::Result Steps::advance(double t, double now, double left) {
  t_ = t;
  // The dense output of a step is needed until the next one: the method changes only here.
  const bool hold_off = proposed_ == 0.0 && !is_implicit_ && begins_stiff();
  if ((hold_off || stiff_steps_.are_many()) && make_implicit()) proposed_ = 0.0;
  if (proposed_ == 0.0) {
    proposed_ = first();
    // What is fast before a turn is as fast behind it.
    if (proposed_at_turn_ > 0.0 && flow_.direction() != friction::Direction::none)
      proposed_ = std::min(proposed_, proposed_at_turn_);
    loss_of_speed_ = earlier_loss_ = part_of_way_ = 0.0;
  }
  allowed_.resize(begin_.size());
  for (std::size_t k = 0; k < begin_.size(); ++k)
    allowed_[k] = model_.solver.tolerance * (std::abs(begin_[k]) + flow_.scales()[k]);
  const double most = longest(t_);
  const double to_turn = time_to_turn();
  if (part_of_way_ > 0.0 && to_turn < infinity) proposed_ = std::min(proposed_, part_of_way_ * to_turn);
  bool rejected = false;
  for (int i = 0; i < most_tries; ++i) {
    if (are_too_many(now)) return Result::too_many;
    double h = std::min({proposed_, most, beyond_turn * to_turn});
    // No tiny step is left over at the end.
    if (1.01 * h >= left) {
      h = left;
    } else if (2.0 * h > left) {
      h = 0.5 * left;
    }
    const bool solved = stepper_->step(flow_, begin_, t_, h, allowed_, end_, error_);
    const double excess = solved ? excess_error() : infinity;
    const double ideal = excess > 0.0 ? safety * std::pow(excess, -1.0 / (stepper_->order() + 1)) : largest_growth;
    if (excess <= 1.0) {
      length_ = h;
      const double next = h * std::clamp(ideal, largest_cut, rejected ? 1.0 : largest_growth);
      proposed_ = h < proposed_ ? std::max(proposed_, next) : next;
      // See part_of_way_. Explicit steps, under friction that is steep at fixed speeds, would only be shorter.
      if (is_implicit_ && to_turn < infinity && (rejected || part_of_way_ > 0.0))
        part_of_way_ = h * std::min(ideal, largest_growth) / to_turn;
      earlier_loss_ = loss_of_speed_;
      loss_of_speed_ = friction::sign(flow_.direction()) * (begin_[1] - end_[1]) / h;
      if (!is_implicit_) stiff_steps_.add(stepper_->stiffness());
      return Result::taken;
    }
    rejected = true;
    proposed_ = h * std::clamp(ideal, solved ? largest_cut : unsolved_cut, 0.7);
    if (proposed_ < 1e-14 * most && make_implicit()) proposed_ = first();
    if (proposed_ < 1e-100 * most) break;
  }
  return Result::too_short;
}

bool Steps::repeat(double length) {
  if (!stepper_->step(flow_, begin_, t_, length, allowed_, end_, error_) || excess_error() > 1.0) return false;
  length_ = length;
  return true;
}

void Steps::go_on(bool at_slip_end) {
  begin_ = end_;
  proposed_at_turn_ = at_slip_end ? proposed_ : 0.0;
  if (!at_slip_end) return;
  begin_[1] = 0.0;
  for (const friction::Law& law : model_.friction) {
    for (int j = 1; j <= echoes && law.delay() > 0.0; ++j) kinks_.push_back(t_ + length_ + j * law.delay());
  }
}

void Steps::shift(double period, double t) {
  for (double& kink : kinks_) kink -= period;
  std::erase_if(kinks_, [&](double kink) { return kink < t; });
}

/// How the states of a law depend on the speed near the turn. Bristles that yield at a level which falls within a
/// small speed are such a law: their rates are a product with the speed, so that the turn itself shows nothing of
/// the level, and the stages before it are too fast.
bool Steps::hides_turn(bool at_end) {
  if (begin_.size() <= 2 || length_ < shortest_with_turn * longest(t_)) return false;
  const double change = speed_variation * slow_part * flow_.scales()[1];
  std::array<std::vector<double>, from_turn.size()> slopes;
  double speed = 0.0;
  state_.resize(begin_.size());
  for (std::size_t i = 0; i < from_turn.size(); ++i) {
    const double part = at_end ? 1.0 - from_turn[i] : from_turn[i];
    const double t = t_ + part * length_;
    stepper_->at(part, state_);
    flow_.evaluate(state_, t, rates_);
    slopes[i] = rates_;
    const double before = state_[1];
    if (i == 1) speed = std::abs(before);
    state_[1] += friction::sign(flow_.direction()) * (change + speed_variation * std::abs(before));
    flow_.evaluate(state_, t, rates_);
    for (std::size_t k = 0; k < rates_.size(); ++k)
      slopes[i][k] = (rates_[k] - slopes[i][k]) / (state_[1] - before);
  }
  for (std::size_t k = 2; k < begin_.size(); ++k) {
    double rest = slopes[0][k];
    for (std::size_t i = 0; i < parabola.size(); ++i) rest -= parabola[i] * slopes[i + 1][k];
    const double missed = std::abs(rest) * speed * from_turn[1] * length_;
    const double clearly = sharp_change * flow_.scales()[k] / flow_.scales()[1];
    if (missed > allowed_[k] && std::abs(rest) * length_ > clearly) return true;
  }
  return false;
}

bool Steps::passes_over_turn(bool at_stop) {
  if (flow_.direction() == friction::Direction::none) return false;
  if (at_stop && hides_turn(true)) {
    proposed_ = 0.75 * length_;
    return true;
  }
  if (begin_[1] == 0.0 && hides_turn(false)) {
    proposed_ = 0.25 * length_;
    return true;
  }
  return false;
}

}  // namespace dualdamp::sim
