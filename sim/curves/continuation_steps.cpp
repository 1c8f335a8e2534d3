#include "sim/curves/continuation_steps.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "friction_models/state_sizes.hpp"
#include "sim/curves/state_reach.hpp"
#include "sim/engine/drive.hpp"

namespace dualdamp::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int max_corrections = 12;
/// Periods of transient by which a predicted state may enter the mode of its orbit.
constexpr int settling_periods = 4;
/// Closure at which rounding leaves too little of an orbit.
constexpr double lost_in_rounding = 1e-7;
/// Amplification of a period from which on the derivative by the parameter is taken along the branch.
constexpr double far_apart = 10.0;

/// Derivative of (end - begin) by the coordinates and the parameter. A slider that never slips keeps its position.
MatrixXd closing(const ForcingPeriod& period, const VectorXd& by_parameter) {
  const Index n = period.monodromy.cols();
  MatrixXd system(n, n + 1);
  system.leftCols(n) = period.monodromy - MatrixXd::Identity(n, n);
  system.col(n) = by_parameter;
  for (Index row = 2; row < n; ++row) {
    if (period.holds(row)) system(row, row) = 1.0;
  }
  return system;
}

/// The parts of a tangent that all modes share: along x, v and the parameter.
Eigen::Vector3d common_part(const VectorXd& tangent) {
  return {tangent[0], tangent[1], tangent[tangent.size() - 1]};
}

/// Rounding of the forces, as a closure. It matters where the motion is small beside the one that the forces would
/// cause without friction.
double rounding_of_forces(const Model& model, const ForcingPeriod& period) {
  constexpr double roundings = 8.0;
  const double size = std::max(period.size, std::abs(period.begin.v) / model.excitation.frequency);
  return roundings * std::numeric_limits<double>::epsilon() * driven_displacement(model) / size;
}

/// How far an orbit is from its mirror image, in parts of its size.
double asymmetry(const ForcingPeriod& period) { return std::abs(period.peak + period.trough) / period.size; }

/// Whether a step leads from an asymmetric orbit to one that is its own mirror image and does not attract. Branches
/// of both meet there; the asymmetric one goes on to the mirror images of its orbits. One that attracts is where a
/// sweep goes on.
bool leaves_for_symmetry(const ForcingPeriod& from, const ForcingPeriod& to) {
  constexpr double none = 1e-7;
  constexpr double clear = 1e-3;
  return asymmetry(from) > clear && asymmetry(to) < none && to.radius() > 1.0;
}

/// Whether the branch may fold between two orbits: there a real Floquet multiplier passes 1, or touches it, or an
/// asymmetric orbit meets its mirror image.
bool may_fold_between(const ForcingPeriod& a, const ForcingPeriod& b) {
  constexpr double close = 0.2;
  const auto is_close = [](const std::complex<double>& value) { return std::abs(value - 1.0) < close; };
  const auto beyond = [](const std::complex<double>& value) { return value.imag() == 0.0 && value.real() > 1.0; };
  const std::vector<std::complex<double>> before = a.multipliers();
  const std::vector<std::complex<double>> after = b.multipliers();
  constexpr double rounding = 1e-9;
  const auto side = [](const ForcingPeriod& period) {
    const double middle = period.peak + period.trough;
    return std::abs(middle) > rounding * period.size ? middle : 0.0;
  };
  if (side(a) * side(b) < 0.0) return true;
  const auto passed = std::ranges::count_if(before, beyond) - std::ranges::count_if(after, beyond);
  return passed % 2 != 0 || std::ranges::any_of(before, is_close) || std::ranges::any_of(after, is_close);
}

}  // namespace

double driven_displacement(const Model& model) { return driven_displacement(model.oscillator, model.excitation); }

