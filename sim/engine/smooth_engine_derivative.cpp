// The derivative of a motion of the smooth engine by its start. Columns are perturbations of the start: d(x, v,
// states)(now). Over a step the derivative of the step as computed carries them on; at an event they come late or
// early by `delay_of_event_`, and are carried to the crossing with the motion before it, through the mode changes,
// and back with the motion after it (leine2004).

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/engine/smooth_engine.hpp"

namespace dualdamp::sim {

namespace {

/// Relative displacement of states and guards in central differences.
constexpr double displacement = 1e-5;

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

void SmoothEngine::reset_sensitivity() {
  Eigen::Index n = 2;
  for (const friction::Memory& memory : memories_) n += static_cast<Eigen::Index>(memory.state.size());
  columns_ = Eigen::MatrixXd::Identity(n, n);
  delay_of_event_ = Eigen::RowVectorXd::Zero(n);
  changes_.clear();
}

void SmoothEngine::jumped(std::size_t law, const friction::Memory& before, friction::Trigger trigger) {
  changes_.push_back({law, before, trigger, direction_});
}

/// Over the step taken last.
void SmoothEngine::track_step() {
  if (taken_ == 0.0) return;
  if (stepper_->carry(flow_, flow_.scales(), {columns_.data(), static_cast<std::size_t>(columns_.size())})) return;
  columns_.setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// How late each perturbation comes to the crossing at end_.
void SmoothEngine::carry_to_event(std::size_t watch) {
  const double t = local_time_ + taken_;
  const double rate = guard_rate(watch, end_, t);
  Eigen::RowVectorXd gradient(columns_.rows());
  std::vector<double> displaced = end_;
  std::vector<double> values;
  for (std::size_t k = 0; k < end_.size(); ++k) {
    const double step = displacement * flow_.scales()[k];
    displaced[k] = end_[k] + step;
    evaluate_guards(displaced, t, values);
    const double above = values[watch];
    displaced[k] = end_[k] - step;
    evaluate_guards(displaced, t, values);
    gradient[static_cast<Eigen::Index>(k)] = (above - values[watch]) / (2.0 * step);
    displaced[k] = end_[k];
  }
  delay_of_event_ = -(gradient * columns_) / rate;
}

/// Through the mode changes and back to the common time. An event that follows another at once came as late as
/// that one.
void SmoothEngine::carry_from_event() {
  flow_.evaluate(end_, local_time_, rates_);
  const Eigen::MatrixXd at_crossing = columns_ + as_vector(rates_) * delay_of_event_;
  judge_.freeze(memories_, direction_, time() - local_time_);
  std::vector<double> X;
  judge_.gather(x_, v_, memories_, X);
  std::vector<double> rates(X.size());
  judge_.evaluate(X, local_time_, rates);
  columns_ = jump_derivative() * at_crossing - as_vector(rates) * delay_of_event_;
}

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
