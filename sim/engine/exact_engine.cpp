#include "sim/engine/exact_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/crossing/first_crossing.hpp"
#include "friction_models/state_sizes.hpp"
#include "sim/engine/closed_form.hpp"
#include "sim/engine/sticking_gate.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using core::Complex;
using core::ModeFunction;
using friction::Affine;
using friction::Direction;

namespace {

/// An amplitude that has decayed by exp(-gone) has died out.
constexpr double gone = 45.0;
/// In this part of the fastest element's time no value of the motion changes.
constexpr double still = std::numeric_limits<double>::epsilon();

}  // namespace

/// The interval of the exact engine. It uses the functions of the engine, which are valid until the engine's next
/// call. Only the drive is already at the end of the interval, so it is evaluated backwards from there.
class ExactEngine::ExactInterval final : public Interval {
 public:
  explicit ExactInterval(const ExactEngine& engine) : engine_(engine) {}

  [[nodiscard]] Sample at(double s) const override {
    const core::ExponentialBasis& basis = engine_.mode_->basis();
    core::ExponentialBasis::Values room;
    const bool is_end = s == duration;  // the values at the end are known
    if (!is_end) basis.evaluate(s, room);
    const core::ExponentialBasis::Values& values = is_end ? engine_.crossing_.values : room;
    const Drive::Value drive = engine_.drive_.at(s - duration);
    Sample sample{.t = begin + s, .y = drive.y, .y_rate = drive.y_rate, .external = drive.external};
    // A motion begins where it was set, not where the sum of its exponentials rounds to.
    const bool is_start = s == 0.0;
    sample.x = is_start ? begin_x : core::evaluate(basis, engine_.motion_, values);
    const Oscillator& o = engine_.model_.oscillator;
    if (direction == Direction::none) {
      // Friction balances all other forces.
      const double damper = o.damper_to == DamperTo::base ? o.damping * drive.y_rate : 0.0;
      sample.force = o.stiffness * (drive.y - sample.x) + damper + drive.external;
      return sample;
    }
    sample.v = is_start ? begin_v : core::evaluate(basis, engine_.speed(), values) * friction::sign(direction);
    sample.a = core::evaluate(basis, engine_.speed_rate(), values) * friction::sign(direction);
    sample.force = force.constant + force.rate * s + force.position * sample.x + force.velocity * sample.v;
    for (std::size_t i = 0; i < decays.size(); ++i) sample.force += transients[i] * std::exp(-decays[i] * s);
    return sample;
  }

  [[nodiscard]] double resolution(double s) const override {
    const core::ExponentialBasis& basis = engine_.mode_->basis();
    double square = 0.0;
    for (int k = 0; k < basis.size(); ++k) {
      if (-basis.exponent(k).real() * s < gone) square = std::max(square, basis.square(k));
    }
    const double width = square > 0.0 ? 1.6 / std::sqrt(square) : duration;
    // A cubic drive has no rate of its own. Products of the quantities that it moves are of degree nine. Five
    // points integrate them; three, which are enough if a panel is a tiny part of its resolution, do not.
    return engine_.mode_->degree() > 1 ? std::min(width, 64.0 * (duration - s)) : width;
  }

  [[nodiscard]] const ClosedForm* closed_form() const override {
    // The closed form does not contain polynomials of the drive.
    if (engine_.mode_->degree() > 0 || !ClosedForm::covers(engine_.mode_->basis())) return nullptr;
    if (!formed_) form();
    formed_ = true;
    return &form_;
  }

  /// To call when the engine begins another interval.
  void forget() { formed_ = false; }

  double begin_x = 0.0;  ///< m
  double begin_v = 0.0;  ///< m/s
  Affine force;          ///< sum of all laws, without the transients
  std::vector<double> transients;
  std::vector<double> decays;

 private:
  void form() const;

  const ExactEngine& engine_;
  mutable ClosedForm form_;
  mutable bool formed_ = false;
};