/// No orbit, slope, step or place is finer than the error of the engine allows.
void Continuation::limit_by_accuracy(double accuracy) {
  closure_ = closure_within(options_.tolerance, accuracy);
  if (accuracy == 0.0) closure_.rounding = closure_.tolerance;
  constexpr double coarsest = 1e-5;
  const double error = std::min(accuracy, coarsest);
  nudge_ = std::max(nudge_, std::sqrt(error));
  options_.smallest_step = std::max(options_.smallest_step, 10.0 * error);
  options_.location = std::max(options_.location, 10.0 * error);
}

/// Whether the node is an orbit; `before`: the closure before the last correction. Where corrections no longer
/// help, rounding is enough.
bool Continuation::closes(const Node& node, double before) {
  const Model model = at(node.parameter);
  const double closure = node.period.closure(model.excitation.frequency);
  if (closure <= closure_.tolerance) return true;
  // The period map also amplifies the rounding of its start.
  const double least = std::min(closure_.rounding * std::max(1.0, amplification(node)), lost_in_rounding);
  const double rounding = std::max(least, rounding_of_forces(model, node.period));
  nearest_ = std::min(nearest_, closure / rounding);
  return closure > 0.5 * before && closure <= std::max(closure_.rounding, std::min(rounding, lost_in_rounding));
}

/// The largest factor by which a period stretches a perturbation of its start, in scaled coordinates.
double Continuation::amplification(const Node& node) const {
  const Index n = node.period.monodromy.cols();
  const MatrixXd& matrix = node.period.monodromy;
  if (n == 0 || matrix.rows() != n || !matrix.allFinite()) return 1.0;
  const VectorXd size = scale(node).head(n);
  return (size.cwiseInverse().asDiagonal() * matrix * size.asDiagonal()).norm();
}

Model Continuation::at(double parameter) const {
  Model model = model_;
  model.excitation.*quantity_ = parameter;
  return model;
}

double Continuation::omega(double parameter) const {
  return quantity_ == &Excitation::frequency ? parameter : model_.excitation.frequency;
}

/// The period from `start`; none if the motion was not followed over the whole of it.
std::optional<Node> Continuation::node_at(double parameter, const State& start) {
  CountedMap map(at(parameter), ratio_, effort_);
  StateReach reach(model_, map.engine());
  Node node{parameter, map.from(start, Monodromy::with, &reach), {}, {}, {}};
  if (!map.outcome().ok()) return std::nullopt;
  node.reach = reach.values();
  return node;
}

/// Scale of the parameter. The range may span decades, so at its lower end the scale is the parameter itself.
double Continuation::parameter_scale(double parameter) const { return std::min(range_, std::abs(parameter)); }

/// Scales of the coordinates and of the parameter. A motion that dies at its break-away has a size of zero there:
/// steps in proportion to it would never arrive.
VectorXd Continuation::scale(const Node& node) const {
  constexpr double least = 1e-2;  // of the displacement by the drive
  const VectorXd z = coordinates(node.period.begin);
  const double size = std::max(
      {node.period.size, std::abs(z[1]) / omega(node.parameter), least * driven_displacement(at(node.parameter))});
  VectorXd result = VectorXd::Constant(z.size() + 1, size);
  const double speed = size * omega(node.parameter);
  result[1] = speed;
  Index next = 2;
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    const friction::Memory& memory = node.period.begin.memories[i];
    std::vector<double> sizes(memory.state.size());
    model_.friction[i].scales(memory, sizes);
    for (const double own : sizes) {
      const double least_size = own == friction::size_of_velocity ? speed : own > 0.0 ? own : size;
      const auto state = static_cast<std::size_t>(next - 2);
      result[next++] = std::max(least_size, state < node.reach.size() ? node.reach[state] : 0.0);
    }
  }
  result[z.size()] = parameter_scale(node.parameter);
  return result;
}

