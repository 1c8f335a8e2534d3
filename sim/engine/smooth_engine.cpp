#include "sim/engine/smooth_engine.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/engine/smooth/reasons.hpp"
#include "sim/engine/sticking_gate.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Steps to a crossing, and the last correction of their length, as a part of it, where Newton's method converges.
constexpr int most_corrections = 5;
constexpr double settled = 1e-6;

constexpr const char* ran_away = "the mass is far beyond the place from which a softening spring pushes outward";

}  // namespace

bool is_below_steps(const Model& model, double length, double accuracy) {
  const double amplitude = std::abs(model.excitation.amplitude);
  const double drive = model.excitation.moves_base() ? amplitude : amplitude / model.oscillator.stiffness;
  return length < small_motion * accuracy * drive;
}

/// One step as an interval: the dense output of the stepper.
class SmoothEngine::StepInterval final : public Interval {
 public:
  StepInterval(const Steps& steps, const Flow& flow) : steps_(steps), flow_(flow) {}

  [[nodiscard]] Sample at(double s) const override {
    go_to(s);
    Sample sample = flow_.sample(state_, local_begin + s);
    sample.t = begin + s;
    return sample;
  }
  [[nodiscard]] double position(double s) const override {
    go_to(s);
    return state_[0];
  }
  [[nodiscard]] double resolution(double) const override { return duration; }

  double local_begin = 0.0;  ///< within the forcing period [s]

 private:
  void go_to(double s) const {
    if (duration > 0.0) {
      state_.resize(steps_.end().size());
      steps_.at(std::clamp(s / duration, 0.0, 1.0), state_);
    } else {
      state_.assign(steps_.end().begin(), steps_.end().end());
    }
  }

  const Steps& steps_;
  const Flow& flow_;
  mutable std::vector<double> state_;  // scratch
};

SmoothEngine::SmoothEngine(const Model& model)
    : Engine(model),
      flow_(model, drive_, past_),
      judge_(model, drive_, past_),
      search_(model_, flow_),
      steps_(model_, drive_, flow_),
      derivative_(model_, drive_, past_, steps_.shortest_period()),
      interval_(std::make_unique<StepInterval>(steps_, flow_)) {
  for (const friction::Law& law : model_.friction) reach_ = std::max(reach_, law.delay());
  start(model.initial.position, model.initial.velocity);
}

SmoothEngine::~SmoothEngine() = default;

State SmoothEngine::state() const {
  State state = Engine::state();
  if (has_past()) state.past = std::make_shared<const VelocityHistory>(past_);
  return state;
}

long SmoothEngine::work() const {
  constexpr long responses_in_unit = 8;
  return Engine::work() + (flow_.responses() + judge_.responses()) / responses_in_unit + derivative_.work() +
         steps_.operations() / operations_in_unit;
}

void SmoothEngine::begin_motion() {
  drive_.reset(0.0);
  past_.clear(v_, reach_);
  steps_.begin_motion();
  is_laid_ = false;
  x_scale_ = 0.0;
  search_.forget_landing();
  follows_event_ = false;
  if (tracking_) reset_sensitivity();
}

void SmoothEngine::restore_past(const State& state) {
  if (state.past != nullptr) past_ = *state.past;
  // A state that Newton's method has displaced may move against its direction. That branch is not its own: a force
  // that falls with speed grows there without bound.
  if (friction::sign(direction_) * v_ < 0.0) change_direction(friction::direction_of(v_));
}

/// The motion's size: the largest |x| met, at first from velocity and forces.
void SmoothEngine::set_scales() {
  const double wn = natural_frequency(model_.oscillator);
  if (x_scale_ == 0.0) {
    double force = drive_.force_size(1.0 / wn);
    // With the direction of the motion: against it a force that falls with speed is beyond all sizes.
    const Direction direction = direction_ == Direction::none ? Direction::forward : direction_;
    for (std::size_t i = 0; i < memories_.size(); ++i)
      force += std::abs(model_.friction[i].force(memories_[i], now(), direction));
    x_scale_ = std::max(std::abs(v_) / wn, small_motion * force / model_.oscillator.stiffness);
    if (x_scale_ == 0.0) x_scale_ = std::abs(x_) > 0.0 ? std::abs(x_) : 1.0;
  }
  x_scale_ = std::max(x_scale_, std::abs(x_));
  flow_.set_scales(x_scale_, wn * x_scale_);
  judge_.set_scales(x_scale_, wn * x_scale_);
}

