#include "identify/statistics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

std::optional<LackOfFit> added_term_test(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                                         const Eigen::VectorXd& term, double range, std::string name, int spent) {
  const auto count = jacobian.rows();
  const auto freedom = static_cast<int>(count - jacobian.cols() - 1) - spent;
  if (freedom < 1 || !(range > 0.0)) return std::nullopt;
  const Eigen::VectorXd explained = jacobian * linear_least_squares(jacobian, term);
  const Eigen::VectorXd extra = term - explained;  // what the term adds to the fitted columns
  const double weight = extra.squaredNorm();
  if (!(weight > 1e-16 * term.squaredNorm())) return std::nullopt;
  const double gain = extra.dot(residual) / weight;

  const double explained_square = gain * gain * weight;
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * range;
  const double floor = static_cast<double>(count) * rounding * rounding;
  const double left = std::max((residual - gain * extra).squaredNorm(), floor);
  LackOfFit test;
  test.test = std::move(name);
  test.freedom = freedom;
  test.statistic = explained_square / (left / freedom);
  test.p_value = f_test_p_value(test.statistic, 1.0, freedom);
  test.effect = std::sqrt(explained_square / static_cast<double>(count)) / range;
  test.fired = test.p_value < test.level && test.effect > test.least_effect;
  return test;
}

ParameterSet parameters(double zeta, double x_f, const KnownConstants& constants) {
  // Two roots, unlike critical_damping(): the product m k may leave the range of double precision.
  return {zeta, 2.0 * zeta * std::sqrt(constants.mass) * std::sqrt(constants.stiffness), x_f,
          constants.stiffness * x_f};
}

Interval around(double value, double half) { return {value - half, value + half}; }

ParameterIntervals around(const ParameterSet& values, const ParameterSet& errors, double half_width) {
  ParameterIntervals intervals;
  for (const auto& [name, unit, value, interval] : reported_parameters)
    intervals.*interval = around(values.*value, half_width * errors.*value);
  return intervals;
}

Interval widened(const Interval& interval, double value, double deviation) {
  const double centre = std::clamp(value, interval[0], interval[1]);
  const double added = normal95() * deviation;
  return {centre - std::hypot(centre - interval[0], added), centre + std::hypot(interval[1] - centre, added)};
}

void set_uncertainty(Estimate& estimate, const Eigen::Matrix2d& covariance, const Eigen::Vector2d& half_widths,
                     const KnownConstants& constants) {
  const Eigen::Vector2d deviation = covariance.diagonal().cwiseSqrt();
  const Eigen::Vector2d half = half_widths.cwiseProduct(deviation);
  const ParameterSet error = parameters(deviation[0], deviation[1], constants);
  estimate.std = error;
  estimate.interval95 = around(estimate.value, parameters(half[0], half[1], constants), 1.0);
  const Eigen::DiagonalMatrix<double, 2> to_force(1.0, constants.stiffness);
  estimate.covariance = to_force * covariance * to_force;
  if (error.zeta > 0.0 && error.x_f > 0.0) estimate.correlation = covariance(0, 1) / (error.zeta * error.x_f);
}

void set_uncertainty(Estimate& estimate, const Eigen::Matrix2d& covariance, double half_width,
                     const KnownConstants& constants) {
  set_uncertainty(estimate, covariance, Eigen::Vector2d::Constant(half_width), constants);
}

namespace {

ParameterSet difference(const ParameterSet& a, const ParameterSet& b) {
  ParameterSet result;
  for (const ReportedParameter& parameter : reported_parameters)
    result.*parameter.value = a.*parameter.value - b.*parameter.value;
  return result;
}

}  // namespace

void allow_for_misreading(Estimate& estimate, const ParameterSet& own,
                          const std::function<std::optional<ParameterSet>(const ParameterSet&)>& read) {
  const ParameterSet value = estimate.value;
  if (!estimate.interval95 || !(value.zeta > 0.0) || !(value.x_f >= 0.0)) return;
  ParameterSet misread = difference(own, value);
  const ParameterSet corrected = difference(value, misread);
  if (corrected.zeta > 0.0 && corrected.x_f >= 0.0) {
    const std::optional<ParameterSet> there = read(corrected);
    if (there) misread = difference(*there, corrected);
  }
  for (const ReportedParameter& parameter : reported_parameters) {
    const double by = misread.*parameter.value;
    if (!std::isfinite(by)) continue;
    for (double& end : (*estimate.interval95).*parameter.interval) end -= by;
  }
}

}  // namespace dualdamp::identify