/// d(end)/d(parameter), by a difference; none if the changed parameter leads to another mode. Where neighbouring
/// motions part fast, the start moves on along the branch, too: orbits near each other stay near each other, so the
/// difference has no large terms of second order. The monodromy matrix then takes the motion of the start out
/// again.
std::optional<VectorXd> Continuation::by_parameter(const Node& node, const VectorXd& along) {
  const Index n = node.period.monodromy.cols();
  VectorXd moved_start = VectorXd::Zero(n);
  double length = nudge_ * node.parameter;
  constexpr double flattest = 1e-3;  // part of the tangent along the parameter; less: at a fold
  if (along.size() == n + 1 && std::abs(along[n]) > flattest && amplification(node) > far_apart) {
    const VectorXd step = nudge_ * along.cwiseProduct(scale(node));
    moved_start = step.head(n);
    length = step[n];
  }
  for (const double sense : {1.0, -1.0}) {
    CountedMap map(at(node.parameter + sense * length), ratio_, effort_);
    const ForcingPeriod moved = map.from(displaced(node.period.begin, sense * moved_start), Monodromy::without);
    if (!map.outcome().ok() || !same_mode(moved.end, node.period.end)) continue;
    const VectorXd start = coordinates(moved.begin) - coordinates(node.period.begin);
    return (coordinates(moved.end) - coordinates(node.period.end) - node.period.monodromy * start) /
           (sense * length);
  }
  return std::nullopt;
}

/// Unit tangent in scaled coordinates, in the direction of `along`.
std::optional<VectorXd> Continuation::tangent(const Node& node, const VectorXd& along) {
  std::optional<VectorXd> direction = tangent_near(node, along, along);
  if (direction && amplification(node) > far_apart) direction = tangent_near(node, along, *direction);
  return direction;
}

/// Unit tangent in scaled coordinates, in the direction of `along`; `guess`: a direction near the tangent.
std::optional<VectorXd> Continuation::tangent_near(const Node& node, const VectorXd& along, const VectorXd& guess) {
  const std::optional<VectorXd> slope = by_parameter(node, guess);
  const Index n = node.period.monodromy.cols();
  if (!slope || along.size() != n + 1) return std::nullopt;
  const VectorXd size = scale(node);
  const Solution direction = along_branch(node, *slope, along.cwiseQuotient(size), VectorXd::Unit(n + 1, n));
  if (!direction.is_unique) return std::nullopt;
  return VectorXd(direction.value.cwiseQuotient(size).normalized());
}

/// Solves for a change of the coordinates and the parameter: the change of (end - begin) and the product with
/// `across`.
Solution Continuation::along_branch(const Node& node, const VectorXd& slope, const VectorXd& across,
                                    const VectorXd& right) const {
  const Index n = node.period.monodromy.cols();
  MatrixXd system(n + 1, n + 1);
  system.topRows(n) = closing(node.period, slope);
  system.row(n) = across.transpose();
  VectorXd rows(n + 1);
  rows << sizes_of_coordinates(node.period, omega(node.parameter)), 1.0;
  VectorXd unknowns = rows;
  unknowns[n] = std::ldexp(1.0, std::ilogb(parameter_scale(node.parameter)));
  return solve_in_sizes(system, right, rows, unknowns);
}

/// The orbit at a fixed parameter nearest to `guess`.
std::optional<Node> Continuation::orbit(double parameter, const State& guess) {
  CountedMap map(at(parameter), ratio_, effort_);
  StateReach reach(model_, map.engine());
  Node node{parameter, map.from(guess, Monodromy::with, &reach), {}, {}, {}};
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < max_corrections && map.outcome().ok(); ++i) {
    node.reach = reach.values();
    if (closes(node, before)) return node;
    before = node.period.closure(omega(parameter));
    const VectorXd step = newton_step(node.period, omega(parameter));
    node.period =
        map.from(step.size() > 0 ? displaced(node.period.begin, step) : node.period.end, Monodromy::with, &reach);
  }
  return std::nullopt;
}

/// The change of the coordinates and of the parameter over a step. Near orbits whose neighbours part fast, Newton's
/// method needs a good start: the bend of the branch allows far longer steps there.
VectorXd Continuation::predicted(const Node& from, double step) const {
  constexpr double most = 0.5;
  VectorXd direction = from.tangent;
  if (from.bend.size() == direction.size() && step * from.bend.norm() < most) direction += 0.5 * step * from.bend;
  return step * direction.cwiseProduct(scale(from));
}

