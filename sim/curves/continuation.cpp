#include "sim/curves/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "sim/curves/continuation_steps.hpp"
#include "sim/engine/drive.hpp"
#include "sim/orbits/orbit_account.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Closure of a failed step over the rounding of an orbit, up to which the step failed by rounding.
constexpr double lost_by_rounding = 100.0;

/// Floquet multiplier from which on a failed step does not prove that the branch ends.
constexpr double lost_by_parting = 1e4;

/// Size of the motion, relative to the displacement by the drive's force, from which on it grows without bound: no
/// damping ratio above 1e-8 allows it.
constexpr double without_bound = 1e8;

/// Most changes of the sequence between two points of a branch that are located.
constexpr int most_changes = 64;

/// The displacement by the drive's force against the spring or the inertia, whichever is less [m].
double driven_displacement(const Model& model) {
  const double w = model.excitation.frequency;
  const double stiffness = std::max(model.oscillator.stiffness, model.oscillator.mass * w * w);
  return Drive(model.oscillator, model.excitation).force_scale() / stiffness;
}

/// Whether b is a, perhaps with another start in the forcing period.
bool same_sequence(const std::vector<EventKind>& a, const std::vector<EventKind>& b) {
  if (a.size() != b.size()) return false;
  std::vector<EventKind> twice = a;
  twice.insert(twice.end(), a.begin(), a.end());
  return std::search(twice.begin(), twice.end(), b.begin(), b.end()) != twice.end();
}

ChangeKind kind_of(const SteadyState& before, const SteadyState& after) {
  if (before.sticks.empty() != after.sticks.empty()) return ChangeKind::sticking;
  return before.stops_per_cycle != after.stops_per_cycle ? ChangeKind::stops : ChangeKind::sequence;
}

/// The kind of a change of stability, by the Floquet multiplier nearest to the unit circle of the attracting orbit.
ChangeKind crossing_of(const SteadyState& a, const SteadyState& b) {
  const SteadyState& attracting = a.stable() ? a : b;
  std::complex<double> nearest = 0.0;
  for (const std::complex<double>& value : attracting.multipliers) {
    if (std::abs(value) > std::abs(nearest)) nearest = value;
  }
  constexpr double on_circle = 1e-3;
  if (std::abs(nearest) < 1.0 - on_circle) return ChangeKind::stability;
  if (std::abs(nearest.imag()) > on_circle) return ChangeKind::neimark_sacker;
  return nearest.real() < 0.0 ? ChangeKind::flip : ChangeKind::stability;
}

/// Whether the mass never moves.
bool is_held(const SteadyState& state) { return state.peak == state.trough && !state.sticks.empty(); }

}  // namespace

BranchPoint Continuation::describe(const Node& node) const {
  BranchPoint point{node.parameter, {}};
  const Model model = at(node.parameter);
  CountedMap map(model, ratio_, effort_);
  point.state.period_ratio = ratio_;
  point.state.period = ratio_ * 2.0 * std::numbers::pi / model.excitation.frequency;
  point.state.start = node.period.begin;
  point.state.multipliers = node.period.multipliers();
  account_for_orbit(model, map, false, point.state);
  // The derivative costs more than the motion, and a motion beside the orbit may cost more than the orbit.
  constexpr long times = 40;
  constexpr long least = 50;
  effort_.of_period = times * std::max(least, map.engine().work());
  return point;
}

bool Continuation::inside(double parameter) const {
  return parameter >= std::min(from_, to_) && parameter <= std::max(from_, to_);
}

void Continuation::add_change(ChangeKind kind, const BranchPoint& before, const BranchPoint& after) {
  const double near = 4.0 * options_.location * std::max(std::abs(from_), std::abs(to_));
  const bool one = !branch_.changes.empty() && kind != ChangeKind::end && branch_.changes.back().kind == kind &&
                   std::abs(branch_.changes.back().parameter - after.parameter) <= near;
  if (one) {  // one change in two steps: one in each half of the forcing period
    branch_.changes.back().stops_after = after.state.stops_per_cycle;
    branch_.changes.back().stable_after = after.state.stable();
    return;
  }
  branch_.changes.push_back({kind, 0.5 * (before.parameter + after.parameter), after.state.amplitude,
                             before.state.stops_per_cycle, after.state.stops_per_cycle, before.state.stable(),
                             after.state.stable()});
}

