#include "sim/engine/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/cancellation.hpp"
#include "core/numbers.hpp"
#include "sim/engine/exact_engine.hpp"
#include "sim/engine/law_name.hpp"
#include "sim/engine/smooth_engine.hpp"
#include "sim/validate.hpp"
#include "sim/work_limit.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Largest ratio of a state to its size in a law. Above it the rounding of the position is more than 1e-4 of the
/// force.
constexpr double most_digits = 1e12;
/// Margin of the recommended stiffness: the motion may grow by this factor after it was refused.
constexpr double margin = 10.0;

core::Outcome check_work(long work) {
  if (WorkLimit::allows(work)) return {};
  return {core::OutcomeKind::event_limit,
          "the motion takes more than " + std::to_string(WorkLimit::most()) + " steps"};
}

/// Ends the motion if a state is far larger than its size in the law: the rounding of x then stretches a stiff
/// spring noticeably.
core::Outcome check_digits(const friction::Law& law, const friction::Memory& memory, std::size_t index, double time,
                           core::Coordinate coordinate) {
  if (memory.state.empty() || !law.has_rates()) return {};
  thread_local std::vector<double> sizes;
  sizes.assign(memory.state.size(), 0.0);
  law.scales(memory, sizes);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const double excess = std::abs(memory.state[k]) / (most_digits * sizes[k]);
    if (!(excess > 1.0) || !std::isfinite(excess)) continue;
    const std::string unit = " " + core::unit_for(coordinate, "m");
    const auto number = [](double value) { return core::format_number(value, 3); };
    return {core::OutcomeKind::not_finite,
            "friction law " + std::to_string(index + 1) +
                " is too stiff for double precision at t = " + number(time) + " s: it yields within " +
                number(sizes[k]) + unit + ", at a position of " + number(std::abs(memory.state[k])) + unit +
                "; a stiffness " + number(margin * excess) + " times smaller would do"};
  }
  return {};
}

}  // namespace

Engine::Engine(const Model& model) : model_(valid(model)), drive_(model.oscillator, model.excitation) {
  require(model.oscillator.loss_factor == 0.0,
          "structural damping (system.loss_factor) has no motion in time: it is not causal",
          "steady_state, xy_curve, frequency_response, regime_map");
  for (const friction::Law& law : model_.friction) {
    holds_mass_.push_back(law.holds_mass());
    has_memory_.push_back(law.has_memory());
    can_stick_ = can_stick_ || law.holds_mass();
    some_memory_ = some_memory_ || law.has_memory();
    const friction::Memory memory = law.start({.x = model.initial.position, .v = model.initial.velocity});
    scheduled_ = scheduled_ || std::isfinite(law.next_change(memory));
  }
}

Engine::~Engine() = default;

void Engine::start(double x, double v) {
  local_time_ = period_begin_ = 0.0;
  periods_passed_ = 0;
  is_woken_ = false;
  x_ = x;
  v_ = v;
  const InitialState& initial = model_.initial;
  if (!initial.memories.empty() && x == initial.position && v == initial.velocity) {
    memories_ = initial.memories;
    return place(initial.direction);
  }
  memories_.clear();
  for (const friction::Law& law : model_.friction) memories_.push_back(law.start(now()));
  place(Direction::none);
}

void Engine::restart(const State& state) {
  local_time_ = period_begin_ = 0.0;
  periods_passed_ = 0;
  is_woken_ = false;
  x_ = state.x;
  v_ = state.v;
  direction_ = state.direction;
  memories_ = state.memories;
  repeats_ = 0;
  outcome_ = {};
  begin_motion();
  restore_past(state);
}

/// `before`: the direction in which the laws have been moved. A law that slips goes on slipping in it.
void Engine::place(Direction before) {
  repeats_ = 0;
  outcome_ = {};
  direction_ = before;
  begin_motion();
  const Direction direction = friction::direction_of(v_);
  if (direction == Direction::none) return settle();
  if (direction == before) return;
  if (before != Direction::none) change_direction(Direction::none);
  change_direction(direction);
}

/// Whether there is work left to do; sets an outcome if not.
bool Engine::may_go_on() {
  core::stop_if_cancelled();
  core::Outcome limited = check_work(work());
  if (limited.ok()) return true;
  outcome_ = std::move(limited);
  return false;
}

const Interval* Engine::next(double horizon) {
  if (!may_go_on()) return nullptr;
  // Not earlier, because the last interval, still valid until this call, lies in the piece before.
  if (drive_.has_pieces() && drive_.piece() != periods_passed_) {
    local_time_ = 0.0;
    drive_.enter(periods_passed_);
    // If no law holds the mass, there are no guards that release it, and a piece of the drive sets it in motion.
    is_woken_ = direction_ == Direction::none && !can_stick_ && balance().direction != Direction::none;
  }
  const double left = (horizon - period_begin_) - local_time_;
  const double in_piece = drive_.period() - local_time_;
  if (drive_.has_pieces() && left >= in_piece) return step(in_piece, true);
  return step(std::min(left, drive_.period()), false);
}

const Interval* Engine::next_in_period() {
  if (!may_go_on()) return nullptr;
  return step(drive_.period() - local_time_, true);
}

