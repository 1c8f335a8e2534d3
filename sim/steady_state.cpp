#include "sim/steady_state.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/exact_engine.hpp"
#include "sim/observers.hpp"

namespace dualdamp::sim {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using friction::Direction;

namespace {

/// Multipliers this close to the unit circle do not attract within any laboratory's patience.
constexpr double neutral = 1e-9;

/// Closure that counts as an orbit when Newton's corrections have sunk into rounding.
constexpr double rounding_closure = 1e-12;

/// A motion that closes this well after thousands of periods and still is not periodic creeps.
constexpr double creeping = 1e-3;

constexpr int max_newton = 60;

/// Growth over the first periods' motion that counts as growth without bound.
constexpr double runaway = 1e9;

/// One forcing period: where it starts, where it ends, how the end depends on the start.
struct Passage {
  Vector2d begin;
  Vector2d end;
  Matrix2d derivative;
  double size = 0.0;  ///< largest |x| met [m]
  bool moves = false;

  /// Distance of end and begin relative to the size of the motion, velocities scaled by omega.
  [[nodiscard]] double closure(double omega) const {
    const Vector2d gap = end - begin;
    const double scale = std::max(size, std::abs(begin.y()) / omega);
    return scale > 0.0 ? std::hypot(gap.x(), gap.y() / omega) / scale : 0.0;
  }
};

class OrbitFinder {
 public:
  OrbitFinder(const Model& model, const SteadyStateOptions& options)
      : options_(options), omega_(model.excitation.frequency), engine_(model) {
    engine_.track_sensitivity(true);
    for (const friction::Law& law : model.friction) {
      memoryless_ = memoryless_ && law.start({}).state.empty();
      const double slipping = std::abs(law.force(law.start({}), {}, Direction::forward));
      weakening_ = weakening_ || law.static_limit(law.start({}), {}) > slipping;
    }
  }

  void find(SteadyState& result);
  void describe(SteadyState& result, const Model& model);

 private:
  Passage pass();
  Passage pass_from(const Vector2d& start);
  bool newton(Passage& passage, SteadyState& result);
  bool follow(Passage& passage, double closure, int periods, SteadyState& result);
  [[nodiscard]] double radius(const Passage& passage) const;
  [[nodiscard]] core::Outcome failure(const Passage& passage, const SteadyState& result) const;

