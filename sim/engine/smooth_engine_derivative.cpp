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

#include "sim/engine/radau_collocation.hpp"
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

/// Operations of LU factors in a unit of work.
constexpr long operations_in_unit = 4000;

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

void SmoothEngine::reset_sensitivity() {
  Eigen::Index n = 2;
  for (const friction::Memory& memory : memories_) n += static_cast<Eigen::Index>(memory.state.size());
  columns_ = Eigen::MatrixXd::Identity(n, n);
  lead_ = Eigen::RowVectorXd::Zero(n);
  changes_.clear();
}

Eigen::MatrixXd SmoothEngine::sensitivity() const {
  if (lead_.isZero(0.0)) return columns_;
  return columns_ + rates_now() * lead_;
}

/// Of the motion that begins now.
Eigen::VectorXd SmoothEngine::rates_now() const {
  Flow flow(model_, drive_, past_);
  flow.freeze(memories_, direction_, time() - local_time_);
  std::vector<double> X;
  flow.gather(x_, v_, memories_, X);
  std::vector<double> rates(X.size());
  flow.evaluate(X, local_time_, rates);
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
  const long rows = RadauCollocation::stages * columns_.rows();
  variation_work_ += rows * rows * rows / operations_in_unit;
  Eigen::VectorXd late(columns_.rows());
  const TakenStep step{*stepper_, local_time_, taken_, part_for_rate * shortest_period()};
  if (!variation_->pass(flow_, step, {columns_.data(), static_cast<std::size_t>(columns_.size())},
                        {late.data(), size}))
    columns_.setConstant(std::numeric_limits<double>::quiet_NaN());
  columns_ -= late * lead_;
}

/// Near a stop, at the begin of a step: the perturbed motion is where the velocity is the same.
void SmoothEngine::lead_near_stop() {
  if (direction_ == friction::Direction::none) return;
  flow_.evaluate(X_, local_time_, rates_);
  if (!(std::abs(X_[1]) < near_stop * shortest_period() * std::abs(rates_[1]))) return;
  const Eigen::RowVectorXd ahead = columns_.row(1) / rates_[1];
  columns_ -= as_vector(rates_) * ahead;
  columns_.row(1).setZero();
  lead_ += ahead;
}

/// At a time that does not depend on the motion every perturbation is a change of the state.
void SmoothEngine::drop_lead() {
  flow_.evaluate(end_, local_time_ + taken_, rates_);
  columns_ += as_vector(rates_) * lead_;
  lead_.setZero();
}

/// Of a guard at end_, by the state; `by_time`: by the time alone, which a guard has where it asks for the drive.
Eigen::RowVectorXd SmoothEngine::guard_gradient(std::size_t watch, double t, double& by_time) const {
  Eigen::RowVectorXd gradient(columns_.rows());
  std::vector<double> displaced = end_;
  std::vector<double> values;
  const auto value = [&](double at) {
    evaluate_guards(displaced, at, values);
    return values[watch];
  };
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
  const double rate = guard_rate(watch, end_, t);
  // A guard that only touches zero has no crossing to shift.
  if (rate == 0.0) return drop_lead();
  double by_time = 0.0;
  const Eigen::RowVectorXd gradient = guard_gradient(watch, t, by_time);
  const Eigen::RowVectorXd ahead = (by_time * lead_ - gradient * columns_) / rate;
  flow_.evaluate(end_, t, rates_);
  columns_ += as_vector(rates_) * ahead;
  lead_ -= ahead;
}

/// Through the mode changes. The motion after them begins with the same lead.
void SmoothEngine::carry_from_event() { columns_ = jump_derivative() * columns_; }

/// The derivative of a law's states after a mode change, from `states`, that of those before it.
Eigen::MatrixXd SmoothEngine::through(const Change& change, const Eigen::MatrixXd& states) const {
  const friction::Law& law = model_.friction[change.law];
  const auto difference = [&](const auto& displaced, double step) {
    const auto after = [&](double shift) {
      friction::Memory memory = change.before;
      friction::Instant at = now();
      displaced(shift, memory, at);
      law.jump(memory, change.trigger, at, change.direction);
      return memory.state;
    };
    const std::vector<double> above = after(step);
    const std::vector<double> below = after(-step);
    return Eigen::VectorXd((as_vector(above) - as_vector(below)) / (2.0 * step));
  };
  const Eigen::VectorXd by_x =
      difference([](double shift, friction::Memory&, friction::Instant& at) { at.x += shift; },
                 displacement * flow_.scales()[0]);
  const Eigen::VectorXd by_v =
      difference([](double shift, friction::Memory&, friction::Instant& at) { at.v += shift; },
                 displacement * flow_.scales()[1]);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(by_x.size(), states.cols());
  for (std::size_t k = 0; k < change.before.state.size(); ++k) {
    const Eigen::VectorXd by_state =
        difference([k](double shift, friction::Memory& memory, friction::Instant&) { memory.state[k] += shift; },
                   displacement * std::max(std::abs(change.before.state[k]), flow_.scales()[0]));
    result += by_state * states.row(static_cast<Eigen::Index>(k));
  }
  result.col(0) += by_x;
  result.col(1) += by_v;
  return result;
}

/// Of the coordinates after the mode changes by those before.
Eigen::MatrixXd SmoothEngine::jump_derivative() const {
  Eigen::Index rows = 2;
  for (const friction::Memory& memory : memories_) rows += static_cast<Eigen::Index>(memory.state.size());
  const Eigen::Index columns = columns_.rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, columns);
  result.topLeftCorner(2, 2).setIdentity();
  Eigen::Index row = 2;
  Eigen::Index column = 2;
  for (std::size_t i = 0; i < memories_.size(); ++i) {
    const auto of_law = [&](const Change& change) { return change.law == i; };
    const auto first = std::ranges::find_if(changes_, of_law);
    const friction::Memory& before = first == changes_.end() ? memories_[i] : first->before;
    const auto n = static_cast<Eigen::Index>(before.state.size());
    Eigen::MatrixXd states = Eigen::MatrixXd::Zero(n, columns);
    states.middleCols(column, n).setIdentity();
    for (const Change& change : changes_) {
      if (of_law(change)) states = through(change, states);
    }
    result.middleRows(row, states.rows()) = states;
    row += states.rows();
    column += n;
  }
  return result;
}

}  // namespace dualdamp::sim
