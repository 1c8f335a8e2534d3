#include "sim/curves/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "sim/curves/continuation_steps.hpp"
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

constexpr const char* ends_inside = "the branch ends inside the range: no orbit continues it";

double largest_multiplier(const BranchPoint& point) {
  double largest = 0.0;
  for (const std::complex<double>& value : point.state.multipliers) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Whether friction holds the mass all the time.
bool is_held(const SteadyState& state) { return state.never_moves() && !state.sticks.empty(); }

}  // namespace

BranchPoint Continuation::describe(const Node& node) {
  const Model model = at(node.parameter);
  CountedMap map(model, ratio_, effort_);
  BranchPoint point{node.parameter, outline_of_orbit(model, map.unlimited(), node.period.begin, ratio_)};
  point.state.multipliers = node.period.multipliers();
  // The derivative costs more than the motion, and a motion beside the orbit may cost more than the orbit.
  constexpr long times = 40;
  constexpr long least = 50;
  effort_.of_period = times * std::max(least, map.engine().work());
  return point;
}

bool Continuation::inside(double parameter) const {
  return parameter >= std::min(from_, to_) && parameter <= std::max(from_, to_);
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
std::optional<Node> Continuation::at_edge(Node inner, Node outer, double step) {
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
  const SteadyState start = steady_state(first, {.tolerance = options_.tolerance, .detail = OrbitDetail::extremes});
  branch_.outcome = start.outcome;
  effort_.count += start.certificate;
  if (!start.outcome.ok()) return std::move(branch_);
  ratio_ = start.period_ratio;
  std::optional<Node> begin = node_at(from_, start.start);
  if (!begin) {
    branch_.outcome = {core::OutcomeKind::event_limit, "the period of the first orbit could not be followed"};
    return std::move(branch_);
  }
  Node node = std::move(*begin);
  branch_.points.push_back(describe(node));
  if (is_held(start)) return ended(BranchEnd::rest, where_held(from_, to_));
  const Index n = node.period.monodromy.cols();
  const VectorXd onward = (to_ >= from_ ? 1.0 : -1.0) * VectorXd::Unit(n + 1, n);
  node.tangent = tangent(node, onward).value_or(onward);
  double step = 0.1 * options_.largest_step;
  while (static_cast<int>(branch_.points.size()) < options_.max_points) {
    if (std::optional<Branch> complete = ended_ahead(node)) return std::move(*complete);
    std::optional<Node> next = advance(node, step);
    if (is_exhausted())
      return ended(
          BranchEnd::work,
          "the branch is not complete: it stops where the search for its orbits takes too long" + parting_at(node));
    if (!next && ((nearest_ < lost_by_rounding && !ends_ahead(node)) || !parting_at(node).empty()))
      return ended(BranchEnd::step,
                   "the branch is not complete: it stops where no step converges to an orbit" + parting_at(node));
    if (!next) {
      if (!jumps_on(node, step)) return ended(BranchEnd::orbit, ends_inside);
      continue;
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
    if (!record(node, *next)) {
      if (!jumps_on(node, step)) return ended(BranchEnd::orbit, ends_inside);
      continue;
    }
    if (left && next->parameter == from_ && from_ != to_)
      return ended(BranchEnd::range, "the branch turns back and leaves the range where it began" + meeting());
    if (left) return std::move(branch_);
    node = std::move(*next);
    if (node.period.size > without_bound * driven_displacement(at(node.parameter)))
      return ended(BranchEnd::growth, "the branch ends inside the range: its amplitude grows without bound");
    step = std::min(1.5 * step, options_.largest_step);
  }
  return ended(BranchEnd::points,
               "the branch is not complete: it stops after " + std::to_string(options_.max_points) + " points");
}

/// Whether the branch goes on beyond the last orbit, with another one at `node`; else it ends there.
bool Continuation::jumps_on(Node& node, double& step) {
  std::optional<Node> landed = after_jump(node);
  if (!landed) {
    add_change(ChangeKind::end, branch_.points.back(), branch_.points.back());
    return false;
  }
  node = std::move(*landed);
  step = 0.1 * options_.largest_step;
  return true;
}

/// Words that say so if the last orbit of the branch is the mirror image of the first one.
std::string Continuation::meeting() const {
  constexpr double near = 1e-6;
  const SteadyState& first = branch_.points.front().state;
  const SteadyState& last = branch_.points.back().state;
  const double most = near * first.amplitude;
  if (std::abs(first.peak + first.trough) <= most || std::abs(first.peak + last.trough) > most) return {};
  return ": its asymmetric orbits met their mirror images, where they join a branch of symmetric ones; begin at the "
         "other end of the range to follow that one";
}

/// The branch, if it ends just ahead where no step arrives: the motion dies, or neighbouring motions part ever
/// faster.
std::optional<Branch> Continuation::ended_ahead(const Node& node) {
  if (const std::optional<double> place = rest_ahead(node)) return at_rest(node, *place);
  const std::optional<double> place = grazing_ahead();
  if (!place) return std::nullopt;
  add_change(ChangeKind::end, branch_.points.back(), branch_.points.back());
  branch_.changes.back().parameter = *place;
  return ended(BranchEnd::orbit, ends_inside);
}

/// Whether the largest Floquet multiplier grows without bound towards a place just ahead, as it does where a
/// release or the yield of a contact becomes a grazing: the branch ends there.
bool Continuation::ends_ahead(const Node& node) const {
  constexpr double steps = 64.0;
  if (branch_.points.size() < 2) return false;
  const BranchPoint& before = branch_.points[branch_.points.size() - 2];
  const double last = largest_multiplier(before);
  Node previous{before.parameter, {}, {}, {}, {}};
  previous.period.begin = before.state.start;
  const double growth = node.period.radius() - last;
  return growth > 0.0 && way(node, previous).norm() * last < steps * options_.smallest_step * growth;
}

/// The place just ahead at which the largest Floquet multiplier grows without bound like a power of the distance: a
/// release becomes a grazing, and the branch ends. Towards it the steps become ever shorter.
std::optional<double> Continuation::grazing_ahead() const {
  constexpr double nearest = 3e-4;   // of the parameter
  constexpr double certainty = 0.1;  // of the distance: difference of two estimates
  const std::vector<BranchPoint>& points = branch_.points;
  if (points.size() < 5 || largest_multiplier(points.back()) < lost_by_parting) return std::nullopt;
  // p/(d ln(multiplier)/dp) falls in proportion to the distance from that place.
  const auto estimate = [&](std::size_t last) {
    const auto fall = [&](std::size_t i) {
      return (points[i].parameter - points[i - 1].parameter) /
             std::log(largest_multiplier(points[i]) / largest_multiplier(points[i - 1]));
    };
    const double way = 0.5 * (points[last].parameter - points[last - 2].parameter);
    const double middle = 0.5 * (points[last].parameter + points[last - 1].parameter);
    return middle + way * fall(last) / (fall(last - 1) - fall(last));
  };
  const std::size_t last = points.size() - 1;
  const double here = points[last].parameter;
  const double place = estimate(last);
  const double left = place - here;
  const bool ahead = left * (here - points[last - 1].parameter) > 0.0;
  if (!ahead || !(std::abs(left) < nearest * parameter_scale(here))) return std::nullopt;
  if (!inside(place) || !(std::abs(estimate(last - 1) - place) < certainty * std::abs(left))) return std::nullopt;
  return place;
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
    const SteadyState state = steady_state(at(parameter), {.detail = OrbitDetail::extremes});
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
  const bool up = to_ > from_;
  return reason + "; it moves " + (up ? "above " : "below ") + with_unit(moves, 4) +
         ": begin beyond that, or at the other end of the range";
}

/// The place just ahead at which the mass ceases to move, if the motion dies there: the branch then ends in a
/// continuum of rest positions, which no step reaches.
std::optional<double> Continuation::rest_ahead(const Node& node) {
  constexpr double dying = 1e-6;  // of the displacement by the drive
  constexpr double reach = 1e-3;
  constexpr double attracting = 1.0 + 1e-6;
  const SteadyState& state = branch_.points.back().state;
  const bool dies = !state.sticks.empty() && state.amplitude < dying * driven_displacement(at(node.parameter));
  if (!dies || node.period.radius() > attracting) return std::nullopt;
  const double sense = node.tangent.tail<1>()[0] < 0.0 ? -1.0 : 1.0;
  double moves = node.parameter;
  double rests =
      std::clamp(moves + sense * reach * parameter_scale(moves), std::min(from_, to_), std::max(from_, to_));
  State middle_of_motion = node.period.begin;
  middle_of_motion.x = 0.5 * (state.peak + state.trough);
  middle_of_motion.v = 0.0;
  middle_of_motion.direction = friction::Direction::none;
  if (!comes_to_rest(rests, middle_of_motion)) return std::nullopt;
  while (std::abs(rests - moves) > options_.location * std::max(std::abs(from_), std::abs(to_))) {
    const double middle = 0.5 * (moves + rests);
    (comes_to_rest(middle, middle_of_motion) ? rests : moves) = middle;
  }
  return 0.5 * (moves + rests);
}

/// Whether the motion from `start` comes to rest within a few periods.
bool Continuation::comes_to_rest(double parameter, const State& start) {
  constexpr int most_periods = 20;
  CountedMap map(at(parameter), 1, effort_);
  ForcingPeriod period = map.from(start, Monodromy::without);
  for (int i = 0; period.moves && map.outcome().ok() && i < most_periods; ++i)
    period = map.next(Monodromy::without);
  return map.outcome().ok() && !period.moves;
}

std::string Continuation::with_unit(double parameter, int digits) const {
  const std::string unit = quantity_ == &Excitation::frequency ? "rad/s" : model_.unit(model_.excitation.unit());
  return core::format_number(parameter, digits) + " " + unit;
}

Branch Continuation::at_rest(const Node& node, double place) {
  const BranchPoint last = branch_.points.back();
  branch_.changes.push_back(
      {ChangeKind::rest, place, last.state.amplitude, last.state.stops_per_cycle, 0, last.state.stable(), true});
  const std::string beyond = node.tangent.tail<1>()[0] < 0.0 ? "below " : "above ";
  return ended(BranchEnd::rest, "the branch ends inside the range: the mass does not move " + beyond +
                                    with_unit(place, 6) +
                                    ", where any rest position that friction can hold is an orbit");
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
    case ChangeKind::jump:
      return "jump";
    case ChangeKind::rest:
      return "rest";
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
