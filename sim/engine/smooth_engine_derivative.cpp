// The derivative of a motion of the smooth engine by its start. A perturbation is kept in two parts,
//
//   d(x, v, states)(now) = columns + f(now) lead,
//
// a change of the state and a time by which the perturbed motion is ahead. Both are exact together for every choice
// of `lead`; the choice says what an error of the variational equation does. Where v passes zero a force may turn
// over within less than rounding (rate_state, a steep dashpot): what a velocity is there says nothing, but the time
// at which it is zero does. So near v = 0 the columns have no velocity, and an event leaves its delay in `lead`
// instead of what it would be under the acceleration at that very instant (leine2004).

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "friction_models/state_sizes.hpp"
#include "sim/engine/smooth_engine.hpp"
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

Eigen::Map<const Eigen::VectorXd> as_vector(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

void SmoothEngine::reset_sensitivity() {
  Eigen::Index n = 2;
  for (const friction::Memory& memory : memories_) n += static_cast<Eigen::Index>(memory.state.size());
  columns_ = Eigen::MatrixXd::Identity(n, n);
  // A mass that sticks stops again at once, over a distance of second order.
  if (direction_ == friction::Direction::none) columns_.row(1).setZero();
  lead_ = Eigen::RowVectorXd::Zero(n);
  mode_lead_ = {};
  course_.length = 0.0;
  changes_.clear();
}

Eigen::MatrixXd SmoothEngine::sensitivity() const {
  if (lead_.isZero(0.0)) return columns_;
  return columns_ + rates_now() * lead_;
}

/// Of the step taken last.
void SmoothEngine::note_course() {
  course_.rates.resize(end_.size());
  course_.length = stepper_->end_rates(course_.rates) ? taken_ : 0.0;
}

/// |df_k/dX_k| of each component at X [1/s].
std::vector<double> SmoothEngine::own_paces(const Flow& flow, std::span<const double> X, double t) {
  std::vector<double> jacobian(X.size() * X.size());
  flow.jacobian(X, t, jacobian);
  std::vector<double> paces(X.size());
  for (std::size_t k = 0; k < X.size(); ++k) paces[k] = std::abs(jacobian[k * X.size() + k]);
  return paces;
}

/// Of the motion at X. A mass that creeps under a steep dashpot has a speed that is known to the tolerance of its
/// steps, and the dashpot makes of its error an acceleration that decays at once: it is none of the motion, and a
/// lead of seconds would make a change of speed of it. A component that decays within the last step has its rate by
/// the polynomial of that step, where no event has intervened.
void SmoothEngine::rates_of_motion(const Flow& flow, std::span<const double> X, double t,
                                   std::vector<double>& rates) const {
  flow.evaluate(X, t, rates);
  if (course_.length == 0.0 || course_.rates.size() != X.size()) return;
  const std::vector<double> pace = own_paces(flow, X, t);
  for (std::size_t k = 0; k < X.size(); ++k)
    if (pace[k] * course_.length > 1.0) rates[k] = course_.rates[k];
}

/// Of the motion that begins now.
Eigen::VectorXd SmoothEngine::rates_now() const {
  Flow flow(model_, drive_, past_);
  flow.freeze(memories_, direction_, time() - local_time_);
  std::vector<double> X;
  flow.gather(x_, v_, memories_, X);
  std::vector<double> rates(X.size());
  rates_of_motion(flow, X, local_time_, rates);
  return as_vector(rates);
}

void SmoothEngine::jumped(std::size_t law, const friction::Memory& before, friction::Trigger trigger) {
  changes_.push_back({law, before, trigger, direction_});
}

/// Over the step taken last.
void SmoothEngine::track_step() {
  if (taken_ == 0.0) return;
  lead_near_stop();
  const auto size = static_cast<std::size_t>(columns_.rows());
  if (variation_size_ != size) variation_ = make_variation(size);
  variation_size_ = size;
  Eigen::VectorXd late(columns_.rows());
  const TakenStep step{*stepper_, local_time_, taken_, part_for_rate * shortest_period(), flow_.scales()};
  const auto work = [&] { return variation_->parts() + variation_->operations() / operations_in_unit; };
  const long before = work();
  if (!variation_->pass(flow_, step, {columns_.data(), static_cast<std::size_t>(columns_.size())},
                        {late.data(), size}))
    columns_.setConstant(std::numeric_limits<double>::quiet_NaN());
  variation_work_ += work() - before;
  columns_ -= late * lead_;
  note_course();
}

/// Whether the first step, or the one behind an event, leads away from the stop while a change of its speed dies
/// out. The acceleration at its begin is then not known: a lead would be a large number, and what is left of the
/// change a difference of two. Where the speed passes zero within the step the field is that of the other branch.
bool SmoothEngine::forgets_speed() const {
  constexpr int parts = 16;
  if (course_.length > 0.0 || !(own_paces(flow_, X_, local_time_)[1] * taken_ > 1.0)) return false;
  std::vector<double> state(X_.size());
  for (int i = 0; i <= parts; ++i) {
    stepper_->at(static_cast<double>(i) / parts, state);
    if (!(friction::sign(direction_) * state[1] > 0.0)) return false;
  }
  return true;
}

/// Near a stop, at the begin of a step: the perturbed motion is where the velocity is the same.
void SmoothEngine::lead_near_stop() {
  if (direction_ == friction::Direction::none) return;
  flow_.evaluate(X_, local_time_, rates_);
  if (!(std::abs(X_[1]) < near_stop * shortest_period() * std::abs(rates_[1])) || forgets_speed()) return;
  const Eigen::RowVectorXd ahead = columns_.row(1) / rates_[1];
  columns_ -= as_vector(rates_) * ahead;
  columns_.row(1).setZero();
  lead_ += ahead;
}

/// At a time that does not depend on the motion every perturbation is a change of the state.
void SmoothEngine::drop_lead() {
  rates_of_motion(flow_, end_, local_time_ + taken_, rates_);
  columns_ += as_vector(rates_) * lead_;
  lead_.setZero();
}

/// Of a guard at end_, by the state; `by_time`: by the time alone, which a guard has where it asks for the drive.
Eigen::RowVectorXd SmoothEngine::guard_gradient(std::size_t watch, double t, double& by_time) const {
  Eigen::RowVectorXd gradient(columns_.rows());
  std::vector<double> displaced = end_;
  const auto value = [&](double at) { return search_.guards().value(watch, displaced, at); };
  for (std::size_t k = 0; k < end_.size(); ++k) {
    const double step = displacement * std::max(flow_.scales()[k], least_size * std::abs(end_[k]));
    displaced[k] = end_[k] + step;
    const double above = value(t);
    displaced[k] = end_[k] - step;
    gradient[static_cast<Eigen::Index>(k)] = (above - value(t)) / (2.0 * step);
    displaced[k] = end_[k];
  }
  const double later = part_for_rate * shortest_period();
  by_time = (value(t + later) - value(t - later)) / (2.0 * later);
  return gradient;
}

/// To the crossing at end_, on the motion before it. A lead is one along the motion and not in time: it brings the
/// crossing no nearer as far as the guard changes with time alone.
void SmoothEngine::carry_to_event(std::size_t watch) {
  const double t = local_time_ + taken_;
  const double rate = search_.guards().rate(watch, end_, t, taken_ > 0.0 ? taken_ : longest_step());
  // A guard that only touches zero has no crossing to shift.
  if (rate == 0.0) return drop_lead();
  double by_time = 0.0;
  const Eigen::RowVectorXd gradient = guard_gradient(watch, t, by_time);
  const Eigen::RowVectorXd ahead = (by_time * lead_ - gradient * columns_) / rate;
  flow_.evaluate(end_, t, rates_);
  columns_ += as_vector(rates_) * ahead;
  lead_ -= ahead;
  if (is<LawGuard>(search_.guards().ending(watch))) mode_lead_ = {-ahead, as_vector(rates_)};
}

/// Sizes of a law's states, as `Flow` has them.
std::vector<double> SmoothEngine::sizes_of(std::size_t law, const friction::Memory& memory) const {
  std::vector<double> sizes(memory.state.size(), 0.0);
  model_.friction[law].scales(memory, sizes);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (sizes[k] == friction::size_of_velocity) sizes[k] = flow_.scales()[1];
    if (!(sizes[k] > 0.0)) sizes[k] = flow_.scales()[0];
    sizes[k] = std::max(sizes[k], least_size * std::abs(memory.state[k]));
  }
  return sizes;
}

