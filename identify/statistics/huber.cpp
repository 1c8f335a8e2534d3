#include "identify/statistics/huber.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

double huber_sum(const Eigen::VectorXd& residuals) {
  const Eigen::ArrayXd sizes = residuals.cwiseAbs();
  const Eigen::ArrayXd inside = sizes.min(huber_bound);
  return (inside * (2.0 * sizes - inside)).sum();
}

Eigen::VectorXd huber_scores(const Eigen::VectorXd& residuals) {
  return residuals.cwiseMax(-huber_bound).cwiseMin(huber_bound);
}

RobustDeviation robust_deviation(const Eigen::VectorXd& residuals, double freedom) {
  const auto count = static_cast<double>(residuals.size());
  std::vector<double> sizes(residuals.data(), residuals.data() + residuals.size());
  for (double& size : sizes) size = std::abs(size);
  const double by_median = median_deviation(sizes) * std::sqrt(count / freedom);
  constexpr double variance_within = 0.9733;  // of a normal variable that is no outlier
  double sum = 0.0;
  double outside = 0.0;
  for (const double size : sizes)
    if (size > rare_residual * by_median)
      outside += 1.0;
    else
      sum += size * size;
  const double left = freedom - outside;
  const double outliers = outside / count;
  if (!(left >= 1.0)) return {by_median, std::min(1.0, freedom), outliers};
  const double within = outside > 0.0 ? variance_within : 1.0;
  return {std::sqrt(sum / (left * within)), left, outliers};
}

double normal_huber_variance(double bound, double outliers) {
  const double inside = std::erf(bound / std::numbers::sqrt2);
  const double density = std::exp(-0.5 * bound * bound) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
  const double square = inside - 2.0 * bound * density + bound * bound * (1.0 - inside);
  const double normal = 1.0 - outliers;
  return (normal * square + outliers * bound * bound) / std::pow(normal * inside, 2);
}

double huber_variance(const Eigen::VectorXd& residuals, double freedom, double outliers) {
  const auto count = static_cast<double>(residuals.size());
  const double inside = static_cast<double>((residuals.array().abs() <= huber_bound).count()) / count;
  const double least = normal_huber_variance(huber_bound, std::min(outliers, 0.5));
  // The slope of psi is too rough a count where hardly a residual is inside of the bound.
  constexpr double enough = 0.25;
  if (!(inside > enough)) return least;
  const double factor = 1.0 + (count - freedom) / count * (1.0 - inside) / inside;
  return std::max(least, huber_scores(residuals).squaredNorm() / freedom * std::pow(factor / inside, 2));
}

}  // namespace dualdamp::identify
