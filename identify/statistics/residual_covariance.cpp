#include "identify/statistics/residual_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// Autocorrelation at lags 0, 1, ... up to twice the lag up to which it is significant; {1} if `is_sampled` is
/// false.
std::vector<double> autocorrelation(const Eigen::VectorXd& residuals, bool is_sampled) {
  std::vector<double> rho{1.0};
  const double variance = residuals.squaredNorm();
  constexpr Eigen::Index least = 50;
  if (!is_sampled || residuals.size() < least || !(variance > 0.0)) return rho;
  const double chance = 2.0 / std::sqrt(static_cast<double>(residuals.size()));
  constexpr Eigen::Index most = 2000;
  const Eigen::Index longest = std::min(most, residuals.size() / 10);
  Eigen::Index last = longest;
  for (Eigen::Index lag = 1; lag <= last; ++lag) {
    const Eigen::Index count = residuals.size() - lag;
    rho.push_back(residuals.head(count).dot(residuals.tail(count)) / variance);
    if (last == longest && rho.back() < chance) last = std::min(longest, 2 * lag);
  }
  return rho;
}

/// Bartlett's weight of a lag among `count`.
double bartlett(std::size_t lag, std::size_t count) {
  return 1.0 - static_cast<double>(lag) / static_cast<double>(count);
}

}  // namespace

double independent_samples(const Eigen::VectorXd& residuals, bool is_sampled) {
  const std::vector<double> rho = autocorrelation(residuals, is_sampled);
  double inflation = 1.0;
  for (std::size_t l = 1; l < rho.size(); ++l) inflation += 2.0 * bartlett(l, rho.size()) * rho[l];
  return static_cast<double>(residuals.size()) / std::max(1.0, inflation);
}

Eigen::MatrixXd score_covariance(const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals, double variance,
                                 bool is_sampled) {
  const std::vector<double> rho = autocorrelation(residuals, is_sampled);
  Eigen::MatrixXd sum = variance * gram(rows);
  for (std::size_t l = 1; l < rho.size(); ++l) {
    const Eigen::Index count = rows.rows() - static_cast<Eigen::Index>(l);
    const Eigen::MatrixXd part = rows.bottomRows(count).transpose() * rows.topRows(count);
    sum += variance * rho[l] * bartlett(l, rho.size()) * (part + part.transpose());
  }
  return sum;
}

}  // namespace dualdamp::identify
