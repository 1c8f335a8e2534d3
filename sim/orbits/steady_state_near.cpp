#include "sim/orbits/steady_state_near.hpp"

#include <algorithm>
#include <utility>

#include "core/constants.hpp"
#include "sim/neutral_margin.hpp"
#include "sim/orbits/newton.hpp"
#include "sim/orbits/orbit_account.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

/// A correction must reduce the closure by this factor at least; for neighbours it reduces it by far more.
constexpr double quick = 0.3;

/// Corrections are given up after as much work as this number of forcing periods of the known orbit takes: a step
/// may lead to states far from any orbit, where a forcing period takes thousands of times the work.
constexpr long most_periods = 200;

/// Corrects by the known orbit's monodromy matrix until the orbit closes, and once more, because differences
/// between neighbours may be small beside the tolerance; or until a correction is less than `share` of the first.
/// False if a correction does not help.
bool correct(PeriodMap& map, const KnownOrbit& near, const Model& model, const SteadyStateOptions& options,
             double share, SteadyState& result) {
  const double tolerance = std::max(options.tolerance, map.engine().accuracy());
  State start = near.start;
  bool closes = false;
  double first = 0.0;
  for (double before = 1.0 / quick;; ++result.newton_steps) {
    OrbitAccount account(model, {.detail = options.detail});
    ForcingPeriod period = map.from(start, Monodromy::without, &account);
    const double closure = period.closure(model.excitation.frequency);
    if (!map.outcome().ok() || !(closes ? closure <= tolerance : closure < quick * before)) return false;
    period.monodromy = near.monodromy;
    const Eigen::VectorXd step = newton_step(period, model.excitation.frequency);
    if (step.size() == 0) return false;
    const State next = displaced(start, step);
    const double length = distance(start, next, period.size, model.excitation.frequency);
    if (result.newton_steps == 0) first = length;
    if (closes || (result.newton_steps > 0 && length <= share * first)) {
      result.start = start;
      account.write(result);
      return true;
    }
    closes = closure <= tolerance;
    before = closure;
    start = next;
  }
}

/// Newton's method from the known orbit, with the derivative of every period: where the derivative differs from the
/// known one by so much that this one does not lead to the neighbour. False where a step does not help, or the
/// orbit at its end does not attract: the motion tells then which orbit it approaches.
bool close(PeriodMap& map, const KnownOrbit& near, const Model& model, const SteadyStateOptions& options,
           SteadyState& result) {
  constexpr int most_steps = 12;
  const Closure closure = closure_within(options.tolerance, map.engine().accuracy());
  ForcingPeriod period = map.from(near.start, Monodromy::with);
  const NewtonResult closed = close_orbit(map,
                                          {.omega = model.excitation.frequency,
                                           .tolerance = closure.tolerance,
                                           .rounding = closure.rounding,
                                           .most_steps = most_steps,
                                           .most_transients = 0},
                                          period);
  result.newton_steps += closed.steps;
  if (!closed.found || !period.moves || !(period.radius() < 1.0 - neutral_margin)) return false;
  OrbitAccount account(model, {.detail = options.detail});
  static_cast<void>(map.from(period.begin, Monodromy::without, &account));
  if (!map.outcome().ok()) return false;
  result.start = period.begin;
  result.multipliers = period.multipliers();
  account.write(result);
  return true;
}

}  // namespace

KnownOrbit known_orbit(const Model& model, const SteadyState& state) {
  PeriodMap map(model);
  if (map.engine().has_past()) return {.start = state.start, .monodromy = {}};
  ForcingPeriod period = map.from(state.start, Monodromy::with);
  const long work = map.engine().work();
  if (!period.ends_in_its_mode()) period.monodromy.resize(0, 0);
  return {state.start, std::move(period.monodromy), work};
}

bool attracts(const KnownOrbit& orbit) {
  if (orbit.monodromy.size() == 0) return false;
  ForcingPeriod period;
  period.monodromy = orbit.monodromy;
  return period.radius() < 1.0 - neutral_margin;
}

SteadyState steady_state_near(const KnownOrbit& near, const Model& model, const SteadyStateOptions& options,
                              double share) {
  valid_harmonic(model, "steady_state");
  require(near.start.memories.size() == model.friction.size(), "a known orbit needs a memory for each law",
          "one of a model with the same laws");
  SteadyState result;
  result.period = core::two_pi / model.excitation.frequency;
  PeriodMap map(model);
  SteadyStateOptions alone = options;
  alone.others = false;
  if (near.monodromy.size() == 0) return steady_state(model, alone);
  map.limit(std::min(options.most_work, most_periods * near.work));
  if (correct(map, near, model, options, share, result)) {
    ForcingPeriod known;
    known.monodromy = near.monodromy;
    result.multipliers = known.multipliers();
  } else if (!close(map, near, model, options, result)) {
    return steady_state(model, alone);
  }
  result.certificate = map.engine().count();
  return result;
}

}  // namespace dualdamp::sim
