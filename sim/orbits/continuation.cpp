#include "sim/orbits/continuation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sim/orbits/orbit_account.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int max_corrections = 12;
/// Periods integrated to enter the mode that a predicted state belongs to.
constexpr int settling_periods = 4;
/// Of the parameter, for the difference that stands for the derivative by it.
constexpr double nudge = 1e-7;

/// b is a, perhaps begun elsewhere in the forcing period.
bool same_sequence(const std::vector<EventKind>& a, const std::vector<EventKind>& b) {
  if (a.size() != b.size()) return false;
  std::vector<EventKind> twice = a;
  twice.insert(twice.end(), a.begin(), a.end());
  return std::search(twice.begin(), twice.end(), b.begin(), b.end()) != twice.end();
}

/// Derivative of (end - begin) by the coordinates and the parameter. A slider that never slips stays where it is.
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

/// A point with what the next step needs.
struct Node {
  double parameter = 0.0;
  ForcingPeriod period;
  VectorXd tangent;  ///< scaled: coordinates, then the parameter; empty before the first step
};

/// A period map whose searches count for a branch.
class CountedMap : public PeriodMap {
 public:
  CountedMap(const Model& model, core::SearchCount& total) : PeriodMap(model), total_(total) {}
  ~CountedMap() { total_ += engine().count(); }
  CountedMap(const CountedMap&) = delete;
  CountedMap& operator=(const CountedMap&) = delete;

 private:
  core::SearchCount& total_;
};

class Continuation {
 public:
  Continuation(const Model& model, BranchParameter parameter, double from, double to, const BranchOptions& options)
      : model_(model),
        quantity_(parameter == BranchParameter::amplitude ? &Excitation::amplitude : &Excitation::frequency),
        options_(options),
        from_(from),
        to_(to),
        range_(std::max(std::abs(to - from), 1e-12 * std::abs(from))) {}

  Branch run();
  [[nodiscard]] const core::SearchCount& count() const { return count_; }

 private:
  [[nodiscard]] Model at(double parameter) const;
  [[nodiscard]] ForcingPeriod period(double parameter, const State& start) const;
  [[nodiscard]] double omega(double parameter) const;
  [[nodiscard]] VectorXd scale(const Node& node) const;
  [[nodiscard]] std::optional<VectorXd> by_parameter(const Node& node) const;
  [[nodiscard]] std::optional<VectorXd> tangent(const Node& node, const VectorXd& along) const;
  [[nodiscard]] std::optional<Node> orbit(double parameter, const State& guess) const;
  [[nodiscard]] std::optional<Node> correct(const Node& from, double step) const;
  [[nodiscard]] std::optional<Node> cross_modes(const Node& from, double step) const;
  [[nodiscard]] std::optional<Node> advance(const Node& from, double& step) const;
  [[nodiscard]] BranchPoint describe(const Node& node) const;
  [[nodiscard]] bool inside(double parameter) const;
  void record(const Node& before, const Node& after);
  void locate_sequences(const Node& before, const BranchPoint& last);
  void locate_fold(const Node& before, const Node& after);
  void add_change(ChangeKind kind, const BranchPoint& before, const BranchPoint& after);

  Model model_;
  double Excitation::* quantity_;
  BranchOptions options_;
  double from_;
  double to_;
  double range_;
  Branch branch_;
  mutable core::SearchCount count_;  ///< of all maps, those of attempts included
};

Model Continuation::at(double parameter) const {
  Model model = model_;
  model.excitation.*quantity_ = parameter;
  return model;
}

double Continuation::omega(double parameter) const { return at(parameter).excitation.frequency; }

ForcingPeriod Continuation::period(double parameter, const State& start) const {
  CountedMap map(at(parameter), count_);
  return map.from(start, Monodromy::with);
}

/// Sizes of the coordinates and of the parameter.
VectorXd Continuation::scale(const Node& node) const {
  const VectorXd z = coordinates(node.period.begin);
  const double size = std::max(node.period.size, std::abs(z[1]) / omega(node.parameter));
  VectorXd result = VectorXd::Constant(z.size() + 1, size);
  result[1] = size * omega(node.parameter);
  result[z.size()] = range_;
  return result;
}