void SmoothEngine::build_interval() {
  if (is_laid_) return;
  is_laid_ = true;
  flow_.freeze(memories_, direction_, time() - local_time_);
  set_scales();
  steps_.begin_interval(x_, v_, memories_);
  search_.use_steps(steps_.are_implicit());
  search_.begin_interval(steps_.begin(), local_time_, drive_.force_scale());
}

void SmoothEngine::reset_sensitivity() { derivative_.reset(memories_, direction_); }

Eigen::MatrixXd SmoothEngine::sensitivity() const { return derivative_.matrix(present()); }

void SmoothEngine::jumped(std::size_t law, const friction::Memory& before, friction::Trigger trigger) {
  derivative_.note_change(law, before, trigger, direction_);
}

MotionDerivative::Present SmoothEngine::present() const {
  return {.now = now(), .local_time = local_time_, .direction = direction_, .memories = memories_};
}

/// Near the end of the range the terms of a step and of its dense output overflow before the motion itself does.
bool SmoothEngine::is_near_end_of_range() const {
  constexpr double safe = 1e280;
  return !std::ranges::all_of(steps_.begin(), [](double value) { return std::abs(value) < safe; });
}

/// A softening spring pushes outward beyond sqrt(-k/k3), and the mass is infinitely far away within a finite time.
bool SmoothEngine::has_run_away() const {
  const Oscillator& oscillator = model_.oscillator;
  constexpr double far = 10.0;
  return oscillator.cubic_stiffness < 0.0 &&
         std::abs(Engine::state().x) > far * std::sqrt(-oscillator.stiffness / oscillator.cubic_stiffness);
}

std::string SmoothEngine::fast_vibration() const {
  return too_fast_vibration(flow_, steps_.begin(), local_time_, steps_.shortest_period());
}

/// Ends the motion where steps are too many: what changes too fast is a vibration of its own that nearly nothing
/// damps, or else friction.
void SmoothEngine::stop_at_many_steps() {
  const bool stands = steps_.stand_still();
  const std::string spent = stands ? std::to_string(Steps::most_at_instant) + " steps at one instant, "
                                   : std::to_string(Steps::most_in_period) + " steps in one period before ";
  const bool away = has_run_away();
  std::string why = away ? ran_away : stands ? std::string() : fast_vibration();
  if (why.empty()) why = "friction changes too fast there to be integrated";
  outcome_ = {away ? core::OutcomeKind::not_finite : core::OutcomeKind::event_limit,
              "more than " + spent + "t = " + std::to_string(time()) + " s: " + why};
}

/// Ends the motion where steps become too short.
void SmoothEngine::stop_at_short_steps() {
  const bool away = has_run_away();
  if (is_near_end_of_range() && !away) return leave_range();
  const std::string why = away ? std::string(ran_away)
                               : infinite_force(model_, flow_, steps_.begin(), local_time_,
                                                steps_.longest(local_time_), now(), memories_);
  outcome_ = {core::OutcomeKind::not_finite,
              "the equation of motion could not be integrated at t = " + std::to_string(time()) +
                  " s: steps became too small" + (why.empty() ? why : ": " + why)};
}

bool SmoothEngine::advance(double left) {
  // Explicit steps cannot resolve the speed of a creep: they get its sign wrong, and at v = 0 they do not recognise
  // the creep.
  if (!steps_.are_implicit() && search_.guards().would_creep(steps_.begin(), local_time_) && steps_.make_implicit())
    steps_.propose(0.0);
  const Steps::Result result = steps_.advance(local_time_, time(), left);
  if (result == Steps::Result::too_many) stop_at_many_steps();
  if (result == Steps::Result::too_short) stop_at_short_steps();
  return result == Steps::Result::taken;
}

/// Whether the step ends in a creep that is not at its turn.
bool SmoothEngine::is_past_turn(const Hit& hit, double value) const {
  constexpr double at_turn = 1e-6;
  return is<SlipEnd>(search_.guards().ending(hit.guard)) && std::abs(value) > at_turn * flow_.scales()[1] &&
         search_.guards().creeps(steps_.end(), local_time_ + steps_.length());
}

