#include "sim/orbits/orbit_solver.hpp"

#include <algorithm>
#include <utility>

#include "sim/neutral_margin.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

OrbitSolver::OrbitSolver(const Model& model, double tolerance, double rounding)
    : model_(model),
      options_{.omega = model.excitation.frequency,
               .tolerance = tolerance,
               .rounding = rounding,
               .most_steps = 20,
               .most_transients = 4} {}

PeriodMap& OrbitSolver::map_over(int periods) {
  if (!map_ || map_->periods() != periods) {
    if (map_) {
      searched_ += map_->engine().count();
      work_ += map_->engine().work();
    }
    map_ = std::make_unique<PeriodMap>(model_, periods);
  }
  map_->limit(most_work_ - work_);
  return *map_;
}

PeriodMap& OrbitSolver::patient_map_over(int periods) {
  PeriodMap& map = map_over(periods);
  map.limit(std::numeric_limits<long>::max());
  return map;
}

core::SearchCount OrbitSolver::count() const {
  core::SearchCount sum = searched_;
  if (map_) sum += map_->engine().count();
  return sum;
}

std::optional<Orbit> OrbitSolver::attracting(const State& state, int periods) {
  PeriodMap& map = map_over(periods);
  if (work_ + map.engine().work() >= most_work_) return std::nullopt;
  Orbit orbit{map.from(state, Monodromy::with), periods};
  const NewtonResult newton = close_orbit(map, options_, orbit.period);
  newton_steps_ += newton.steps;
  if (!newton.found || !(orbit.period.free_radius() < 1.0 - neutral_margin)) return std::nullopt;
  return orbit;
}

std::optional<Orbit> OrbitSolver::near(const State& state, int periods) {
  std::optional<Orbit> orbit = attracting(state, periods);
  for (int divisor = 1; orbit && divisor < periods; ++divisor) {
    if (periods % divisor != 0) continue;
    const ForcingPeriod shorter = map_over(divisor).from(orbit->period.begin, Monodromy::without);
    if (shorter.closure(options_.omega) > same_orbit) continue;
    if (std::optional<Orbit> shortest = attracting(orbit->period.begin, divisor)) return shortest;
  }
  return orbit;
}

/// A motion at a distance d of an orbit of one forcing period comes back to within 2 d after each; when it winds,
/// it may come back more closely after several, and seem to have their period.
Orbit OrbitSolver::with_shortest_period(Orbit orbit) {
  const int periods = orbit.period_ratio;
  const double closure = std::max(options_.rounding, orbit.period.closure(options_.omega));
  const double limit =
      periods > 1 ? std::max(closure, 2.0 * error_of_orbit(orbit.period, options_.omega, closure)) : closure;
  for (int divisor = 1; divisor < periods; ++divisor) {
    if (periods % divisor != 0) continue;
    ForcingPeriod shorter = patient_map_over(divisor).from(orbit.period.begin, Monodromy::with);
    if (shorter.closure(options_.omega) <= limit) return {std::move(shorter), divisor};
  }
  return orbit;
}

double OrbitSolver::error(const Orbit& orbit) const {
  const double error = error_of_orbit(orbit.period, options_.omega, options_.rounding);
  constexpr double slow = 1e3;  // periods: orbits that attract faster need no care, at a loose tolerance neither
  return error > std::max(same_orbit, slow * options_.rounding) ? error : 0.0;
}

Orbit OrbitSolver::refined(Orbit orbit) {
  if (!(error(orbit) > 0.0 && orbit.period.free_radius() < 1.0 - neutral_margin)) return orbit;
  NewtonOptions finest = options_;
  finest.tolerance = 0.0;
  finest.most_transients = 0;
  Orbit better = orbit;
  const NewtonResult newton = close_orbit(patient_map_over(orbit.period_ratio), finest, better.period);
  newton_steps_ += newton.steps;
  return newton.found ? better : orbit;
}

std::optional<Orbit> OrbitSolver::near_motion_from(State state) {
  constexpr int trials = 4;
  constexpr int between = 8;
  for (int trial = 0; trial < trials; ++trial) {
    std::optional<Orbit> orbit = near(state, 1);
    if (orbit && orbit->period.moves) return orbit;
    PeriodMap& map = map_over(1);
    for (int i = 0; i < between && work_ + map.engine().work() < most_work_; ++i)
      state = map.from(state, Monodromy::without).end;
  }
  return std::nullopt;
}

Orbit OrbitSolver::later(const Orbit& orbit, long periods) {
  if (periods == 0) return orbit;
  State state = orbit.period.begin;
  PeriodMap& single = patient_map_over(1);
  for (long i = 0; i < periods; ++i) state = single.from(state, Monodromy::without).end;
  return {patient_map_over(orbit.period_ratio).from(state, Monodromy::with), orbit.period_ratio};
}

bool OrbitSolver::same(const Orbit& a, const Orbit& b) const {
  return a.period_ratio == b.period_ratio && distance(a.period.begin, b.period.begin, a.period.size,
                                                      options_.omega) < std::max(same_orbit, error(a) + error(b));
}

bool OrbitSolver::coincide(const Orbit& a, const Orbit& b) {
  for (int late = 0; late < a.period_ratio && a.period_ratio == b.period_ratio; ++late) {
    if (same(later(a, late), b)) return true;
  }
  return false;
}

}  // namespace dualdamp::sim
