#include "sim/orbits/newton.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace dualdamp::sim {

Closure closure_within(double tolerance, double accuracy) {
  constexpr double rounding = 1e-12;
  return {std::max(tolerance, accuracy), std::max(rounding, 10.0 * accuracy)};
}

double correction_left(const ForcingPeriod& period, double omega) {
  const Eigen::VectorXd step = newton_step(period, omega);
  if (step.size() == 0) return std::numeric_limits<double>::infinity();
  return distance(period.begin, displaced(period.begin, step), period.size, omega);
}

NewtonResult close_orbit(PeriodMap& map, const NewtonOptions& options, ForcingPeriod& period) {
  NewtonResult result;
  while (map.outcome().ok() && result.steps < options.most_steps &&
         result.transient_periods <= options.most_transients) {
    const double closure = period.closure(options.omega);
    if (closure <= options.tolerance) {
      result.found = true;
      return result;
    }
    const Eigen::VectorXd step = newton_step(period, options.omega);
    ++result.steps;
    const State fallback = period.end;
    if (step.size() > 0) {
      ForcingPeriod trial = map.from(displaced(period.begin, step), Monodromy::with);
      if (map.outcome().ok() && trial.closure(options.omega) < 0.5 * closure) {
        period = std::move(trial);
        continue;
      }
    }
    if (closure <= options.rounding) {
      result.found = true;
      return result;
    }
    period = map.from(fallback, Monodromy::with);
    ++result.transient_periods;
  }
  return result;
}

}  // namespace dualdamp::sim