/// Repeats the step so that it ends at the crossing, and corrects its length by Newton's method. False: the shorter
/// step is not accurate; an implicit step that overran the crossing may have computed what only lies beyond it.
bool SmoothEngine::land(const Hit& hit) {
  const double whole = steps_.length();
  double h = hit.part * whole;
  if (h < EventSearch::shortest_part * steps_.longest(local_time_)) {
    steps_.stay(local_time_);
    return true;
  }
  const double zero = search_.zero(hit.guard, steps_.allowed_in_velocity());
  for (int i = 0;; ++i) {
    if (!steps_.repeat(h)) return false;
    const double value = search_.guards().value(hit.guard, steps_.end(), local_time_ + h);
    if (std::abs(value) <= zero) return true;
    // Where the mass is found to creep already, against its direction, the forces have turned before: the slip ends
    // with its speed.
    if (i == 0 && is_past_turn(hit, value)) return true;
    const double correction = -value / search_.guards().rate(hit.guard, steps_.end(), local_time_ + h, h);
    const bool is_within_reach = std::abs(correction) < 0.1 * h;
    if (std::abs(correction) < 1e-16 * whole || (i == 0 && !is_within_reach)) return true;
    // Once a law's state has decayed, explicit steps at their limit of stability only oscillate about it. The zero
    // of a guard on such a state moves away at each correction, past the crossings of other guards.
    if (i == most_corrections - 1 || !is_within_reach) return std::abs(correction) < settled * h;
    h += correction;
  }
}

/// One step that ends at an event or before it.
bool SmoothEngine::move(double left, std::optional<Hit>& hit) {
  for (int i = 0; i < Steps::most_tries; ++i) {
    if (!advance(left)) return false;
    search_.use_steps(steps_.are_implicit());
    ++count_.searches;
    count_.panels += EventSearch::panels;
    const SmoothStep whole = steps_.last();
    const double length = whole.length;
    hit = search_.find(whole);
    if (hit && !steps_.are_implicit() && search_.ends_against_flow(*hit, whole)) {
      // Where explicit steps are asked for by name shorter ones follow the creep, or say that they are too many.
      steps_.propose(steps_.make_implicit() ? 0.0 : 0.25 * length);
      continue;
    }
    if (hit && search_.may_be_swing_of_output(*hit, whole)) {
      steps_.propose(0.25 * length);
      continue;
    }
    if (!hit || land(*hit)) {
      if (steps_.passes_over_turn(hit && is<SlipEnd>(search_.guards().ending(hit->guard)))) continue;
      // Beyond the event nothing grazed.
      grazings_ = search_.grazings();
      std::erase_if(grazings_, [&](const core::Grazing& grazing) { return grazing.s > steps_.length(); });
      count_.grazings += static_cast<long>(grazings_.size());
      return true;
    }
    steps_.propose(0.5 * hit->part * length);
  }
  outcome_ = {core::OutcomeKind::not_finite,
              "an event at t = " + std::to_string(time()) + " s could not be located"};
  return false;
}