void ExactEngine::ExactInterval::form() const {
  const LinearMode& mode = *engine_.mode_;
  const core::ExponentialBasis& basis = mode.basis();
  const Drive& drive = engine_.drive_;
  form_.basis = &basis;
  form_.duration = duration;
  core::copy(basis, engine_.crossing_.values, form_.end);
  core::assign(basis, 1.0, engine_.motion_, form_.x);
  ModeFunction& driven = drive.moves_base() ? form_.y : form_.external;
  core::clear(basis, drive.moves_base() ? form_.external : form_.y);
  mode.represent({.polynomial = {drive.offset()}}, driven);
  for (std::size_t j = 0; j < drive.frequencies().size(); ++j) {
    const auto k = static_cast<std::size_t>(mode.harmonic_element(j));
    const Complex start = drive.phasor(j) * Complex(form_.end.re[k], -form_.end.im[k]);
    driven.re[k] += start.real();
    driven.im[k] += start.imag();
  }
  core::differentiate(basis, form_.y, form_.y_rate);
  core::clear(basis, form_.v);
  core::clear(basis, form_.a);
  core::clear(basis, form_.force);
  if (direction == Direction::none) return;
  core::assign(basis, friction::sign(direction), engine_.speed(), form_.v);
  core::assign(basis, friction::sign(direction), engine_.speed_rate(), form_.a);
  mode.represent({.polynomial = {force.constant}, .transients = transients}, form_.force);
  core::accumulate(basis, force.position, form_.x, form_.force);
  core::accumulate(basis, force.velocity, form_.v, form_.force);
}

ExactEngine::ExactEngine(const Model& model) : Engine(model), interval_(std::make_unique<ExactInterval>(*this)) {
  require(is_exact(model_), "the exact engine needs a linear spring and laws that are affine in every mode",
          "make_engine() chooses the engine");
  law_guard_counts_.resize(model_.friction.size());
  forcing_.phasors.resize(drive_.frequencies().size());
  start(model.initial.position, model.initial.velocity);
}

ExactEngine::~ExactEngine() = default;

void ExactEngine::begin_motion() {
  drive_.reset(0.0);
  instant_scale_ = 0.0;
  follows_at_once_ = false;
  changed_law_.reset();
  if (tracking_) reset_sensitivity();
}

void ExactEngine::reset_sensitivity() {
  const Oscillator& oscillator = model_.oscillator;
  const double omega = std::sqrt(std::abs(oscillator.stiffness) / oscillator.mass);
  double size =
      std::max({std::abs(x_), std::abs(v_) / omega, drive_.force_scale() / std::abs(oscillator.stiffness)});
  std::vector<double>& units = units_of_perturbations_;
  units.assign(2, 1.0);
  for (std::size_t i = 0; i < memories_.size(); ++i) {
    const std::size_t first = units.size();
    const std::vector<double>& state = memories_[i].state;
    units.resize(first + state.size(), 0.0);
    model_.friction[i].scales(memories_[i], std::span(units).subspan(first));
    for (std::size_t k = 0; k < state.size(); ++k) {
      const bool is_velocity = units[first + k] == friction::size_of_velocity;
      units[first + k] = is_velocity ? omega : 1.0;
      size = std::max(size, std::abs(state[k]) / units[first + k]);
    }
  }
  units[1] = omega;
  const double length = size > 0.0 && std::isfinite(size) ? size : 1.0;
  for (double& unit : units) unit = std::ldexp(1.0, std::ilogb(length * unit) + 1);
  sensitivity_.begin(memories_, some_memory_, units);
}

Engine::Balance ExactEngine::balance() {
  collect(false);
  const double pull = pull_now();
  const double limit = total_->limit.constant;
  const double scale = force_scale() + limit;
  return {direction_after_slip(pull, limit, clearly * scale, [&] { return leaves_limit(rounding * scale); }),
          limit};
}