/// Bisects the parameter between `low` and `high` to the place at which `changed` becomes true.
template <class Changed>
void Continuation::bisect(BranchPoint& low, BranchPoint& high, const State& guess, const Changed& changed) const {
  const double scale = std::max(std::abs(from_), std::abs(to_));
  constexpr double farthest = 30.0;  // the branch may make a detour where the sequence changes
  const State begin = low.state.start;
  const State end = high.state.start;
  while (std::abs(high.parameter - low.parameter) > options_.location * scale) {
    const double middle = 0.5 * (low.parameter + high.parameter);
    std::optional<Node> node = orbit(middle, low.state.start);
    if (!node) node = orbit(middle, guess);
    if (!node || !lies_between(begin, *node, end, farthest)) return;
    BranchPoint point = describe(*node);
    (changed(point) ? high : low) = std::move(point);
  }
}

/// Locates every change of the sequence between the last point and the new one.
void Continuation::locate_sequences(const Node& before, const BranchPoint& last) {
  BranchPoint low = branch_.points.back();
  for (int changes = 0; !same_sequence(low.state.sequence, last.state.sequence); ++changes) {
    if (changes == most_changes) {
      branch_.warnings.push_back("more than " + std::to_string(most_changes) +
                                 " changes of the sequence between two points: some are not listed");
      return;
    }
    BranchPoint high = last;
    const std::vector<EventKind> sequence = low.state.sequence;
    bisect(low, high, before.period.begin,
           [&](const BranchPoint& point) { return !same_sequence(point.state.sequence, sequence); });
    add_change(kind_of(low.state, high.state), low, high);
    low = high;
  }
}

/// Locates the place between the last point and the new one at which orbits begin or cease to attract. If the
/// sequence changes at the same place, that change is listed already and only gets the stability.
void Continuation::locate_stability(const Node& before, const BranchPoint& last) {
  BranchPoint low = branch_.points.back();
  BranchPoint high = last;
  const bool stable = low.state.stable();
  bisect(low, high, before.period.begin, [&](const BranchPoint& point) { return point.state.stable() != stable; });
  const ChangeKind kind = crossing_of(low.state, high.state);
  const bool jumps = !same_sequence(low.state.sequence, high.state.sequence);
  if (!jumps || kind != ChangeKind::stability) return add_change(kind, low, high);
  const double near = 4.0 * options_.location * std::max(std::abs(from_), std::abs(to_));
  for (BranchChange& change : branch_.changes) {
    if (std::abs(change.parameter - high.parameter) > near) continue;
    change.stable_before = stable;
    change.stable_after = !stable;
    return;
  }
  add_change(kind, low, high);
}

/// Locates a fold by bisection along the branch: there the tangent has no part along the parameter.
void Continuation::locate_fold(const Node& before, const Node& after) {
  Node low = before;
  Node high = after;
  double step = (coordinates(after.period.begin) - coordinates(before.period.begin)).norm() > 0.0
                    ? options_.largest_step
                    : options_.smallest_step;
  // Near a fold the parameter is a parabola in the length along the branch: the distance from the fold goes with
  // the square root of the parameter's change.
  const double near = std::sqrt(options_.location);
  while (step > near) {
    step *= 0.5;
    double shorter = step;
    const std::optional<Node> node = advance(low, shorter);
    if (!node) break;
    const bool turned = node->tangent.tail<1>()[0] * low.tangent.tail<1>()[0] < 0.0;
    (turned ? high : low) = *node;
  }
  add_change(ChangeKind::fold, describe(low), describe(high));
}

/// Adds the point `after` and all changes between `before` and it.
void Continuation::record(const Node& before, const Node& after) {
  BranchPoint point = describe(after);
  const BranchPoint& last = branch_.points.back();
  const bool turned = same_mode(before.period.begin, after.period.begin) &&
                      before.tangent.tail<1>()[0] * after.tangent.tail<1>()[0] < 0.0;
  if (turned) {
    locate_fold(before, after);
    branch_.changes.back().stable_before = last.state.stable();
    branch_.changes.back().stable_after = point.state.stable();
  } else {
    locate_sequences(before, point);
    if (last.state.stable() != point.state.stable()) locate_stability(before, point);
  }
  branch_.points.push_back(std::move(point));
}

