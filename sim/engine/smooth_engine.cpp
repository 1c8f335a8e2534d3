#include "sim/engine/smooth_engine.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/constants.hpp"

namespace dualdamp::sim {

using friction::Direction;

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

/// A step is at most this part of the shortest period, so that five points show every minimum of a guard.
constexpr double part_of_period = 0.125;

/// Part of force/stiffness that counts as the size of a motion that has none yet.
constexpr double small_motion = 1e-3;

constexpr int max_rejections = 200;

/// Kinks of a delayed velocity pass on this often, each time one derivative higher.
constexpr int echoes = 4;

}  // namespace

/// One step as an interval: the dense output of the stepper.
class SmoothEngine::StepInterval final : public Interval {
 public:
  explicit StepInterval(const SmoothEngine& engine) : engine_(engine) {}

  [[nodiscard]] Sample at(double s) const override {
    state.resize(engine_.end_.size());
    if (duration > 0.0) {
      engine_.stepper_->at(std::clamp(s / duration, 0.0, 1.0), state);
    } else {
      state = engine_.end_;
    }
    Sample sample = engine_.flow_.sample(state, local_begin + s);
    sample.t = begin + s;
    return sample;
  }
  [[nodiscard]] double resolution(double) const override { return duration; }

  double local_begin = 0.0;           ///< within the forcing period [s]
  mutable std::vector<double> state;  ///< scratch

 private:
  const SmoothEngine& engine_;
};

SmoothEngine::SmoothEngine(const Model& model)
    : Engine(model),
      flow_(model, drive_, past_),
      judge_(model, drive_, past_),
      search_(model_, flow_),
      derivative_(model_, drive_, past_, shortest_period()),
      interval_(std::make_unique<StepInterval>(*this)) {
  for (const friction::Law& law : model_.friction) reach_ = std::max(reach_, law.delay());
  is_implicit_ = model.solver.kind == SolverKind::implicit_steps;
  stepper_ = is_implicit_ ? make_implicit_stepper() : make_explicit_stepper();
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
         stepper_->operations() / operations_in_unit;
}

void SmoothEngine::begin_motion() {
  drive_.reset(0.0);
  past_.clear(v_, reach_);
  breaks_.clear();
  is_laid_ = false;
  h_ = 0.0;
  x_scale_ = 0.0;
  counted_to_ = 0.0;
  search_.forget_landing();
  follows_event_ = false;
  if (tracking_) reset_sensitivity();
}

void SmoothEngine::restore_past(const State& state) {
  if (state.past != nullptr) past_ = *state.past;
  // A state that Newton's method has displaced may move against its direction. That branch is not its own: a force
  // that falls with speed grows there without bound.
  if (friction::sign(direction_) * v_ < 0.0) change_direction(v_ > 0.0 ? Direction::forward : Direction::backward);
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
  flow_.gather(x_, v_, memories_, X_);
  end_.resize(X_.size());
  error_.resize(X_.size());
  rates_.resize(X_.size());
  search_.begin_interval(X_, local_time_, drive_.force_scale());
}

void SmoothEngine::reset_sensitivity() { derivative_.reset(memories_, direction_); }

Eigen::MatrixXd SmoothEngine::sensitivity() const { return derivative_.matrix(present()); }

void SmoothEngine::jumped(std::size_t law, const friction::Memory& before, friction::Trigger trigger) {
  derivative_.note_change(law, before, trigger, direction_);
}

MotionDerivative::Present SmoothEngine::present() const {
  return {.now = now(), .local_time = local_time_, .direction = direction_, .memories = memories_};
}

SmoothStep SmoothEngine::last_step() const {
  return {.flow = flow_,
          .stepper = *stepper_,
          .begin = X_,
          .end = end_,
          .t = local_time_,
          .length = taken_,
          .longest = longest_step()};
}