/// d(end)/d(parameter), by a difference; none where the nudge meets another mode.
std::optional<VectorXd> Continuation::by_parameter(const Node& node) const {
  for (const double step : {nudge * node.parameter, -nudge * node.parameter}) {
    CountedMap map(at(node.parameter + step), count_);
    const ForcingPeriod moved = map.from(node.period.begin, Monodromy::without);
    if (map.outcome().ok() && same_mode(moved.end, node.period.end))
      return (coordinates(moved.end) - coordinates(node.period.end)) / step;
  }
  return std::nullopt;
}

/// Unit tangent, scaled, on the side of `along`.
std::optional<VectorXd> Continuation::tangent(const Node& node, const VectorXd& along) const {
  const std::optional<VectorXd> slope = by_parameter(node);
  const Index n = node.period.monodromy.cols();
  if (!slope || along.size() != n + 1) return std::nullopt;
  const VectorXd size = scale(node);
  MatrixXd system(n + 1, n + 1);
  system.topRows(n) = closing(node.period, *slope) * size.asDiagonal();
  system.row(n) = along.transpose();
  const Eigen::FullPivLU<MatrixXd> lu(system);
  if (!lu.isInvertible()) return std::nullopt;
  const VectorXd direction = lu.solve(VectorXd::Unit(n + 1, n));
  return VectorXd(direction.normalized());
}

/// The orbit at a fixed parameter nearest to `guess`.
std::optional<Node> Continuation::orbit(double parameter, const State& guess) const {
  CountedMap map(at(parameter), count_);
  ForcingPeriod trial = map.from(guess, Monodromy::with);
  for (int i = 0; i < max_corrections && map.outcome().ok(); ++i) {
    if (trial.closure(omega(parameter)) <= options_.tolerance) return Node{parameter, std::move(trial), {}};
    const VectorXd step = newton_step(trial);
    trial = map.from(step.size() > 0 ? displaced(trial.begin, step) : trial.end, Monodromy::with);
  }
  return std::nullopt;
}

/// Predictor and corrector: (orbit closes, step along the tangent is `step`).
std::optional<Node> Continuation::correct(const Node& from, double step) const {
  const VectorXd size = scale(from);
  const Index n = size.size() - 1;
  const VectorXd predicted = step * from.tangent.cwiseProduct(size);
  Node node{from.parameter + predicted[n], {}, {}};
  State start = displaced(from.period.begin, predicted.head(n));
  for (int i = 0; i < max_corrections; ++i) {
    if (!(node.parameter > 0.0)) return std::nullopt;
    node.period = period(node.parameter, start);
    if (!same_mode(node.period.begin, node.period.end)) return std::nullopt;
    const VectorXd gap = coordinates(node.period.end) - coordinates(node.period.begin);
    if (node.period.closure(omega(node.parameter)) <= options_.tolerance) return node;
    const std::optional<VectorXd> slope = by_parameter(node);
    if (!slope) return std::nullopt;
    VectorXd distance(n + 1);
    distance.head(n) = coordinates(start) - coordinates(from.period.begin);
    distance[n] = node.parameter - from.parameter;
    MatrixXd system(n + 1, n + 1);
    system.topRows(n) = closing(node.period, *slope);
    system.row(n) = from.tangent.cwiseQuotient(size).transpose();
    VectorXd right(n + 1);
    right.head(n) = -gap;
    right[n] = step - from.tangent.dot(distance.cwiseQuotient(size));
    const VectorXd change = Eigen::FullPivLU<MatrixXd>(system).solve(right);
    if (!change.allFinite()) return std::nullopt;
    start = displaced(start, change.head(n));
    node.parameter += change[n];
  }
  return std::nullopt;
}

