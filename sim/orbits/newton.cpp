#include "sim/orbits/newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

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

double error_of_orbit(const ForcingPeriod& period, double omega, double closure) {
  constexpr double largest = 1e-2;
  if (!period.ends_in_its_mode() || !period.monodromy.allFinite()) return 0.0;
  const Eigen::VectorXd at = coordinates(period.begin);
  const double size = std::max(period.size, std::abs(at[1]) / omega);
  if (period.monodromy.rows() != at.size() || period.monodromy.cols() != at.size() || !(size > 0.0)) return 0.0;
  Eigen::VectorXd scale = Eigen::VectorXd::Constant(at.size(), size);
  scale[1] = size * omega;
  for (Eigen::Index i = 2; i < at.size(); ++i) scale[i] = std::max(std::abs(at[i]), size);
  const std::vector<Eigen::Index> free = period.free_coordinates();
  const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * period.monodromy * scale.asDiagonal();
  const auto n = static_cast<Eigen::Index>(free.size());
  const Eigen::MatrixXd inverse = (Eigen::MatrixXd::Identity(n, n) - scaled(free, free)).inverse();
  return inverse.allFinite() ? std::min(largest, closure * inverse.norm()) : largest;
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
      const auto closes_better = [&](const ForcingPeriod& trial) {
        return map.outcome().ok() && trial.closure(options.omega) < 0.5 * closure;
      };
      ForcingPeriod trial = map.from(displaced(period.begin, step), Monodromy::with);
      // After a stick, all reachable states lie on a curve. Newton's step may leave that curve. The first period
      // from there then closes badly only because it leads back to the curve, so the second period is judged
      // instead, if the mass still moves in it.
      const bool first_decides = !map.outcome().ok() || closes_better(trial);
      if (!first_decides) trial = map.next(Monodromy::with);
      if (closes_better(trial) && (first_decides || trial.moves)) {
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