const Interval* SmoothEngine::step(double left, bool to_period_end) {
  if (!outcome_.ok() || !(left > 0.0)) return nullptr;
  const double due = next_schedule();
  const bool by_schedule = due - time() < left;
  if (by_schedule) left = std::max(0.0, due - time());
  grazings_.clear();
  derivative_.begin_interval();
  build_interval();
  steps_.stay(local_time_);
  std::optional<Hit> hit = search_.find_violated(steps_.last());
  const bool at_once = hit.has_value();
  if (!at_once && left > 0.0) {
    search_.forget_landing();
    if (!move(left, hit)) return nullptr;
    if (hit) search_.note_landing(*hit, steps_.last());
  }
  const SmoothStep taken = steps_.last();
  if (!comes_to_an_end(taken.length == 0.0)) return nullptr;
  const bool is_over = !hit && taken.length == left;
  describe_step();
  if (tracking_) {
    derivative_.pass(taken);
    const bool coincides = at_once && search_.coincides(*hit, taken) &&
                           derivative_.has_own_instant(search_.guards(), hit->guard, taken);
    if (hit && (!at_once || coincides)) {
      derivative_.enter(search_.guards(), hit->guard, taken);
    } else if ((is_over && by_schedule) || (at_once && !follows_event_)) {
      // A guard that an interval finds violated at its start was not crossed: nothing delays that.
      derivative_.drop_lead(taken);
    }
  }
  const bool turned_by_rounding = !hit && search_.guards().creeps_backward(steps_.end(), taken.time(1.0));
  follows_event_ = hit || (is_over && by_schedule);
  if (follows_event_) derivative_.forget_course();
  if (tracking_ && turned_by_rounding) derivative_.drop_speed(taken);
  const Ending ending = hit ? search_.guards().ending(hit->guard) : Ending{};
  take_over((hit && is<SlipEnd>(ending)) || turned_by_rounding);
  if (turned_by_rounding) steps_.propose(0.0);
  pass_time(to_period_end && is_over && !by_schedule);
  if (leaves_range()) return nullptr;
  if (!follows_event_) {
    if (search_.has_faded()) is_laid_ = false;
    return interval_.get();
  }
  if (hit) {
    interval_->ending = act(ending, !at_once && taken.length == 0.0);
  } else {
    interval_->ending = act_on_schedule(due);
  }
  if (tracking_) derivative_.leave(present(), flow_.scales());
  is_laid_ = false;
  steps_.propose(0.0);
  return interval_.get();
}

/// What the interval tells of the step.
void SmoothEngine::describe_step() {
  interval_->begin = time();
  interval_->local_begin = local_time_;
  interval_->duration = steps_.length();
  interval_->direction = direction_;
  interval_->ending.reset();
}

/// The step's end becomes the present; `at_slip_end`: there the velocity is zero.
void SmoothEngine::take_over(bool at_slip_end) {
  if (reach_ > 0.0 && steps_.length() > 0.0) {
    VelocityHistory::Values values{};
    std::vector<double> state(steps_.end().size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      steps_.at(0.25 * static_cast<double>(k), state);
      values[k] = state[1];
    }
    past_.add(local_time_, steps_.length(), values);
  }
  steps_.go_on(at_slip_end);
  x_ = steps_.begin()[0];
  v_ = steps_.begin()[1];
  flow_.scatter(steps_.begin(), memories_);
  x_scale_ = std::max(x_scale_, std::abs(x_));
}

void SmoothEngine::pass_time(bool to_period_end) {
  local_time_ += steps_.length();
  if (!to_period_end && local_time_ < drive_.period()) return;
  local_time_ = to_period_end ? 0.0 : local_time_ - drive_.period();
  pass_period();
  past_.shift(drive_.period());
  steps_.shift(drive_.period(), local_time_);
  // Time is counted anew.
  is_laid_ = false;
}

/// Where the pull equals the limit within rounding, what both do next decides.
Engine::Balance SmoothEngine::balance() {
  judge_.freeze(memories_, Direction::none, time() - local_time_);
  std::vector<double> X;
  judge_.gather(x_, 0.0, memories_, X);
  std::vector<double> rates(X.size());
  judge_.evaluate(X, local_time_, rates);
  const double pull = judge_.pull(X, local_time_);
  const double limit = judge_.limit(X, local_time_);
  const double parts = drive_.force_scale() + limit + model_.oscillator.stiffness * std::abs(x_);
  const double tolerance = Guards::equal * parts;
  const auto at_limit = [&] {
    double pull_then = pull;
    double limit_then = limit;
    for (const double part : {1e-6, 1e-4, 1e-2}) {
      const double later = part * steps_.longest(local_time_);
      std::vector<double> then = X;
      for (std::size_t k = 2; k < then.size(); ++k) then[k] += later * rates[k];
      pull_then = judge_.pull(then, local_time_ + later);
      limit_then = judge_.limit(then, local_time_ + later);
      if (std::abs(std::abs(pull_then) - limit_then) > tolerance) break;
    }
    return direction_after_slip(pull_then, limit_then, tolerance, [&] {
      if (can_stick_) return Direction::none;
      // No law can hold the mass, so it counts as slipping, at v = 0, until something moves it.
      return pull_then < 0.0 ? Direction::backward : Direction::forward;
    });
  };
  return {direction_after_slip(pull, limit, tolerance, at_limit), limit};
}

}  // namespace dualdamp::sim
