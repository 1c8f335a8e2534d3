#include "identify/fit/serial_test.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "identify/fit/residual_test.hpp"
#include "identify/record.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// A: the matrix of the sum of the squared differences of neighbours.
Eigen::MatrixXd matrix_of_differences(Eigen::Index count) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i + 1 < count; ++i) {
    matrix(i, i) += 1.0;
    matrix(i + 1, i + 1) += 1.0;
    matrix(i, i + 1) = matrix(i + 1, i) = -1.0;
  }
  return matrix;
}

double integrand(const Eigen::VectorXd& lambda, double u) {
  double angle = 0.0;
  double size = 0.0;
  for (const double value : lambda) {
    angle += 0.5 * std::atan(value * u);
    size += 0.25 * std::log1p(value * value * u * u);
  }
  return std::sin(angle) * std::exp(-size) / u;
}

}  // namespace

double chance_below_zero(const Eigen::VectorXd& lambda) {
  const double unit = 1.0 / lambda.cwiseAbs().maxCoeff();
  // Trapezoidal rule over w with u = unit e^w: the integrand falls exponentially on both sides.
  constexpr double reach = 40.0;
  constexpr int steps = 1600;
  constexpr double step = 2.0 * reach / steps;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double u = unit * std::exp(-reach + step * i);
    sum += step * u * integrand(lambda, u);
  }
  return std::clamp(0.5 - sum * std::numbers::inv_pi, 0.0, 1.0);
}

double serial_p_value(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& base) {
  const Eigen::Index count = residuals.size();
  constexpr double least_for_test = 3.5;
  if (static_cast<double>(count) - base.squaredNorm() < least_for_test || !(residuals.squaredNorm() > 0.0))
    return unknown;
  const double d = (residuals.tail(count - 1) - residuals.head(count - 1)).squaredNorm() / residuals.squaredNorm();
  constexpr Eigen::Index many = 400;
  if (count > many)
    return 0.5 * std::erfc((2.0 - d) * std::sqrt(static_cast<double>(count)) / (2.0 * std::numbers::sqrt2));
  const Eigen::MatrixXd left = projector_beside(base);
  const Eigen::MatrixXd differences = matrix_of_differences(count) - d * Eigen::MatrixXd::Identity(count, count);
  const SymmetricSpectrum covariance = symmetric_spectrum(left);
  const Eigen::MatrixXd root = covariance.matrix_with(covariance.values.cwiseMax(0.0).cwiseSqrt());
  const SymmetricSpectrum spectrum = symmetric_spectrum(product(product(root, differences), root));
  return chance_below_zero(spectrum.values);
}

SerialTest::SerialTest(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& misses,
                       const Eigen::MatrixXd& jacobian)
    : problem_(problem), weights_(weights), misses_(misses), base_(misses.size(), 0) {
  const auto is_tested = [&](const SignalRows& rows) { return !problem.readings().signal(rows).is_sampled; };
  if (jacobian.cols() == 0 || std::ranges::none_of(problem.readings().signals(), is_tested)) return;
  Eigen::MatrixXd columns = weights.asDiagonal() * jacobian;
  for (Eigen::Index j = 0; j < columns.cols(); ++j)
    if (const double norm = columns.col(j).norm(); norm > 0.0) columns.col(j) /= norm;
  constexpr double rounding = 1e-7;
  base_ = orthonormal_basis(columns, rounding);
}

double SerialTest::p_value(const SignalRows& rows) const {
  const Signal& signal = problem_.readings().signal(rows);
  const Eigen::Index count = rows.size();
  const Eigen::VectorXd measured = problem_.readings().measured().segment(rows.begin, count);
  if (is_rounding(misses_.segment(rows.begin, count), measured)) return unknown;
  std::vector<std::size_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return signal.at[i]; });
  const bool turns = problem_.readings().experiment(rows).kind == ExperimentKind::decay && signal.name == "x";
  Eigen::VectorXd residuals(count);
  Eigen::MatrixXd base(count, base_.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto from = static_cast<Eigen::Index>(order[static_cast<std::size_t>(i)]);
    const double side = turns && measured[from] < measured.mean() ? -1.0 : 1.0;
    residuals[i] = side * misses_[rows.begin + from] * weights_[rows.begin + from];
    base.row(i) = side * base_.row(rows.begin + from);
  }
  return serial_p_value(residuals, base);
}

}  // namespace dualdamp::identify