  SteadyStateOptions options_;
  double omega_;
  ExactEngine engine_;
  bool memoryless_ = true;   ///< (x, v) is the whole state at a period boundary
  double first_half_ = 0.0;  ///< largest |x| in either half of the periods followed [m]
  double second_half_ = 0.0;
  bool weakening_ = false;  ///< some static limit exceeds its kinetic level: orbits may coexist
};

Passage OrbitFinder::pass() {
  Passage passage;
  passage.begin = {engine_.position(), engine_.velocity()};
  passage.size = std::abs(engine_.position());
  engine_.reset_sensitivity();
  const long cycle = engine_.cycle();
  while (engine_.cycle() == cycle) {
    const Interval* interval = engine_.next_in_period();
    if (interval == nullptr) break;
    passage.moves = passage.moves || interval->direction != Direction::rest;
    passage.size = std::max(passage.size, std::abs(engine_.position()));
  }
  passage.end = {engine_.position(), engine_.velocity()};
  passage.derivative = engine_.sensitivity();
  return passage;
}

Passage OrbitFinder::pass_from(const Vector2d& start) {
  engine_.restart(start.x(), start.y());
  return pass();
}

double OrbitFinder::radius(const Passage& passage) const {
  return passage.derivative.eigenvalues().cwiseAbs().maxCoeff();
}

/// Follows the motion until one period closes to `closure`; gives up on a motion that grows without bound.
bool OrbitFinder::follow(Passage& passage, double closure, int periods, SteadyState& result) {
  first_half_ = second_half_ = 0.0;
  const double early = passage.size;
  for (int i = 0; i < periods; ++i) {
    if (passage.closure(omega_) <= closure) return true;
    if (early > 0.0 && passage.size > runaway * early) return false;
    double& largest = i < periods / 2 ? first_half_ : second_half_;
    largest = std::max(largest, passage.size);
    passage = pass();
    ++result.transient_periods;
    if (!engine_.outcome().ok()) return false;
  }
  return passage.closure(omega_) <= closure;
}

/// Newton on the period map; a step that does not bring the orbit closer is replaced by one period of transient.
bool OrbitFinder::newton(Passage& passage, SteadyState& result) {
  for (int i = 0; i < max_newton && engine_.outcome().ok(); ++i) {
    const double closure = passage.closure(omega_);
    if (closure <= options_.tolerance) return true;
    const Matrix2d gap = Matrix2d::Identity() - passage.derivative;
    const Eigen::FullPivLU<Matrix2d> lu(gap);
    Vector2d target = passage.begin + lu.solve(passage.end - passage.begin);
    // A mass at rest at the boundary stays exactly at rest.
    if (passage.end.y() == 0.0) target.y() = 0.0;
    ++result.newton_steps;
    const Vector2d fallback = passage.end;
    const bool sound = lu.isInvertible() && target.allFinite();
    const Passage trial = sound ? pass_from(target) : passage;
    if (sound && trial.closure(omega_) < 0.5 * closure) {
      passage = trial;
      continue;
    }
    if (closure <= rounding_closure) return true;
    passage = pass_from(fallback);
    ++result.transient_periods;
  }
  return false;
}

/// Why following the motion found no orbit.
core::Outcome OrbitFinder::failure(const Passage& passage, const SteadyState& result) const {
  const std::string after = " after " + std::to_string(result.transient_periods) + " forcing periods";
  if (second_half_ > 1.5 * first_half_ || passage.size > 1.5 * first_half_) {
    return {core::OutcomeKind::no_steady_state,
            "no steady state: the amplitude still grows" + after + "; damping does not limit the motion"};
  }
  if (passage.closure(omega_) < creeping) {
    return {
        core::OutcomeKind::not_unique,
        "not unique: steady states form a continuum, and the motion from the initial state still creeps along it" +
            after};
  }
  return {core::OutcomeKind::no_steady_state,
          "no steady state: the motion from the initial state has not become periodic" + after};
}

void OrbitFinder::find(SteadyState& result) {
  Passage passage = pass();
  passage = pass();
  result.transient_periods = 2;
  bool found = false;
  // Where orbits may coexist Newton could land on another one than the motion approaches.
  if (weakening_) follow(passage, 1e-2, 500, result);
  if (memoryless_) found = newton(passage, result);
  const bool attracting = found && radius(passage) < 1.0 - neutral;
  if (!attracting && engine_.outcome().ok()) {
    engine_.start(result.start_position, result.start_velocity);
    passage = pass();
    found = follow(passage, 10.0 * options_.tolerance, options_.max_periods, result);
    if (found && passage.moves && radius(passage) >= 1.0 - neutral) {
      result.warnings.emplace_back(
          "not unique: a multiplier lies on the unit circle, so that neighbouring orbits are steady too; this is "
          "the "
          "one approached from the initial state");
    }
  }
  if (!engine_.outcome().ok()) {
    result.outcome = engine_.outcome();
  } else if (!found) {
    result.outcome = failure(passage, result);
  }
  result.start_position = passage.begin.x();
  result.start_velocity = passage.begin.y();
  for (const std::complex<double>& value : passage.derivative.eigenvalues()) result.multipliers.push_back(value);
}

/// Merges rest intervals into sticks; one that crosses the period boundary counts once and starts in the period
/// before.
void collect_stick(std::vector<Stick>& sticks, const Interval& interval, bool continues, double x) {
  if (continues && !sticks.empty()) {
    sticks.back().duration += interval.duration;
  } else {
    sticks.push_back({interval.begin, interval.duration, x});
  }
}

void join_across_boundary(std::vector<Stick>& sticks) {
  if (sticks.size() < 2) return;
  sticks.back().duration += sticks.front().duration;
  sticks.erase(sticks.begin());
}

void OrbitFinder::describe(SteadyState& result, const Model& model) {
  engine_.restart(result.start_position, result.start_velocity);
  Extremes extremes;
  EnergyAudit energy(model.oscillator);
  Fundamental fundamental(omega_);
  bool resting = false;
  bool rests_at_start = false;
  bool first = true;
  while (engine_.cycle() == 0) {
    const Interval* interval = engine_.next_in_period();
    if (interval == nullptr) break;
    extremes.observe(*interval);
    energy.observe(*interval);
    fundamental.observe(*interval);
    const bool rest = interval->direction == Direction::rest;
    if (rest) collect_stick(result.sticks, *interval, resting, engine_.position());
    if (first) rests_at_start = rest;
    first = false;
    resting = rest;
    if (interval->ending == EventKind::stop) ++result.stops_per_cycle;
  }
  if (resting && rests_at_start) join_across_boundary(result.sticks);
  result.peak = extremes.peak();
  result.trough = extremes.trough();
  result.amplitude = 0.5 * (result.peak - result.trough);
  result.max_speed = extremes.max_speed();
  result.energy = energy.account();
  const double lag = model.excitation.phase - std::arg(fundamental.coefficient());
  constexpr double turn = 2.0 * std::numbers::pi;
  result.phase = result.amplitude > 0.0 ? lag - turn * std::floor(lag / turn) : 0.0;
  if (result.sticks.size() == 1 && result.stops_per_cycle == 0) {
    result.warnings.emplace_back("the mass never moves: any rest position that friction can hold is steady too");
  }
}

}  // namespace

bool SteadyState::stable() const {
  return std::all_of(multipliers.begin(), multipliers.end(),
                     [](const std::complex<double>& value) { return std::abs(value) < 1.0 + neutral; });
}

SteadyState steady_state(const Model& model, const SteadyStateOptions& options) {
  SteadyState result;
  result.period = 2.0 * std::numbers::pi / model.excitation.frequency;
  result.start_position = model.initial.position;
  result.start_velocity = model.initial.velocity;
  OrbitFinder finder(model, options);
  finder.find(result);
  if (result.outcome.ok()) finder.describe(result, model);
  return result;
}

}  // namespace dualdamp::sim