/// The same where the predicted state lies in another mode than the orbit: the motion itself finds the mode.
std::optional<Node> Continuation::cross_modes(const Node& from, double step) const {
  const VectorXd size = scale(from);
  const Index n = size.size() - 1;
  const VectorXd predicted = step * from.tangent.cwiseProduct(size);
  const double parameter = from.parameter + predicted[n];
  if (!(parameter > 0.0)) return std::nullopt;
  CountedMap map(at(parameter), count_);
  ForcingPeriod trial = map.from(displaced(from.period.begin, predicted.head(n)), Monodromy::without);
  for (int i = 1; i < settling_periods && map.outcome().ok(); ++i) trial = map.next(Monodromy::without);
  std::optional<Node> node = map.outcome().ok() ? orbit(parameter, trial.end) : std::nullopt;
  // Another branch is not a continuation of this one.
  if (node && std::abs(node->period.size - from.period.size) > 10.0 * step * from.period.size) return std::nullopt;
  return node;
}

/// The next point, with its tangent; shortens `step` as needed. None: the branch ends.
std::optional<Node> Continuation::advance(const Node& from, double& step) const {
  for (; step >= options_.smallest_step; step *= 0.5) {
    std::optional<Node> node = correct(from, step);
    if (!node) node = cross_modes(from, step);
    if (!node) continue;
    const Index n = node->period.monodromy.cols();
    // Across modes of different size the old tangent says only which way the parameter went.
    const double sense = from.tangent[from.tangent.size() - 1] < 0.0 ? -1.0 : 1.0;
    const bool alike = same_mode(from.period.begin, node->period.begin);
    const VectorXd along = alike ? from.tangent : VectorXd(sense * VectorXd::Unit(n + 1, n));
    const std::optional<VectorXd> next = tangent(*node, along);
    if (!next) continue;
    if (alike && next->dot(from.tangent) < 0.5 && step > 16.0 * options_.smallest_step) continue;
    node->tangent = *next;
    return node;
  }
  return std::nullopt;
}

BranchPoint Continuation::describe(const Node& node) const {
  BranchPoint point{node.parameter, {}};
  const Model model = at(node.parameter);
  CountedMap map(model, count_);
  point.state.period = 2.0 * std::numbers::pi / model.excitation.frequency;
  point.state.start = node.period.begin;
  point.state.multipliers = node.period.multipliers();
  account_for_orbit(model, map, false, point.state);
  return point;
}

bool Continuation::inside(double parameter) const {
  return parameter >= std::min(from_, to_) && parameter <= std::max(from_, to_);
}

void Continuation::add_change(ChangeKind kind, const BranchPoint& before, const BranchPoint& after) {
  const double near = 4.0 * options_.location * std::max(std::abs(from_), std::abs(to_));
  const bool one = !branch_.changes.empty() && kind != ChangeKind::end && branch_.changes.back().kind == kind &&
                   std::abs(branch_.changes.back().parameter - after.parameter) <= near;
  if (one) {  // two steps of one change, both halves of the forcing period
    branch_.changes.back().stops_after = after.state.stops_per_cycle;
    return;
  }
  branch_.changes.push_back({kind, 0.5 * (before.parameter + after.parameter), after.state.amplitude,
                             before.state.stops_per_cycle, after.state.stops_per_cycle});
}

ChangeKind kind_of(const SteadyState& before, const SteadyState& after) {
  if (before.sticks.empty() != after.sticks.empty()) return ChangeKind::sticking;
  return before.stops_per_cycle != after.stops_per_cycle ? ChangeKind::stops : ChangeKind::sequence;
}

/// Every place between a point and the newest one where the sequence changes, by bisection in the parameter.
void Continuation::locate_sequences(const Node& before, const BranchPoint& last) {
  BranchPoint low = branch_.points.back();
  for (int changes = 0; changes < 64 && !same_sequence(low.state.sequence, last.state.sequence); ++changes) {
    BranchPoint high = last;
    const double scale = std::max(std::abs(from_), std::abs(to_));
    while (std::abs(high.parameter - low.parameter) > options_.location * scale) {
      const double middle = 0.5 * (low.parameter + high.parameter);
      std::optional<Node> node = orbit(middle, low.state.start);
      if (!node) node = orbit(middle, before.period.begin);
      if (!node) break;
      BranchPoint point = describe(*node);
      (same_sequence(point.state.sequence, low.state.sequence) ? low : high) = std::move(point);
    }
    add_change(kind_of(low.state, high.state), low, high);
    low = high;
  }
}