/// Whether no law changes its force or its memory with the direction of slip: else the direction is part of the
/// mode.
bool Engine::turns_freely() const {
  if (direction_ == Direction::none) return false;
  friction::Instant turning = now();
  turning.v = 0.0;
  const Direction back = opposite(direction_);
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    const friction::Law& law = model_.friction[i];
    if (law.holds_mass() || law.force(memories_[i], turning, direction_) != law.force(memories_[i], turning, back))
      return false;
    friction::Memory turned = memories_[i];
    law.jump(turned, {}, turning, back);
    if (turned != memories_[i]) return false;
  }
  return true;
}

State Engine::state() const {
  return {.x = x_, .v = v_, .direction = direction_, .memories = memories_, .turns_freely = turns_freely()};
}

void Engine::track_sensitivity(bool track) {
  tracking_ = track;
  if (tracking_) reset_sensitivity();
}

void Engine::pass_period() {
  ++periods_passed_;
  period_begin_ = drive_.begin_of(periods_passed_);
}

void Engine::change_direction(Direction direction) {
  direction_ = direction;
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (has_memory_[i]) jump(i, {});
  }
}

void Engine::jump(std::size_t law, friction::Trigger trigger) {
  if (!tracking_) {
    model_.friction[law].jump(memories_[law], trigger, now(), direction_);
  } else {
    const friction::Memory before = memories_[law];
    model_.friction[law].jump(memories_[law], trigger, now(), direction_);
    jumped(law, before, trigger);
  }
  const core::Outcome digits =
      check_digits(model_.friction[law], memories_[law], law, time(), model_.oscillator.coordinate);
  if (!digits.ok()) outcome_ = digits;
}

/// Where nothing holds the mass and the sum of forces is within the rounding of a stiff bond or of the velocity, it
/// may point in the direction of a slip that has just ended without a motion: that slip has shown the opposite.
void Engine::settle(bool without_motion) {
  const Direction slipped = direction_;
  change_direction(Direction::none);
  Balance next = balance();
  if (without_motion && next.limit == 0.0 && next.direction == slipped) next.direction = opposite(slipped);
  if (next.direction != Direction::none) change_direction(next.direction);
}

EventKind Engine::act(const Ending& ending, bool without_motion) {
  if (is<SlipEnd>(ending)) return end_slip(without_motion);
  if (const auto* stick = std::get_if<StickEnd>(&ending)) return act(*stick);
  return act(std::get<LawGuard>(ending));
}

/// At the end of a slip the mass sticks or reverses. If it goes on in the same direction, its velocity has only
/// touched zero: a grazing.
EventKind Engine::end_slip(bool without_motion) {
  const Direction before = direction_;
  settle(without_motion);
  if (direction_ == Direction::none) return EventKind::stop;
  return direction_ == before ? EventKind::grazing : EventKind::reversal;
}

EventKind Engine::act(StickEnd end) {
  change_direction(end.release);
  return EventKind::release;
}

EventKind Engine::act(LawGuard guard) {
  jump(guard.law, {guard.guard});
  changed_last_ = guard.law;
  return after_change();
}

/// A law has changed its mode. A mass that a law holds is released by the guards of the next interval, which takes
/// no time then. A mass that no law holds rests only while all forces on it cancel, and there are no such guards.
EventKind Engine::after_change() {
  if (direction_ != Direction::none || can_stick_) return EventKind::switching;
  settle();
  return direction_ == Direction::none ? EventKind::switching : EventKind::release;
}

/// The next time at which some law changes its mode whatever the motion does, or at which a piece of the drive
/// moves the mass [s].
double Engine::next_schedule() const {
  if (is_woken_) return time();
  double next = std::numeric_limits<double>::infinity();
  if (!scheduled_) return next;
  for (std::size_t i = 0; i < model_.friction.size(); ++i)
    next = std::min(next, model_.friction[i].next_change(memories_[i]));
  return next;
}

/// The mode changes of all laws that are due, or the release of a mass at rest.
EventKind Engine::act_on_schedule(double due) {
  is_woken_ = false;
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (model_.friction[i].next_change(memories_[i]) <= due) jump(i, {friction::Trigger::scheduled});
  }
  return after_change();
}

bool Engine::comes_to_an_end(bool takes_no_time) {
  repeats_ = takes_no_time ? repeats_ + 1 : 0;
  if (repeats_ <= friction::max_repeats * std::max(1, static_cast<int>(model_.friction.size()))) return true;
  const std::string changes = changed_last_ < model_.friction.size()
                                  ? "the mode changes of " + name_in_list(model_, changed_last_)
                                  : "a friction law's mode changes";
  outcome_ = {core::OutcomeKind::jump_cycle,
              changes + " did not come to an end at t = " + std::to_string(time()) + " s"};
  return false;
}

bool Engine::leaves_range() {
  constexpr double largest = 1e290;
  if (std::abs(x_) < largest && std::abs(v_) < largest) return false;
  leave_range();
  return true;
}

void Engine::leave_range() {
  outcome_ = {core::OutcomeKind::not_finite, "the motion left the range of double precision"};
}

bool is_exact(const Model& model) {
  return is_linear(model.oscillator) && model.solver.kind == SolverKind::automatic &&
         std::ranges::all_of(model.friction, [](const friction::Law& law) { return law.is_affine(); });
}

std::unique_ptr<Engine> make_engine(const Model& model) {
  if (is_exact(model)) return std::make_unique<ExactEngine>(model);
  return std::make_unique<SmoothEngine>(model);
}

}  // namespace dualdamp::sim