/// A law's states after a mode change, of the perturbed motion `column`, from `states`, those before it. It is
/// displaced as a whole: at a crossing all its parts together leave the guard at zero, one of them alone does not.
/// What a law takes for rounding of its guard is so rounding here too. Empty: the law changes to other modes on the
/// two sides, so that there is no derivative.
Eigen::VectorXd SmoothEngine::through(const Change& change, Eigen::Index column,
                                      const Eigen::VectorXd& states) const {
  const friction::Law& law = model_.friction[change.law];
  const double dx = columns_(0, column);
  const double dv = columns_(1, column);
  double part = std::max(std::abs(dx) / flow_.scales()[0], std::abs(dv) / flow_.scales()[1]);
  const std::vector<double> sizes = sizes_of(change.law, change.before);
  for (std::size_t k = 0; k < sizes.size(); ++k)
    part = std::max(part, std::abs(states[static_cast<Eigen::Index>(k)]) / sizes[k]);
  // A column that has died out is a subnormal number, by which nothing can be divided.
  const double step = part >= std::numeric_limits<double>::min() ? displacement / part : 0.0;
  const auto after = [&](double by) {
    friction::Memory memory = change.before;
    for (std::size_t k = 0; k < memory.state.size(); ++k)
      memory.state[k] += by * states[static_cast<Eigen::Index>(k)];
    friction::Instant at = now();
    at.x += by * dx;
    at.v += by * dv;
    law.jump(memory, change.trigger, at, change.direction);
    return memory.state;
  };
  const std::vector<double> above = after(step);
  const std::vector<double> below = after(-step);
  if (step == 0.0) return Eigen::VectorXd::Zero(as_vector(above).size());
  if (above.size() != below.size()) return {};
  return (as_vector(above) - as_vector(below)) / (2.0 * step);
}