/// The tangent has no part along the parameter at a fold: bisection along the branch.
void Continuation::locate_fold(const Node& before, const Node& after) {
  Node low = before;
  Node high = after;
  double step = (coordinates(after.period.begin) - coordinates(before.period.begin)).norm() > 0.0
                    ? options_.largest_step
                    : options_.smallest_step;
  for (int i = 0; i < 60 && std::abs(high.parameter - low.parameter) > options_.location * range_; ++i) {
    step *= 0.5;
    double shorter = step;
    const std::optional<Node> node = advance(low, shorter);
    if (!node) break;
    const bool turned = node->tangent.tail<1>()[0] * low.tangent.tail<1>()[0] < 0.0;
    (turned ? high : low) = *node;
  }
  add_change(ChangeKind::fold, describe(low), describe(high));
}

/// Adds the point `after` and all that changed on the way to it.
void Continuation::record(const Node& before, const Node& after) {
  BranchPoint point = describe(after);
  const BranchPoint& last = branch_.points.back();
  const bool turned = same_mode(before.period.begin, after.period.begin) &&
                      before.tangent.tail<1>()[0] * after.tangent.tail<1>()[0] < 0.0;
  if (turned) locate_fold(before, after);
  if (!turned) locate_sequences(before, point);
  if (last.state.stable() != point.state.stable()) add_change(ChangeKind::stability, last, point);
  branch_.points.push_back(std::move(point));
}

Branch Continuation::run() {
  const Model first = at(from_);
  const SteadyState start = steady_state(first, {.tolerance = options_.tolerance, .full_account = false});
  branch_.outcome = start.outcome;
  count_ += start.certificate;
  if (!start.outcome.ok()) return std::move(branch_);
  Node node{from_, period(from_, start.start), {}};
  branch_.points.push_back(describe(node));
  const Index n = node.period.monodromy.cols();
  const VectorXd onward = (to_ >= from_ ? 1.0 : -1.0) * VectorXd::Unit(n + 1, n);
  node.tangent = tangent(node, onward).value_or(onward);
  double step = 0.1 * options_.largest_step;
  while (static_cast<int>(branch_.points.size()) < options_.max_points) {
    std::optional<Node> next = advance(node, step);
    if (!next) {
      add_change(ChangeKind::end, branch_.points.back(), branch_.points.back());
      break;
    }
    const bool left = !inside(next->parameter);
    if (left) {
      // The last point lies exactly on the end of the range.
      const double edge = std::abs(next->parameter - from_) < std::abs(next->parameter - to_) ? from_ : to_;
      std::optional<Node> last = orbit(edge, node.period.begin);
      if (!last) break;
      last->tangent = node.tangent;
      next = std::move(last);
    }
    record(node, *next);
    if (left) break;
    node = std::move(*next);
    step = std::min(1.5 * step, options_.largest_step);
  }
  return std::move(branch_);
}

}  // namespace

std::string_view name(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::sequence:
      return "sequence";
    case ChangeKind::sticking:
      return "sticking";
    case ChangeKind::stops:
      return "stops";
    case ChangeKind::fold:
      return "fold";
    case ChangeKind::stability:
      return "stability";
    case ChangeKind::end:
      return "end";
  }
  return "";
}

Branch continue_branch(const Model& model, BranchParameter parameter, double from, double to,
                       const BranchOptions& options) {
  require_in(positive, "analysis.from", from, "");
  require_in(positive, "analysis.to", to, "");
  Continuation continuation(model, parameter, from, to, options);
  Branch branch = continuation.run();
  branch.certificate = continuation.count();
  return branch;
}

}  // namespace dualdamp::sim