/// If the pull is within rounding of the limit, the Taylor germs of both guards decide whether it leaves the limit.
Direction ExactEngine::leaves_limit(double tolerance) {
  const LinearMode* present = mode_;
  ModeFunction pull;
  mode_ = &pull_on_mode(pull);
  Direction direction = Direction::none;
  for (const Direction candidate : {Direction::forward, Direction::backward}) {
    ModeFunction guard;
    limit_guard(pull, friction::sign(candidate), guard);
    if (core::germ(mode_->basis(), guard, tolerance).sign < 0) direction = candidate;
  }
  const bool is_held = total_->limit.constant != 0.0 || total_->limit.rate != 0.0;
  if (direction == Direction::none && !is_held) direction = moved_later(pull, tolerance);
  mode_ = present;
  return direction;
}

/// If no law holds the mass here, it stays at rest only if nothing ever moves it.
Direction ExactEngine::moved_later(const ModeFunction& pull, double tolerance) const {
  return friction::direction_of(clear_of_rounding(pull, tolerance).value);
}

/// Beside a fast decay the Taylor coefficients of a slow drive are within rounding, so `f` is evaluated after
/// longer and longer times, up to the first at which it is known.
ExactEngine::Later ExactEngine::clear_of_rounding(const ModeFunction& f, double tolerance) const {
  constexpr int doublings = 60;
  const core::ExponentialBasis& basis = mode_->basis();
  double s = basis.fastest() > 0.0 ? 1.0 / basis.fastest() : 1.0;
  for (int i = 0; i < doublings; ++i, s *= 2.0) {
    core::ExponentialBasis::Values values;
    basis.evaluate(s, values);
    const double later = core::evaluate(basis, f, values);
    if (!std::isfinite(later)) break;
    const double error = rounding * core::bound(basis, f, values, s, 0.0) + tolerance;
    if (std::abs(later) > error) return {later, error};
  }
  return {};
}

void ExactEngine::jumped(std::size_t law, const friction::Memory& before, friction::Trigger trigger) {
  sensitivity_.jump(model_.friction[law], law, before, memories_[law], trigger, now(), direction_);
}

/// Keeps the rounding of x and v at the end of an interval, as in the search (core/crossing/first_crossing.hpp),
/// and of the time of the event. The amplitudes may be far larger than those of the next interval. An interval
/// shorter than the rounding of the event before it begins and ends at one instant.
void ExactEngine::keep_rounding(double s) {
  x_rounding_ = v_rounding_ = 0.0;
  if (s > time_rounding_) time_rounding_ = 0.0;
  const core::ExponentialBasis& basis = mode_->basis();
  const double part = rounding + std::numeric_limits<double>::epsilon() * basis.turning() * s;
  if (crossing_.found) {
    const core::Guard& guard = guards_[static_cast<std::size_t>(crossing_.guard)];
    keep_time_rounding(part * core::bound(basis, guard.value, crossing_.values, s, 0.0),
                       core::evaluate(basis, guard.slope, crossing_.values),
                       core::evaluate(basis, guard.curvature, crossing_.values));
  }
  if (direction_ == Direction::none) return;
  x_rounding_ = part * core::bound(basis, motion_, crossing_.values, s, 0.0);
  v_rounding_ = part * core::bound(basis, speed(), crossing_.values, s, 0.0);
}

/// The rounding of the time at which a guard known to `error` falls through zero: the time in which its tangent
/// parabola falls by `error`.
void ExactEngine::keep_time_rounding(double error, double slope, double curvature) {
  const double fall = std::max(0.0, -slope);
  const double speed = fall + std::sqrt(fall * fall + 2.0 * std::max(0.0, -curvature) * error);
  if (speed > 0.0) time_rounding_ = std::max(time_rounding_, 2.0 * error / speed);
}

