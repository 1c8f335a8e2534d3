#include "sim/engine/smooth/motion_derivative.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "friction_models/state_sizes.hpp"
#include "sim/engine/variation.hpp"

namespace dualdamp::sim {

namespace {

/// Relative displacement of states and guards in central differences.
constexpr double displacement = 1e-5;

/// A state whose own size is far below its value (a turning point among stiff contacts) is displaced by no less
/// than this part of the value in place of its size: by a hundred million times its rounding.
constexpr double least_size = 1e-2;

/// Within this part of the shortest period before and after a stop the columns have no velocity.
constexpr double near_stop = 1e-3;

/// Part of the shortest period over which the field's change with time is a difference.
constexpr double part_for_rate = 1e-6;

/// Rates that differ by less than this part are the same before and after a mode change.
constexpr double same_rates = 1e-2;

/// Rates that differ by less than this part of the largest one do so by rounding.
constexpr double rounding_of_rates = 1e-13;

/// Gradients that differ by less than this part are those of one guard.
constexpr double same_guard = 1e-3;

Eigen::Map<const Eigen::VectorXd> as_vector(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// |df_k/dX_k| of each component at X [1/s].
std::vector<double> own_paces(const Flow& flow, std::span<const double> X, double t) {
  std::vector<double> jacobian(X.size() * X.size());
  flow.jacobian(X, t, jacobian);
  std::vector<double> paces(X.size());
  for (std::size_t k = 0; k < X.size(); ++k) paces[k] = std::abs(jacobian[k * X.size() + k]);
  return paces;
}

/// Number of x, v and the states of all laws.
Eigen::Index components(const std::vector<friction::Memory>& memories) {
  Eigen::Index n = 2;
  for (const friction::Memory& memory : memories) n += static_cast<Eigen::Index>(memory.state.size());
  return n;
}

/// Sizes of a law's states, as `Flow` has them; `sizes`: of x and v.
std::vector<double> sizes_of(const friction::Law& law, const friction::Memory& memory,
                             std::span<const double> sizes) {
  std::vector<double> own(memory.state.size(), 0.0);
  law.scales(memory, own);
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (own[k] == friction::size_of_velocity) own[k] = sizes[1];
    if (!(own[k] > 0.0)) own[k] = sizes[0];
    own[k] = std::max(own[k], least_size * std::abs(memory.state[k]));
  }
  return own;
}

}  // namespace

MotionDerivative::MotionDerivative(const Model& model, const Drive& drive, const VelocityHistory& past,
                                   double shortest_period)
    : model_(model), drive_(drive), past_(past), shortest_period_(shortest_period) {}

MotionDerivative::~MotionDerivative() = default;

void MotionDerivative::reset(const std::vector<friction::Memory>& memories, friction::Direction direction) {
  const Eigen::Index n = components(memories);
  columns_ = Eigen::MatrixXd::Identity(n, n);
  // A mass that sticks stops again at once, over a distance of second order.
  if (direction == friction::Direction::none) columns_.row(1).setZero();
  lead_ = Eigen::RowVectorXd::Zero(n);
  event_lead_ = {};
  others_.clear();
  course_.length = 0.0;
  changes_.clear();
}

Eigen::MatrixXd MotionDerivative::matrix(const Present& present) const {
  if (lead_.isZero(0.0)) return columns_;
  return columns_ + rates_now(present) * lead_;
}

void MotionDerivative::note_course(const SmoothStep& step) {
  course_.rates.resize(step.end.size());
  course_.length = step.stepper.end_rates(course_.rates) ? step.length : 0.0;
}

/// Of the motion at X. A mass that creeps under a steep dashpot has a speed that is known to the tolerance of its
/// steps, and the dashpot makes of its error an acceleration that decays at once: it is none of the motion, and a
/// lead of seconds would make a change of speed of it. A component that decays within the last step has its rate by
/// the polynomial of that step, where no event has intervened.
void MotionDerivative::rates_of_motion(const Flow& flow, std::span<const double> X, double t,
                                       std::vector<double>& rates) const {
  flow.evaluate(X, t, rates);
  if (course_.length == 0.0 || course_.rates.size() != X.size()) return;
  const std::vector<double> pace = own_paces(flow, X, t);
  for (std::size_t k = 0; k < X.size(); ++k)
    if (pace[k] * course_.length > 1.0) rates[k] = course_.rates[k];
}

/// Of the motion that begins now.
Eigen::VectorXd MotionDerivative::rates_now(const Present& present) const {
  Flow flow(model_, drive_, past_);
  flow.freeze(present.memories, present.direction, present.now.t - present.local_time);
  std::vector<double> X;
  flow.gather(present.now.x, present.now.v, present.memories, X);
  std::vector<double> rates(X.size());
  rates_of_motion(flow, X, present.local_time, rates);
  return as_vector(rates);
}

void MotionDerivative::note_change(std::size_t law, const friction::Memory& before, friction::Trigger trigger,
                                   friction::Direction direction) {
  changes_.push_back({law, before, trigger, direction});
}

void MotionDerivative::pass(const SmoothStep& step) {
  if (step.length == 0.0) return;
  lead_near_stop(step);
  const Eigen::Index rows = columns_.rows();
  if (variation_size_ != rows) variation_ = make_variation(static_cast<std::size_t>(rows));
  variation_size_ = rows;
  Eigen::VectorXd late(rows);
  const TakenStep taken{step.stepper, step.t, step.length, part_for_rate * shortest_period_, step.flow.scales()};
  const auto work = [&] { return variation_->parts() + variation_->operations() / operations_in_unit; };
  const long before = work();
  if (!variation_->pass(step.flow, taken, {columns_.data(), static_cast<std::size_t>(columns_.size())},
                        {late.data(), static_cast<std::size_t>(rows)}))
    columns_.setConstant(std::numeric_limits<double>::quiet_NaN());
  work_ += work() - before;
  columns_ -= late * lead_;
  note_course(step);
}

/// Whether the first step, or the one behind an event, leads away from the stop while a change of its speed dies
/// out. The acceleration at its start is then not known: a lead would be a large number, and what is left of the
/// change a difference of two. Where the speed passes zero within the step, by more than its error, the field is
/// that of the other branch.
bool MotionDerivative::forgets_speed(const SmoothStep& step) const {
  constexpr int parts = 16;
  if (course_.length > 0.0 || !(own_paces(step.flow, step.begin, step.t)[1] * step.length > 1.0)) return false;
  const double error = model_.solver.tolerance * step.flow.scales()[1];
  std::vector<double> state(step.begin.size());
  for (int i = 0; i <= parts; ++i) {
    step.stepper.at(static_cast<double>(i) / parts, state);
    const double speed = friction::sign(step.flow.direction()) * state[1];
    if (speed < -error || (i > 0 && speed == 0.0)) return false;
  }
  return true;
}

/// Near a stop, at the start of a step: the perturbed motion is where the velocity is the same.
void MotionDerivative::lead_near_stop(const SmoothStep& step) {
  if (step.flow.direction() == friction::Direction::none) return;
  std::vector<double> rates(step.begin.size());
  step.flow.evaluate(step.begin, step.t, rates);
  if (!(std::abs(step.begin[1]) < near_stop * shortest_period_ * std::abs(rates[1])) || forgets_speed(step)) return;
  const Eigen::RowVectorXd ahead = columns_.row(1) / rates[1];
  columns_ -= as_vector(rates) * ahead;
  columns_.row(1).setZero();
  lead_ += ahead;
}

void MotionDerivative::drop_lead(const SmoothStep& step) {
  std::vector<double> rates(step.end.size());
  rates_of_motion(step.flow, step.end, step.time(1.0), rates);
  columns_ += as_vector(rates) * lead_;
  lead_.setZero();
}

/// The lead is one along rates that are replaced with the speed. The dashpot makes a perturbation's speed anew at
/// once.
void MotionDerivative::drop_speed(const SmoothStep& step) {
  drop_lead(step);
  columns_.row(1).setZero();
  forget_course();
}

/// Of all guards at the end of the step, by the state.
Eigen::MatrixXd MotionDerivative::gradients(const Guards& guards, const SmoothStep& step) const {
  const std::span<const double> X = step.end;
  Eigen::MatrixXd gradients(static_cast<Eigen::Index>(guards.size()), static_cast<Eigen::Index>(X.size()));
  std::vector<double> displaced(X.begin(), X.end());
  std::vector<double> above;
  std::vector<double> below;
  const double t = step.time(1.0);
  const bool creeps = guards.creeps(X, t);
  for (std::size_t k = 0; k < X.size(); ++k) {
    const double change = displacement * std::max(step.flow.scales()[k], least_size * std::abs(X[k]));
    displaced[k] = X[k] + change;
    guards.evaluate(displaced, t, above);
    displaced[k] = X[k] - change;
    guards.evaluate(displaced, t, below);
    gradients.col(static_cast<Eigen::Index>(k)) = (as_vector(above) - as_vector(below)) / (2.0 * change);
    // The end of a creep is where the forces turn, whatever the speed.
    if (creeps) {
      displaced[k] = X[k] + change;
      const double faster = guards.forced_speed(displaced, t);
      displaced[k] = X[k] - change;
      gradients(0, static_cast<Eigen::Index>(k)) = (faster - guards.forced_speed(displaced, t)) / (2.0 * change);
    }
    displaced[k] = X[k];
  }
  return gradients;
}

void MotionDerivative::note_others(const Guards& guards, std::size_t guard, const Eigen::MatrixXd& gradients) {
  const auto* crossed = std::get_if<LawGuard>(&guards.ending(guard));
  if (crossed == nullptr) return;
  std::vector<Eigen::Index> rows;
  for (std::size_t w = 0; w < guards.size(); ++w) {
    const auto* other = std::get_if<LawGuard>(&guards.ending(w));
    if (w != guard && other != nullptr && other->law == crossed->law) rows.push_back(static_cast<Eigen::Index>(w));
  }
  others_.push_back({crossed->law, gradients(rows, Eigen::all)});
}

bool MotionDerivative::has_own_instant(const Guards& guards, std::size_t guard, const SmoothStep& step) const {
  const auto* crossed = std::get_if<LawGuard>(&guards.ending(guard));
  if (crossed == nullptr) return true;
  const auto last = std::ranges::find(others_.rbegin(), others_.rend(), crossed->law, &Others::law);
  if (last == others_.rend()) return true;
  const Eigen::RowVectorXd sizes = as_vector(step.flow.scales());
  const Eigen::RowVectorXd gradient = gradients(guards, step).row(static_cast<Eigen::Index>(guard));
  if (gradient.cols() != last->gradients.cols()) return false;
  const double size = gradient.cwiseProduct(sizes).cwiseAbs().maxCoeff();
  return std::ranges::any_of(last->gradients.rowwise(), [&](const auto& other) {
    return (other - gradient).cwiseProduct(sizes).cwiseAbs().maxCoeff() < same_guard * size;
  });
}

/// A lead is one along the motion and not in time: it brings the crossing no nearer as far as the guard changes
/// with time alone.
void MotionDerivative::enter(const Guards& guards, std::size_t guard, const SmoothStep& step) {
  const double t = step.time(1.0);
  const double rate = guards.rate(guard, step.end, t, step.length > 0.0 ? step.length : step.longest);
  if (step.length > 0.0) others_.clear();
  // A guard that only touches zero has no crossing to shift.
  if (rate == 0.0) return drop_lead(step);
  const Eigen::MatrixXd by_state = gradients(guards, step);
  note_others(guards, guard, by_state);
  // By the time alone, which a guard has where it asks for the drive.
  const double later = part_for_rate * shortest_period_;
  const double by_time =
      (guards.value(guard, step.end, t + later) - guards.value(guard, step.end, t - later)) / (2.0 * later);
  const Eigen::RowVectorXd ahead =
      (by_time * lead_ - by_state.row(static_cast<Eigen::Index>(guard)) * columns_) / rate;
  std::vector<double> at_event(step.end.begin(), step.end.end());
  const bool creeps = is<SlipEnd>(guards.ending(guard)) && guards.creeps(at_event, t);
  if (creeps) at_event[1] = 0.0;
  std::vector<double> rates(at_event.size());
  step.flow.evaluate(at_event, t, rates);
  // Each motion creeps to a speed of zero at its own crossing, by an acceleration that no other is to be told from.
  if (creeps) {
    rates[1] = 0.0;
    columns_.row(1).setZero();
  }
  event_lead_ = {-ahead, as_vector(rates), columns_, lead_};
  columns_ += as_vector(rates) * ahead;
  lead_ -= ahead;
}

/// A law's states after a mode change, of the perturbed motion `column`, from `states`, those before it. It is
/// displaced as a whole: at a crossing all its parts together leave the guard at zero, one of them alone does not.
/// What a law takes for rounding of its guard is so rounding here too. Empty: the law changes to other modes on the
/// two sides, so that there is no derivative.
Eigen::VectorXd MotionDerivative::through(const Change& change, const friction::Instant& now, Eigen::Index column,
                                          const Eigen::VectorXd& states, std::span<const double> sizes) const {
  const friction::Law& law = model_.friction[change.law];
  const double dx = columns_(0, column);
  const double dv = columns_(1, column);
  double part = std::max(std::abs(dx) / sizes[0], std::abs(dv) / sizes[1]);
  const std::vector<double> own = sizes_of(law, change.before, sizes);
  for (std::size_t k = 0; k < own.size(); ++k)
    part = std::max(part, std::abs(states[static_cast<Eigen::Index>(k)]) / own[k]);
  // A column that has died out is a subnormal number, by which nothing can be divided.
  const double step = part >= std::numeric_limits<double>::min() ? displacement / part : 0.0;
  bool keeps_states = true;
  const auto after = [&](double by) {
    friction::Memory memory = change.before;
    for (std::size_t k = 0; k < memory.state.size(); ++k)
      memory.state[k] += by * states[static_cast<Eigen::Index>(k)];
    friction::Instant at = now;
    at.x += by * dx;
    at.v += by * dv;
    const std::vector<double> displaced = memory.state;
    law.jump(memory, change.trigger, at, change.direction);
    keeps_states = keeps_states && memory.state == displaced;
    return memory.state;
  };
  const std::vector<double> above = after(step);
  const std::vector<double> below = after(-step);
  if (keeps_states) return states;
  if (step == 0.0) return Eigen::VectorXd::Zero(as_vector(above).size());
  if (above.size() != below.size()) return {};
  return (as_vector(above) - as_vector(below)) / (2.0 * step);
}

/// The delay of an event is taken back where it leaves the rates as they are, as many mode changes do, and
/// reversals that no law's force sees: it may be long, and the variational equation would have to tell the
/// perturbation as a small difference of the delay and of what the columns make of it.
void MotionDerivative::leave(const Present& present, std::span<const double> sizes) {
  const EventLead added = std::exchange(event_lead_, {});
  const Eigen::MatrixXd at_crossing = added.time.size() > 0 ? columns_ : Eigen::MatrixXd();
  carry_through_changes(present, sizes);
  if (added.time.size() == 0) return;
  const Eigen::VectorXd rates = rates_now(present);
  if (rates.size() != added.rates_before.size()) return;
  const auto parts = as_vector(sizes).array();
  const double change = ((rates - added.rates_before).array() / parts).abs().maxCoeff();
  if (!(change < same_rates * (added.rates_before.array() / parts).abs().maxCoeff())) return;
  take_back(added, at_crossing, rates, sizes);
}

/// `at_crossing`: the columns before the mode changes. Where a guard reaches zero at no rate, as a late speed does
/// when a mass is released that has long been at rest, the delay is so long that its rounding is more than the lead
/// that was there before. So states that the mode change leaves alone are changed by the difference of the rates
/// alone.
void MotionDerivative::take_back(const EventLead& added, const Eigen::MatrixXd& at_crossing,
                                 const Eigen::VectorXd& rates, std::span<const double> sizes) {
  lead_ = added.lead_before;
  if (columns_.rows() != at_crossing.rows() || columns_ != at_crossing) {
    columns_ += rates * added.time;
    return;
  }
  const Eigen::ArrayXd parts = as_vector(sizes);
  Eigen::VectorXd turn = rates - added.rates_before;
  const double rounding = rounding_of_rates * (rates.array() / parts).abs().maxCoeff();
  turn = (turn.array().abs() < rounding * parts).select(0.0, turn);
  columns_ = added.columns_before + turn * added.time;
}

/// The motion after the mode changes begins with the same lead.
void MotionDerivative::carry_through_changes(const Present& present, std::span<const double> sizes) {
  if (changes_.empty()) return;
  const std::vector<friction::Memory>& memories = present.memories;
  Eigen::MatrixXd result(components(memories), columns_.cols());
  result.topRows(2) = columns_.topRows(2);
  Eigen::Index row = 2;
  Eigen::Index row_before = 2;
  for (std::size_t i = 0; i < memories.size(); ++i) {
    const auto of_law = [&](const Change& change) { return change.law == i; };
    const auto first = std::ranges::find_if(changes_, of_law);
    const friction::Memory& before = first == changes_.end() ? memories[i] : first->before;
    const auto count_before = static_cast<Eigen::Index>(before.state.size());
    const auto count = static_cast<Eigen::Index>(memories[i].state.size());
    for (Eigen::Index c = 0; c < columns_.cols(); ++c) {
      Eigen::VectorXd states = columns_.col(c).segment(row_before, count_before);
      for (const Change& change : changes_) {
        if (of_law(change) && as_vector(change.before.state).size() == states.size())
          states = through(change, present.now, c, states, sizes);
      }
      if (states.size() != count) states.setConstant(count, std::numeric_limits<double>::quiet_NaN());
      result.col(c).segment(row, count) = states;
    }
    row += count;
    row_before += count_before;
  }
  columns_ = std::move(result);
}

}  // namespace dualdamp::sim