/// Local errors allowed in each component.
void SmoothEngine::allow() {
  allowed_.resize(X_.size());
  for (std::size_t k = 0; k < X_.size(); ++k)
    allowed_[k] = model_.solver.tolerance * (std::abs(X_[k]) + flow_.scales()[k]);
}

/// Largest error of the last step over what is allowed.
double SmoothEngine::excess_error() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < error_.size(); ++k) {
    const double excess = std::abs(error_[k]) / allowed_[k];
    // max() would pass over what is not a number.
    if (!std::isfinite(excess)) return infinity;
    largest = std::max(largest, excess);
  }
  return largest;
}

/// Near the end of the range the terms of a step and of its dense output overflow before the motion itself does.
bool SmoothEngine::is_near_end_of_range() const {
  constexpr double safe = 1e280;
  return !std::ranges::all_of(X_, [](double value) { return std::abs(value) < safe; });
}

/// A softening spring pushes outward beyond sqrt(-k/k3), and the mass is infinitely far away within a finite time.
bool SmoothEngine::has_run_away() const {
  const Oscillator& oscillator = model_.oscillator;
  constexpr double far = 10.0;
  return oscillator.cubic_stiffness < 0.0 &&
         std::abs(Engine::state().x) > far * std::sqrt(-oscillator.stiffness / oscillator.cubic_stiffness);
}

/// Of the oscillator and its drive [s].
double SmoothEngine::shortest_period() const {
  double fastest = natural_frequency(model_.oscillator);
  for (const double frequency : drive_.frequencies()) fastest = std::max(fastest, frequency);
  return core::two_pi / fastest;
}

/// As far as implicit steps see it: an overdamped oscillator has no period of its own, and they pass over the fast
/// one of its two decays where nothing is left of it.
double SmoothEngine::shortest_seen() const {
  const Oscillator& oscillator = model_.oscillator;
  const double own = natural_frequency(oscillator);
  const double ratio = oscillator.damping / (2.0 * oscillator.mass * own);
  if (!is_implicit_ || !(ratio > 1.0)) return shortest_period();
  double fastest = own / (ratio + std::sqrt(ratio * ratio - 1.0));
  for (const double frequency : drive_.frequencies()) fastest = std::max(fastest, frequency);
  return core::two_pi / fastest;
}

double SmoothEngine::longest_step() const {
  double longest = part_of_period * shortest_seen();
  for (const friction::Law& law : model_.friction) {
    if (law.delay() > 0.0) longest = std::min(longest, law.delay());
  }
  for (const double kink : breaks_) {
    // Shorter than rounding of time: passed.
    const double ahead = kink - local_time_;
    if (ahead > 1e-12 * longest) longest = std::min(longest, ahead);
  }
  return longest;
}

/// A step whose second-order term is a hundredth of what is allowed at the method's order (hairer1993, II.4).
double SmoothEngine::first_step() {
  flow_.evaluate(X_, local_time_, rates_);
  const auto norm = [&](const std::vector<double>& values) {
    double largest = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k)
      largest = std::max(largest, std::abs(values[k]) / flow_.scales()[k]);
    return largest;
  };
  const double first = norm(rates_);
  const double trial = first > 0.0 ? 1e-4 / first : 1e-4 * longest_step();
  probe_ = X_;
  for (std::size_t k = 0; k < probe_.size(); ++k) probe_[k] += trial * rates_[k];
  std::vector<double> later(rates_.size());
  flow_.evaluate(probe_, local_time_ + trial, later);
  for (std::size_t k = 0; k < later.size(); ++k) later[k] = (later[k] - rates_[k]) / trial;
  const double rate = std::max(first, std::sqrt(norm(later)));
  const double exponent = 1.0 / (stepper_->order() + 1);
  return rate > 0.0 ? std::pow(0.01 * model_.solver.tolerance, exponent) / rate : longest_step();
}

