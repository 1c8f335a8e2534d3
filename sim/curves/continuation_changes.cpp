// The changes along a branch: where the sequence of events or the stability changes, folds, and jumps.

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/curves/continuation_steps.hpp"
#include "sim/motion/observers.hpp"

namespace dualdamp::sim {

namespace {

/// Most changes of the sequence between two points of a branch that are located.
constexpr int most_changes = 64;

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

/// Positions at equal steps of time over a period.
class Course final : public PeriodObserver {
 public:
  explicit Course(double period) : sampler_(samples / period) {}
  void begin(const State&) override {}
  void observe(const Interval& interval, double) override { sampler_.observe(interval); }

  /// The largest distance between two courses [m].
  [[nodiscard]] double distance_to(Course& other) {
    double largest = 0.0;
    const std::size_t count = std::min(sampler_.samples().size(), other.sampler_.samples().size());
    for (std::size_t i = 0; i < count; ++i)
      largest = std::max(largest, std::abs(sampler_.samples()[i].x - other.sampler_.samples()[i].x));
    return largest;
  }

 private:
  static constexpr double samples = 64.0;
  Sampler sampler_;
};

}  // namespace

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

/// Bisects the parameter between `low` and `high` to the place at which `changed` becomes true. False: the branch
/// does not pass from one to the other along the parameter alone.
template <class Changed>
bool Continuation::bisect(BranchPoint& low, BranchPoint& high, const State& guess, const Changed& changed) {
  const double scale = std::max(std::abs(from_), std::abs(to_));
  constexpr double farthest = 30.0;  // the branch may make a detour where the sequence changes
  const State begin = low.state.start;
  const State end = high.state.start;
  while (std::abs(high.parameter - low.parameter) > options_.location * scale) {
    const double middle = 0.5 * (low.parameter + high.parameter);
    std::optional<Node> node = orbit(middle, low.state.start);
    if (!node) node = orbit(middle, guess);
    if (!node || !lies_between(begin, *node, end, farthest)) return false;
    BranchPoint point = describe(*node);
    (changed(point) ? high : low) = std::move(point);
  }
  return true;
}

/// The two orbits on either side of the place at which `changed` becomes true, by bisection along the branch.
template <class Changed>
std::pair<Node, Node> Continuation::close_in(Node low, Node high, const Changed& changed) {
  const bool distinct = !same_mode(low.period.begin, high.period.begin) ||
                        coordinates(low.period.begin) != coordinates(high.period.begin);
  double step = distinct ? options_.largest_step : options_.smallest_step;
  // Near a fold the parameter is a parabola in the length along the branch: the distance from the fold goes with
  // the square root of the parameter's change.
  const double near = std::sqrt(options_.location);
  while (step > near) {
    step *= 0.5;
    double shorter = step;
    const std::optional<Node> node = advance(low, shorter);
    if (!node) break;
    // Another branch may lie near.
    if (way(low, *node).norm() > 1.5 * way(low, high).norm()) continue;
    (changed(*node) ? high : low) = *node;
  }
  return {std::move(low), std::move(high)};
}

/// Whether two points next to each other lie on different branches: somewhere in the period the motions are far
/// apart, however close they are at its start. So it is where a release jumps (static friction above kinetic).
bool Continuation::are_apart(const BranchPoint& a, const BranchPoint& b) {
  constexpr double least = 1e-3;      // of the size of the motion
  constexpr double steepest = 100.0;  // distance within the period over that at its start
  const auto node_of = [&](const BranchPoint& point, Course* course) {
    CountedMap map(at(point.parameter), ratio_, effort_);
    return Node{point.parameter, map.unlimited().from(point.state.start, Monodromy::without, course), {}, {}, {}};
  };
  Course course_of_a(a.state.period);
  Course course_of_b(b.state.period);
  const Node at_a = node_of(a, &course_of_a);
  const Node at_b = node_of(b, &course_of_b);
  // A new stick begins with the square root of the distance from its place.
  const double resolved = std::sqrt(options_.location);
  const double near = std::max(least, 10.0 * resolved) + steepest * std::min(way(at_a, at_b).norm(), resolved);
  return course_of_a.distance_to(course_of_b) > near * scale(at_a)[0];
}

/// Locates every change of the sequence between the last point, `low`, and the new one. Then `low` is the first
/// orbit after the last change. False: the branch ends at a change, and `low` is its last orbit.
bool Continuation::locate_sequences(const Node& before, const Node& after, BranchPoint& low,
                                    const BranchPoint& last) {
  for (int changes = 0; !same_sequence(low.state.sequence, last.state.sequence); ++changes) {
    if (changes == most_changes) {
      branch_.warnings.push_back("more than " + std::to_string(most_changes) +
                                 " changes of the sequence between two points: some are not listed");
      return true;
    }
    BranchPoint high = last;
    const std::vector<EventKind> sequence = low.state.sequence;
    const auto changed = [&](const BranchPoint& point) { return !same_sequence(point.state.sequence, sequence); };
    if (!bisect(low, high, before.period.begin, changed) && changes == 0) {
      const auto [inner, outer] =
          close_in(before, after, [&](const Node& node) { return changed(describe(node)); });
      low = describe(inner);
      high = describe(outer);
    }
    const bool jumps = are_apart(low, high);
    // A sweep jumps, too, from one orbit that attracts to another. Beyond other jumps begins another branch.
    const bool goes_on = (high.parameter - low.parameter) * before.tangent.tail<1>()[0] >= 0.0;
    const bool attracts = branch_.points.back().state.stable() && high.state.stable();
    if (jumps && !(attracts && goes_on)) return false;
    add_change(jumps ? ChangeKind::jump : kind_of(low.state, high.state), low, high);
    low = high;
  }
  return true;
}

/// Locates the place between two orbits at which orbits begin or cease to attract.
void Continuation::locate_stability(const Node& before, BranchPoint low, BranchPoint high) {
  const bool stable = low.state.stable();
  (void)bisect(low, high, before.period.begin,
               [&](const BranchPoint& point) { return point.state.stable() != stable; });
  add_change(crossing_of(low.state, high.state), low, high);
}

/// Locates a fold by bisection along the branch: there the tangent has no part along the parameter. False: the
/// branch does not fold but ends, and `low` is its last orbit.
bool Continuation::locate_fold(const Node& before, const Node& after, BranchPoint& low) {
  const double onward = before.tangent.tail<1>()[0];
  const auto [inner, outer] =
      close_in(before, after, [&](const Node& node) { return node.tangent.tail<1>()[0] * onward < 0.0; });
  const BranchPoint high = describe(outer);
  const bool stable = low.state.stable();
  low = describe(inner);
  if (are_apart(low, high)) return false;
  add_change(ChangeKind::fold, low, high);
  branch_.changes.back().stable_before = stable;
  return true;
}

/// Adds the point `after` and all changes between `before` and it. False: the branch ends before.
bool Continuation::record(const Node& before, const Node& after) {
  const BranchPoint point = describe(after);
  BranchPoint low = branch_.points.back();
  const bool turned = same_mode(before.period.begin, after.period.begin) &&
                      before.tangent.tail<1>()[0] * after.tangent.tail<1>()[0] < 0.0;
  const bool goes_on = turned ? locate_fold(before, after, low) : locate_sequences(before, after, low, point);
  if (turned && goes_on) {
    branch_.changes.back().stable_after = point.state.stable();
  } else {
    const BranchPoint& first = goes_on ? low : branch_.points.back();
    const BranchPoint& last = goes_on ? point : low;
    if (first.state.stable() != last.state.stable()) locate_stability(before, first, last);
  }
  branch_.points.push_back(goes_on ? point : low);
  return goes_on;
}

/// Where no orbit continues the last one, and that one attracts: the orbit to which the motion goes on just beyond,
/// as in a sweep. It is added with the change.
std::optional<Node> Continuation::after_jump(const Node& node) {
  constexpr double small = 1e-3;   // change of the amplitude, relative
  constexpr double steep = 100.0;  // that change over that of the parameter, both relative
  const BranchPoint last = branch_.points.back();
  if (!last.state.stable() || node.tangent.size() == 0) return std::nullopt;
  const double sense = node.tangent.tail<1>()[0] < 0.0 ? -1.0 : 1.0;
  for (const double beyond : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
    const double parameter =
        last.parameter + sense * std::max(beyond, options_.location) * parameter_scale(last.parameter);
    if (!inside(parameter) || is_exhausted()) return std::nullopt;
    const SteadyState state = steady_state(at(parameter), {.tolerance = options_.tolerance,
                                                           .detail = OrbitDetail::extremes,
                                                           .others = false,
                                                           .from = last.state.start});
    effort_.count += state.certificate;
    effort_.work += state.work;
    if (!state.outcome.ok() || !state.stable() || state.never_moves() || state.period_ratio != ratio_) continue;
    std::optional<Node> landed = node_at(parameter, state.start);
    if (!landed) continue;
    const BranchPoint point = describe(*landed);
    const double change = std::abs(point.state.amplitude - last.state.amplitude) / last.state.amplitude;
    if (!are_apart(last, point) && change <= std::max(small, steep * beyond)) continue;
    const Eigen::VectorXd onward = sense * Eigen::VectorXd::Unit(node.tangent.size(), node.tangent.size() - 1);
    landed->tangent = tangent(*landed, onward).value_or(onward);
    add_change(ChangeKind::jump, last, point);
    branch_.points.push_back(point);
    return landed;
  }
  return std::nullopt;
}

}  // namespace dualdamp::sim