/// Predictor and corrector: the orbit closes, and the step along the tangent has the length `step`.
std::optional<Node> Continuation::correct(const Node& from, double step) {
  const VectorXd size = scale(from);
  const Index n = size.size() - 1;
  const VectorXd change_there = predicted(from, step);
  double parameter = from.parameter + change_there[n];
  State start = displaced(from.period.begin, change_there.head(n));
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < max_corrections; ++i) {
    if (!(parameter > 0.0)) return std::nullopt;
    std::optional<Node> trial = node_at(parameter, start);
    if (!trial || !trial->period.ends_in_its_mode()) return std::nullopt;
    Node& node = *trial;
    const VectorXd gap = coordinates(node.period.end) - coordinates(node.period.begin);
    const bool is_near = way(from, node).norm() <= farthest(step) * step;
    if (closes(node, before)) {
      if (is_near) return trial;
      nearest_ = std::numeric_limits<double>::infinity();  // an orbit, but not the one that continues the branch
      return std::nullopt;
    }
    before = node.period.closure(omega(node.parameter));
    const std::optional<VectorXd> slope = by_parameter(node, from.tangent);
    if (!slope) return std::nullopt;
    VectorXd distance(n + 1);
    distance.head(n) = coordinates(start) - coordinates(from.period.begin);
    distance[n] = node.parameter - from.parameter;
    VectorXd right(n + 1);
    right.head(n) = -gap;
    right[n] = step - from.tangent.dot(distance.cwiseQuotient(size));
    const VectorXd change = along_branch(node, *slope, from.tangent.cwiseQuotient(size), right).value;
    if (!change.allFinite()) return std::nullopt;
    start = displaced(start, change.head(n));
    parameter += change[n];
  }
  return std::nullopt;
}

/// The next orbit if the predicted state is in another mode than that orbit: a few periods of the motion find the
/// mode. They must be few, because the motion leaves an orbit that does not attract.
std::optional<Node> Continuation::cross_modes(const Node& from, double step) {
  const VectorXd change = predicted(from, step);
  const Index n = change.size() - 1;
  const double parameter = from.parameter + change[n];
  if (!(parameter > 0.0)) return std::nullopt;
  CountedMap map(at(parameter), ratio_, effort_);
  ForcingPeriod trial = map.from(displaced(from.period.begin, change.head(n)), Monodromy::without);
  for (int i = 1; i <= settling_periods && map.outcome().ok(); ++i) {
    std::optional<Node> node = orbit(parameter, trial.end);
    if (node && is_ahead(from, *node, step)) return node;
    trial = map.next(Monodromy::without);
  }
  return std::nullopt;
}

/// The way from one node to another along x, v and the parameter, which all modes share; scaled.
Eigen::Vector3d Continuation::way(const Node& from, const Node& node) const {
  const VectorXd size = scale(from);
  const State& before = from.period.begin;
  const State& after = node.period.begin;
  return {(after.x - before.x) / size[0], (after.v - before.v) / size[1],
          (node.parameter - from.parameter) / parameter_scale(from.parameter)};
}

/// Most steps' lengths that one step may take the state along. At a corner of the branch (a release passes t = 0)
/// the state changes by many small steps.
double Continuation::farthest(double step) const { return step > 16.0 * options_.smallest_step ? 4.0 : 100.0; }

/// Whether `node` continues the branch: x, v and the parameter go on by about a step. Another branch, or a part of
/// this one that lies behind, does not.
bool Continuation::is_ahead(const Node& from, const Node& node, double step) const {
  constexpr double least = 0.1;
  const Eigen::Vector3d change = way(from, node);
  const Eigen::Vector3d along = common_part(from.tangent);
  return change.norm() <= farthest(step) * step && change.dot(along) >= least * step * along.norm();
}