bool SmoothEngine::use_implicit_steps() {
  if (is_implicit_ || model_.solver.kind != SolverKind::automatic) return false;
  is_implicit_ = true;
  stepper_ = make_implicit_stepper();
  return true;
}

/// Whether friction turns the acceleration over within a thousandth of the longest step: a dashpot that holds the
/// mass. Explicit steps would be lost on it.
bool SmoothEngine::begins_stiff() {
  if (direction_ == Direction::none) return false;
  const double s = part_of_longest * longest_step();
  flow_.evaluate(X_, local_time_, rates_);
  const double acceleration = rates_[1];
  probe_ = X_;
  for (std::size_t k = 0; k < probe_.size(); ++k) probe_[k] += s * rates_[k];
  flow_.evaluate(probe_, local_time_ + s, rates_);
  return acceleration * rates_[1] < 0.0 && std::abs(rates_[1]) > 0.1 * std::abs(acceleration);
}

/// Counts steps that stability limits. The dense output of the present step is needed still: the change comes with
/// the next one.
void SmoothEngine::notice_stiffness() {
  if (!is_implicit_) stiff_steps_.add(stepper_->stiffness());
}

/// One accepted step from X_ to end_, at most `left` long; taken_ says how long.
bool SmoothEngine::advance(double left) {
  const bool hold_off = h_ == 0.0 && !is_implicit_ && begins_stiff();
  if ((hold_off || stiff_steps_.are_many()) && use_implicit_steps()) h_ = 0.0;
  if (h_ == 0.0) h_ = first_step();
  allow();
  const double longest = longest_step();
  bool rejected = false;
  for (int i = 0; i < max_rejections; ++i) {
    if (!makes_headway()) return false;
    double h = std::min(h_, longest);
    // No tiny step is left over at the end.
    if (1.01 * h >= left) {
      h = left;
    } else if (2.0 * h > left) {
      h = 0.5 * left;
    }
    const bool solved = stepper_->step(flow_, X_, local_time_, h, allowed_, end_, error_);
    const double excess = solved ? excess_error() : infinity;
    const double ideal = excess > 0.0 ? safety * std::pow(excess, -1.0 / (stepper_->order() + 1)) : largest_growth;
    if (excess <= 1.0) {
      taken_ = h;
      const double next = h * std::clamp(ideal, largest_cut, rejected ? 1.0 : largest_growth);
      h_ = h < h_ ? std::max(h_, next) : next;
      notice_stiffness();
      return true;
    }
    rejected = true;
    h_ = h * std::clamp(ideal, solved ? largest_cut : unsolved_cut, 0.7);
    if (h_ < 1e-14 * longest && use_implicit_steps()) h_ = first_step();
    if (h_ < 1e-100 * longest) break;
  }
  if (is_near_end_of_range() && !has_run_away()) {
    leave_range();
    return false;
  }
  outcome_ = {core::OutcomeKind::not_finite,
              "the equation of motion could not be integrated at t = " + std::to_string(time()) +
                  " s: steps became too small" +
                  (has_run_away() ? std::string(": ") + ran_away : infinite_force())};
  return false;
}