/// To the motion behind the event. The delay of a mode change is taken back where it leaves the rates as they are:
/// it may be long, and the variational equation would have to tell the perturbation as a small difference of the
/// delay and of what the columns make of it.
void SmoothEngine::carry_from_event() {
  carry_through_changes();
  const ModeLead added = std::exchange(mode_lead_, {});
  if (added.time.size() == 0) return;
  const Eigen::VectorXd rates = rates_now();
  if (rates.size() != added.rates_before.size()) return;
  const auto sizes = as_vector(flow_.scales()).array();
  const double change = ((rates - added.rates_before).array() / sizes).abs().maxCoeff();
  if (!(change < same_rates * (added.rates_before.array() / sizes).abs().maxCoeff())) return;
  columns_ += rates * added.time;
  lead_ -= added.time;
}

/// The motion after the mode changes begins with the same lead.
void SmoothEngine::carry_through_changes() {
  if (changes_.empty()) return;
  Eigen::Index rows = 2;
  for (const friction::Memory& memory : memories_) rows += static_cast<Eigen::Index>(memory.state.size());
  Eigen::MatrixXd result(rows, columns_.cols());
  result.topRows(2) = columns_.topRows(2);
  Eigen::Index row = 2;
  Eigen::Index row_before = 2;
  for (std::size_t i = 0; i < memories_.size(); ++i) {
    const auto of_law = [&](const Change& change) { return change.law == i; };
    const auto first = std::ranges::find_if(changes_, of_law);
    const friction::Memory& before = first == changes_.end() ? memories_[i] : first->before;
    const auto count_before = static_cast<Eigen::Index>(before.state.size());
    const auto count = static_cast<Eigen::Index>(memories_[i].state.size());
    for (Eigen::Index c = 0; c < columns_.cols(); ++c) {
      Eigen::VectorXd states = columns_.col(c).segment(row_before, count_before);
      for (const Change& change : changes_) {
        if (of_law(change) && as_vector(change.before.state).size() == states.size())
          states = through(change, c, states);
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