/// Whether an orbit lies on the piece of the branch between two others: from either at most `farthest` times as far
/// away as they are from each other.
bool Continuation::lies_between(const State& low, const Node& node, const State& high, double farthest) const {
  constexpr double rounding = 1e-9;
  const VectorXd size = scale(node);
  const auto distance = [&](const State& a, const State& b) {
    return std::hypot((a.x - b.x) / size[0], (a.v - b.v) / size[1]);
  };
  const double most = farthest * distance(low, high) + rounding;
  return distance(low, node.period.begin) <= most && distance(node.period.begin, high) <= most;
}

/// From one node to the next one, scaled.
VectorXd Continuation::arc(const Node& from, const Node& node) const {
  const VectorXd size = scale(from);
  const Index n = size.size() - 1;
  VectorXd result(n + 1);
  result.head(n) = coordinates(node.period.begin) - coordinates(from.period.begin);
  result[n] = node.parameter - from.parameter;
  return result.cwiseQuotient(size);
}

/// Whether the branch turns so far between both points that the direction of the tangent is uncertain: a step over
/// a bend could reverse it. The states of laws do not count: where a slider slips for the first time, its own
/// coordinate turns the tangent by any angle, at one place.
bool Continuation::turns_too_far(const Node& from, const Node& node, const VectorXd& tangent) const {
  constexpr double least = 0.5;  // cosine of the angle
  const Eigen::Vector3d along = way(from, node).normalized();
  const Eigen::Vector3d before = common_part(from.tangent).normalized();
  const Eigen::Vector3d after = common_part(tangent).normalized();
  // A piece along which the parameter goes against both tangents has two folds, or leads to another branch.
  if (along[2] * after[2] < 0.0 && along[2] * before[2] < 0.0) return true;
  return after.dot(before) < least || after.dot(along) < least || before.dot(along) < least;
}

/// Derivative of the tangent from the last node to this one, in the sizes of this one.
VectorXd Continuation::bend_at(const Node& node, const Node& from) const {
  const VectorXd before = from.tangent.cwiseProduct(scale(from)).cwiseQuotient(scale(node)).normalized();
  return (node.tangent - before) / arc(from, node).norm();
}

/// The next point with its tangent; halves `step` as often as needed. None: the branch ends, or no step converged
/// although `nearest_` is small.
std::optional<Node> Continuation::advance(const Node& from, double& step) {
  for (; step >= options_.smallest_step && !is_exhausted(); step *= 0.5) {
    nearest_ = std::numeric_limits<double>::infinity();
    std::optional<Node> node = correct(from, step);
    const double nearest = nearest_;
    if (!node) node = cross_modes(from, step);
    nearest_ = nearest;
    if (!node) continue;
    const Index n = node->period.monodromy.cols();
    // Between modes with different states the old tangent only gives the direction of the parameter.
    const double sense = from.tangent[from.tangent.size() - 1] < 0.0 ? -1.0 : 1.0;
    const bool alike = same_mode(from.period.begin, node->period.begin);
    if (!alike && (node->parameter - from.parameter) * sense < 0.0) continue;  // that is another branch
    const VectorXd along = alike ? from.tangent : VectorXd(sense * VectorXd::Unit(n + 1, n));
    std::optional<VectorXd> next = tangent(*node, along);
    if (!next) {
      nearest_ = 0.0;
      continue;
    }
    if (leaves_for_symmetry(from.period, node->period)) {
      nearest_ = 0.0;  // an orbit, but of another branch
      continue;
    }
    // A tangent that turns the parameter back where the branch cannot fold has the wrong sense.
    const bool turns = alike && (*next)[n] * from.tangent[n] < 0.0;
    if (turns && !may_fold_between(from.period, node->period)) next = -*next;
    if (alike && step > 16.0 * options_.smallest_step && turns_too_far(from, *node, *next)) continue;
    node->tangent = *next;
    if (alike) node->bend = bend_at(*node, from);
    return node;
  }
  return std::nullopt;
}

}  // namespace dualdamp::sim