/// One step that ends at an event or before it.
bool SmoothEngine::move(double left, std::optional<Hit>& hit) {
  for (int i = 0; i < max_rejections; ++i) {
    if (!advance(left)) return false;
    ++count_.searches;
    count_.panels += EventSearch::panels;
    const SmoothStep whole = last_step();
    hit = search_.find(whole);
    if (hit && !is_implicit_ && search_.ends_against_flow(*hit, whole)) {
      // Where explicit steps are asked for by name shorter ones follow the creep, or say that they are too many.
      h_ = use_implicit_steps() ? 0.0 : 0.25 * whole.length;
      continue;
    }
    if (hit && search_.may_be_swing_of_output(*hit, whole)) {
      h_ = 0.25 * whole.length;
      continue;
    }
    if (!hit || land(*hit)) {
      if (passes_over_turn(hit && is<SlipEnd>(search_.guards().ending(hit->guard)))) continue;
      // Beyond the event nothing grazed.
      grazings_ = search_.grazings();
      std::erase_if(grazings_, [&](const core::Grazing& grazing) { return grazing.s > taken_; });
      count_.grazings += static_cast<long>(grazings_.size());
      return true;
    }
    h_ = 0.5 * hit->part * whole.length;
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
  taken_ = 0.0;
  end_ = X_;
  std::optional<Hit> hit = search_.find_violated(last_step());
  const bool at_once = hit.has_value();
  if (!at_once && left > 0.0) {
    search_.forget_landing();
    if (!move(left, hit)) return nullptr;
    if (hit) search_.note_landing(*hit, last_step());
  }
  if (!comes_to_an_end(taken_ == 0.0)) return nullptr;
  const bool is_over = !hit && taken_ == left;
  describe_step();
  if (tracking_) {
    const SmoothStep taken = last_step();
    derivative_.pass(taken);
    if (hit && (!at_once || search_.coincides(*hit, taken))) {
      derivative_.enter(search_.guards(), hit->guard, taken);
    } else if ((is_over && by_schedule) || (at_once && !follows_event_)) {
      // A guard that an interval finds violated at its begin was not crossed: nothing delays that.
      derivative_.drop_lead(taken);
    }
  }
  follows_event_ = hit || (is_over && by_schedule);
  if (follows_event_) derivative_.forget_course();
  const Ending ending = hit ? search_.guards().ending(hit->guard) : Ending{};
  take_over(hit && is<SlipEnd>(ending));
  pass_time(to_period_end && is_over && !by_schedule);
  if (leaves_range()) return nullptr;
  if (!follows_event_) {
    if (search_.has_faded()) is_laid_ = false;
    return interval_.get();
  }
  if (hit) {
    ended_at_once_ = !at_once && taken_ == 0.0 && is<SlipEnd>(ending);
    interval_->ending = act(ending);
    ended_at_once_ = false;
  } else {
    interval_->ending = act_on_schedule(due);
  }
  if (tracking_) derivative_.leave(present(), flow_.scales());
  is_laid_ = false;
  h_ = 0.0;
  return interval_.get();
}

/// What the interval tells of the step.
void SmoothEngine::describe_step() {
  interval_->begin = time();
  interval_->local_begin = local_time_;
  interval_->duration = taken_;
  interval_->direction = direction_;
  interval_->ending.reset();
}

/// The step's end becomes the present; `at_slip_end`: there the velocity is zero.
void SmoothEngine::take_over(bool at_slip_end) {
  if (reach_ > 0.0 && taken_ > 0.0) {
    VelocityHistory::Values values{};
    interval_->state.resize(end_.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      stepper_->at(0.25 * static_cast<double>(k), interval_->state);
      values[k] = interval_->state[1];
    }
    past_.add(local_time_, taken_, values);
  }
  X_ = end_;
  if (at_slip_end) {
    X_[1] = 0.0;
    for (const friction::Law& law : model_.friction) {
      for (int j = 1; j <= echoes && law.delay() > 0.0; ++j)
        breaks_.push_back(local_time_ + taken_ + j * law.delay());
    }
  }
  x_ = X_[0];
  v_ = X_[1];
  flow_.scatter(X_, memories_);
  x_scale_ = std::max(x_scale_, std::abs(x_));
}

void SmoothEngine::pass_time(bool to_period_end) {
  local_time_ += taken_;
  if (!to_period_end && local_time_ < drive_.period()) return;
  local_time_ = to_period_end ? 0.0 : local_time_ - drive_.period();
  pass_period();
  past_.shift(drive_.period());
  for (double& kink : breaks_) kink -= drive_.period();
  std::erase_if(breaks_, [&](double kink) { return kink < local_time_; });
  // Time is counted anew.
  is_laid_ = false;
}

}  // namespace dualdamp::sim