/// Whether a point lies on a part of the branch that was passed before: between two of its points.
bool Continuation::was_passed(const Node& node) const {
  constexpr double on_it = 0.05;  // of the distance between the two points
  const auto place = [&](double parameter, const State& state) {
    const VectorXd size = scale(node);
    return Eigen::Vector3d(state.x / size[0], state.v / size[1], parameter / parameter_scale(node.parameter));
  };
  const Eigen::Vector3d here = place(node.parameter, node.period.begin);
  for (std::size_t i = 1; i + 1 < branch_.points.size(); ++i) {
    const BranchPoint& a = branch_.points[i - 1];
    const BranchPoint& b = branch_.points[i];
    if ((a.parameter - node.parameter) * (b.parameter - node.parameter) > 0.0) continue;
    const Eigen::Vector3d from = place(a.parameter, a.state.start);
    const Eigen::Vector3d way = place(b.parameter, b.state.start) - from;
    const double part = (here - from).dot(way) / way.squaredNorm();
    if (part >= 0.0 && part <= 1.0 && (here - from - part * way).norm() <= on_it * way.norm()) return true;
  }
  return false;
}

/// The orbit exactly at the end of the range, between the last node inside and the first one outside, which is
/// `step` further on. Where neighbouring motions part fast, Newton's method needs a good start: the two nodes are
/// brought nearer to the end, step by step along the branch.
std::optional<Node> Continuation::at_edge(Node inner, Node outer, double step) const {
  constexpr int attempts = 30;
  const double edge = std::abs(outer.parameter - from_) < std::abs(outer.parameter - to_) ? from_ : to_;
  for (int i = 0; i < attempts && !is_exhausted(); ++i) {
    const double part = (edge - inner.parameter) / (outer.parameter - inner.parameter);
    State guess = inner.period.begin;
    if (same_mode(guess, outer.period.begin))
      guess = displaced(guess, part * (coordinates(outer.period.begin) - coordinates(guess)));
    std::optional<Node> last = orbit(edge, guess);
    if (last && lies_between(inner.period.begin, *last, outer.period.begin, 2.0)) {
      last->tangent = inner.tangent;
      return last;
    }
    double shorter = step * std::clamp(part, 0.1, 0.9);
    const double whole = shorter;
    std::optional<Node> nearer = advance(inner, shorter);
    if (!nearer) return std::nullopt;
    const bool outside = !inside(nearer->parameter);
    step = outside || shorter < whole ? shorter : step - shorter;
    (outside ? outer : inner) = std::move(*nearer);
  }
  return std::nullopt;
}

Branch Continuation::run() {
  const Model first = at(from_);
  const SteadyState start = steady_state(first, {.tolerance = options_.tolerance, .full_account = false});
  branch_.outcome = start.outcome;
  effort_.count += start.certificate;
  if (!start.outcome.ok()) return std::move(branch_);
  ratio_ = start.period_ratio;
  std::optional<ForcingPeriod> begin = period(from_, start.start);
  if (!begin) {
    branch_.outcome = {core::OutcomeKind::event_limit, "the period of the first orbit could not be followed"};
    return std::move(branch_);
  }
  Node node{from_, std::move(*begin), {}};
  branch_.points.push_back(describe(node));
  if (is_held(start)) return ended(BranchEnd::rest, where_held(from_, to_));
  const Index n = node.period.monodromy.cols();
  const VectorXd onward = (to_ >= from_ ? 1.0 : -1.0) * VectorXd::Unit(n + 1, n);
  node.tangent = tangent(node, onward).value_or(onward);
  double step = 0.1 * options_.largest_step;
  while (static_cast<int>(branch_.points.size()) < options_.max_points) {
    std::optional<Node> next = advance(node, step);
    if (is_exhausted())
      return ended(
          BranchEnd::work,
          "the branch is not complete: it stops where the search for its orbits takes too long" + parting_at(node));
    if (!next && ((nearest_ < lost_by_rounding && !ends_ahead(node)) || !parting_at(node).empty()))
      return ended(BranchEnd::step,
                   "the branch is not complete: it stops where no step converges to an orbit" + parting_at(node));
    if (!next) {
      add_change(ChangeKind::end, branch_.points.back(), branch_.points.back());
      return ended(BranchEnd::orbit, "the branch ends inside the range: no orbit continues it");
    }
    if (was_passed(*next)) {
      add_change(ChangeKind::end, branch_.points.back(), branch_.points.back());
      return ended(BranchEnd::orbit, "the branch ends inside the range: it would go back over its own orbits");
    }
    const bool left = !inside(next->parameter);
    if (left) {
      std::optional<Node> last = at_edge(node, *next, step);
      if (!last)
        return ended(BranchEnd::edge, "the branch ends short of the end of the range: no orbit found there");
      next = std::move(last);
    }
    record(node, *next);
    if (left && next->parameter == from_ && from_ != to_)
      return ended(BranchEnd::range, "the branch turns back and leaves the range where it began");
    if (left) return std::move(branch_);
    node = std::move(*next);
    if (node.period.size > without_bound * driven_displacement(at(node.parameter)))
      return ended(BranchEnd::growth, "the branch ends inside the range: its amplitude grows without bound");
    step = std::min(1.5 * step, options_.largest_step);
  }
  return ended(BranchEnd::points,
               "the branch is not complete: it stops after " + std::to_string(options_.max_points) + " points");
}