/// Ends the interval after s: advances position, velocity, drive and the laws' states.
void ExactEngine::advance(double s, bool to_period_end) {
  const core::ExponentialBasis& basis = mode_->basis();
  if (some_memory_ && s > 0.0) keep_rounding(s);
  const friction::Instant before = now();
  if (direction_ != Direction::none && s > 0.0) {
    x_ = core::evaluate(basis, motion_, crossing_.values);
    v_ = friction::sign(direction_) * core::evaluate(basis, speed(), crossing_.values);
  }
  if (crossing_.found && is<SlipEnd>(watches_[static_cast<std::size_t>(crossing_.guard)].ending)) v_ = 0.0;
  local_time_ += s;
  if (to_period_end || local_time_ >= drive_.period()) {
    local_time_ = to_period_end ? 0.0 : local_time_ - drive_.period();
    pass_period();
    drive_.end_period(local_time_);
  } else {
    for (std::size_t j = 0; j < drive_.frequencies().size(); ++j) {
      const auto k = static_cast<std::size_t>(mode_->harmonic_element(j));
      drive_.turn(j, {crossing_.values.re[k], crossing_.values.im[k]});
    }
    drive_.pass(s);
  }
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (has_memory_[i]) model_.friction[i].advance(memories_[i], before, now(), s, direction_);
  }
}

double ExactEngine::start_acceleration() const {
  if (direction_ == Direction::none) return 0.0;
  return friction::sign(direction_) * core::at_start(mode_->basis(), speed_rate());
}

/// At the start of an interval: carries perturbations from a crossing back to the common time, unless the next
/// event follows at once.
void ExactEngine::track_begin(const friction::Instant& begin, bool at_once) {
  if (!at_once) sensitivity_.leave(start_acceleration(), model_.friction, memories_, begin, direction_);
  sensitivity_.begin_interval(model_.friction, memories_, begin, direction_, total_->decays);
  if (sensitivity_.has_states()) memories_before_ = memories_;
}

/// Carries perturbations of motion and guard over the interval of length `s`; the memories are those of its start.
void ExactEngine::track_motion(const friction::Instant& begin, double s) {
  if (direction_ == Direction::none) {
    sensitivity_.stick();
  } else {
    responses_.clear();
    for (std::size_t j = 0; sensitivity_.has_states() && j <= total_->decays.size(); ++j)
      responses_.push_back(mode_->response(j, crossing_.values));
    sensitivity_.slip(mode_->propagator(crossing_.values), responses_);
  }
  if (!crossing_.found || sensitivity_.at_crossing()) return;
  const Ending& ending = watches_[static_cast<std::size_t>(crossing_.guard)].ending;
  if (const auto* stick = std::get_if<StickEnd>(&ending))
    sensitivity_.perturb_limit(-friction::sign(stick->release), total_->decays, s);
  if (const auto* of = std::get_if<LawGuard>(&ending)) {
    sensitivity_.perturb_guard(model_.friction, memories_, begin, direction_, of->law,
                               static_cast<std::size_t>(of->guard), s);
  }
}

/// At the end of the interval: carries the states of the laws, and at an event all perturbations to their
/// crossings.
void ExactEngine::track_states(const friction::Instant& begin, double s, bool event) {
  for (std::size_t i = 0; i < model_.friction.size() && sensitivity_.has_states(); ++i) {
    const friction::Law& law = model_.friction[i];
    if (has_memory_[i] && law.advances())
      sensitivity_.advance(law, i, memories_before_[i], memories_[i], begin, now(), s, direction_);
  }
  if (!event || sensitivity_.at_crossing()) return;
  Sensitivity::Event crossing{
      .velocity = v_,
      .acceleration =
          direction_ == Direction::none
              ? 0.0
              : friction::sign(direction_) * core::evaluate(mode_->basis(), speed_rate(), crossing_.values)};
  if (crossing_.found) {
    const Watch& watch = watches_[static_cast<std::size_t>(crossing_.guard)];
    const core::Guard& guard = guards_[static_cast<std::size_t>(crossing_.guard)];
    crossing.by_position = watch.by_position;
    crossing.by_velocity = watch.by_velocity;
    // A guard that was violated at the start was not crossed: no perturbation delays this event.
    crossing.slope = is_forced() ? 0.0 : core::evaluate(mode_->basis(), guard.slope, crossing_.values);
  }
  sensitivity_.enter(crossing, model_.friction, memories_, now(), direction_);
}

