#include "identify/fit/intervals/rivals.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/coordinate.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

struct Rival {
  Eigen::VectorXd values;
  Eigen::VectorXd deviations;  ///< of the values, for weighted residuals of variance one
  double growth = 0.0;         ///< of the weighted sum of squares
};

std::optional<Rival> rival_at(const Eigen::VectorXd& q, const FitEnd& end, double most) {
  const double least = end.weights.cwiseProduct(end.misses).squaredNorm();
  Eigen::VectorXd outputs;
  Eigen::MatrixXd jacobian;
  if (!end.problem.outputs(q, outputs)) return std::nullopt;
  const double squares = end.weights.cwiseProduct(end.problem.readings().misses(outputs)).squaredNorm();
  Rival rival{.values = end.problem.space().values(q), .growth = std::max(squares - least, 0.0)};
  if (!(rival.growth < most) || !end.problem.derivatives(q, outputs, jacobian)) return std::nullopt;
  // In units of each coordinate's own effect; one without an effect there is as wide as its range.
  const Eigen::MatrixXd slope = end.problem.space().slope(q);
  const Eigen::MatrixXd rows = end.weights.asDiagonal() * jacobian;
  constexpr double least_effect = 1e-12;
  const Eigen::VectorXd effects = rows.colwise().norm().cwiseMax(least_effect);
  constexpr double ridge = 1e-10;
  Eigen::MatrixXd normal = gram(rows * effects.cwiseInverse().asDiagonal());
  normal.diagonal().array() += ridge;
  const Eigen::MatrixXd moved = slope * effects.cwiseInverse().asDiagonal();
  rival.deviations = propagated(moved, inverse_of(normal)).diagonal().cwiseMax(0.0).cwiseSqrt();
  return rival;
}

Interval widened(const Interval& interval, const Rival& rival, Eigen::Index i, const FitParameter& parameter,
                 double width) {
  const double value = rival.values[i];
  const bool is_positive = parameter.range.low >= 0.0 && value > 0.0;
  // Where a parameter has lost its effect its deviation is rounding, and says nothing about values far from there.
  constexpr double farthest = 3.0;
  const double factor = is_positive ? std::exp(std::min(width / value, farthest)) : 1.0;
  const double low = is_positive ? value / factor : value - width;
  const double high = is_positive ? value * factor : value + width;
  return {std::max(std::min(interval[0], low), parameter.range.low),
          std::min(std::max(interval[1], high), parameter.range.high)};
}

}  // namespace

void add_rivals(const FitEnd& end, const Eigen::VectorXd& limits, double variance, Fit& fit) {
  for (const Eigen::VectorXd& q : end.rivals) {
    const std::optional<Rival> rival = rival_at(q, end, limits.maxCoeff() * limits.maxCoeff());
    if (!rival) continue;
    std::vector<std::string> outside;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      FittedParameter& fitted = fit.parameters[k];
      const auto i = static_cast<Eigen::Index>(k);
      const double left = limits[i] * limits[i] - rival->growth;
      if (std::isnan(fitted.interval95[0]) || !(left > 0.0)) continue;
      const FitParameter& parameter = fitted.parameter;
      if (rival->values[i] < fitted.interval95[0] || rival->values[i] > fitted.interval95[1])
        outside.push_back(parameter.name + " = " + core::format_number(rival->values[i], 4) +
                          (parameter.unit == "1"
                               ? ""
                               : " " + core::unit_for(fit.rig.known.oscillator.coordinate, parameter.unit)));
      const double width = std::sqrt(left) * rival->deviations[i];
      fitted.interval95 = widened(fitted.interval95, *rival, i, parameter, width);
      if (!std::isnan(fitted.profile95[0]) && !std::isnan(fitted.profile95[1]))
        fitted.profile95 = widened(fitted.profile95, *rival, i, parameter, width);
    }
    if (outside.empty()) continue;
    fit.warnings.push_back("the sum of squares has another minimum, only " +
                           core::format_number(rival->growth / variance, 2) + " variances of the noise higher: " +
                           core::joined(outside) + ". The intervals hold both. State a value, or add a record");
  }
}

}  // namespace dualdamp::identify