/// Whether the largest Floquet multiplier grows without bound towards a place just ahead, as it does where a
/// release or the yield of a contact becomes a grazing: the branch ends there.
bool Continuation::ends_ahead(const Node& node) const {
  constexpr double steps = 64.0;
  if (branch_.points.size() < 2) return false;
  const BranchPoint& before = branch_.points[branch_.points.size() - 2];
  double last = 0.0;
  for (const std::complex<double>& value : before.state.multipliers) last = std::max(last, std::abs(value));
  Node previous{before.parameter, {}, {}};
  previous.period.begin = before.state.start;
  const double growth = node.period.radius() - last;
  return growth > 0.0 && way(node, previous).norm() * last < steps * options_.smallest_step * growth;
}

/// If neighbouring motions part too fast for a failed step to prove that the branch ends: words that say so.
std::string Continuation::parting_at(const Node& node) const {
  const double factor = node.period.radius();
  if (!(factor > lost_by_parting) || !std::isfinite(factor) || ends_ahead(node)) return {};
  return ": neighbouring motions part too fast, the largest Floquet multiplier is " +
         core::format_number(factor, 3);
}

/// Why a branch does not begin at a mass that friction holds, and where the mass begins to move, by bisection.
std::string Continuation::where_held(double held, double other) {
  constexpr double precision = 1e-4;
  const auto holds_at = [&](double parameter) {
    const SteadyState state = steady_state(at(parameter), {.full_account = false});
    effort_.count += state.certificate;
    return state.outcome.ok() && is_held(state);
  };
  const std::string reason =
      "no branch: the mass never moves at the first value, so any rest position that friction can hold is an orbit";
  if (holds_at(other)) return reason + "; nor does it move at the last value";
  double moves = other;
  while (std::abs(moves - held) > precision * std::max(moves, held)) {
    const double middle = std::sqrt(held * moves);
    (holds_at(middle) ? held : moves) = middle;
  }
  const std::string unit =
      quantity_ == &Excitation::frequency ? " rad/s" : (model_.excitation.moves_base() ? " m" : " N");
  const bool up = to_ > from_;
  return reason + "; it moves " + (up ? "above " : "below ") + core::format_number(moves, 4) + unit +
         ": begin beyond that, or at the other end of the range";
}

Branch Continuation::ended(BranchEnd end, const std::string& warning) {
  branch_.end = end;
  branch_.warnings.push_back(warning);
  return std::move(branch_);
}

std::string_view name_of(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::sequence:
      return "sequence";
    case ChangeKind::sticking:
      return "sticking";
    case ChangeKind::stops:
      return "stops";
    case ChangeKind::fold:
      return "fold";
    case ChangeKind::flip:
      return "flip";
    case ChangeKind::neimark_sacker:
      return "neimark_sacker";
    case ChangeKind::stability:
      return "stability";
    case ChangeKind::end:
      return "end";
  }
  return "";
}

std::string_view name_of(BranchEnd end) {
  switch (end) {
    case BranchEnd::range:
      return "range";
    case BranchEnd::orbit:
      return "orbit";
    case BranchEnd::points:
      return "points";
    case BranchEnd::edge:
      return "edge";
    case BranchEnd::step:
      return "step";
    case BranchEnd::growth:
      return "growth";
    case BranchEnd::work:
      return "work";
    case BranchEnd::rest:
      return "rest";
  }
  return "";
}

Branch continue_branch(const Model& model, BranchParameter parameter, double from, double to,
                       const BranchOptions& options) {
  require_in(friction::positive, "analysis.from", from, "");
  require_in(friction::positive, "analysis.to", to, "");
  Continuation continuation(model, parameter, from, to, options);
  Branch branch = continuation.run();
  branch.certificate = continuation.count();
  return branch;
}

}  // namespace dualdamp::sim