bool ExactEngine::is_forced() const {
  const core::Guard& guard = guards_[static_cast<std::size_t>(crossing_.guard)];
  return crossing_.s == 0.0 && core::at_start(mode_->basis(), guard.value) <
                                   -clearly * core::start_amplitude(mode_->basis(), guard.value);
}

/// Whether an event at the start of an interval is not caused by the last event: two laws reach their guards at one
/// instant. A perturbation delays the two crossings by different times.
bool ExactEngine::coincides() const {
  const auto* guard = std::get_if<LawGuard>(&watches_[static_cast<std::size_t>(crossing_.guard)].ending);
  return guard != nullptr && changed_law_ && guard->law != *changed_law_ && !is_forced();
}

bool ExactEngine::search(double horizon) {
  const long before = Engine::work();
  const core::SearchEnd end =
      core::first_crossing(mode_->basis(), {guards_.data(), guard_count_}, horizon, crossing_, grazings_, count_);
  const long terms = static_cast<long>(guard_count_) * mode_->basis().size();
  if (terms > terms_in_unit) long_work_ += (Engine::work() - before) * (terms - terms_in_unit) / terms_in_unit;
  if (end == core::SearchEnd::left_range) leave_range();
  if (end == core::SearchEnd::too_long)
    outcome_ = {
        core::OutcomeKind::event_limit,
        "the computation was stopped: the motion oscillates too often between two events or before the end of "
        "a forcing period"};
  return outcome_.ok();
}

const Interval* ExactEngine::step(double left, bool to_period_end) {
  if (!outcome_.ok() || !(left > 0.0)) return nullptr;
  const friction::Instant begin = now();
  const double due = next_schedule();
  const bool by_schedule = due - begin.t < left;
  if (by_schedule) left = std::max(0.0, due - begin.t);
  build_interval();
  grazings_.clear();
  if (!std::isfinite(force_scale_)) {
    leave_range();
    return nullptr;
  }
  const bool at_once = find_violated();
  if (tracking_) track_begin(begin, at_once && !coincides());
  if (!at_once && !search(left)) return nullptr;
  const core::Crossing& end = crossing_;
  instant_scale_ = at_once ? std::max(instant_scale_, force_scale_) : force_scale_;
  const bool stands = !at_once && end.found && end.s * mode_->basis().fastest() < still;
  if (!comes_to_an_end(at_once || left == 0.0 || stands)) return nullptr;
  follows_at_once_ = at_once || stands;
  describe_interval(begin.t);
  const bool ends = end.found || by_schedule;
  if (tracking_) track_motion(begin, end.s);
  advance(end.s, to_period_end && !ends);
  if (tracking_) track_states(begin, end.s, ends);
  if (leaves_range()) return nullptr;
  changed_law_.reset();
  if (end.found) {
    const Ending ending = watches_[static_cast<std::size_t>(end.guard)].ending;
    if (const auto* guard = std::get_if<LawGuard>(&ending)) changed_law_ = guard->law;
    interval_->ending = act(ending, (at_once || stands) && begin.v == 0.0);
  } else if (by_schedule) {
    interval_->ending = act_on_schedule(due);
  }
  return interval_.get();
}

/// Fills in the interval that the engine gives out.
void ExactEngine::describe_interval(double begin) {
  interval_->forget();
  interval_->begin = begin;
  interval_->duration = crossing_.s;
  interval_->direction = direction_;
  interval_->begin_x = x_;
  interval_->begin_v = v_;
  interval_->force = total_->force;
  if (!total_->decays.empty() || !interval_->decays.empty()) {
    interval_->transients = total_->transients;
    interval_->decays = total_->decays;
  }
  interval_->ending.reset();
}

}  // namespace dualdamp::sim
