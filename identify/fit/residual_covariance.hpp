#pragma once
/// Covariance of least squares whose residuals are alike from sample to sample, signal by signal.
///
///   (J^T J)^-1 [ sum over signals, lags l of w_l c_l (J_t^T J_(t+l) + its transpose) ] (J^T J)^-1
///
/// c_l: autocovariance of the signal's residuals, w_l: Bartlett's weights (newey1987). Readings that are no samples
/// of a signal are independent.

#include <Eigen/Core>
#include <vector>

namespace dualdamp::identify {

/// Autocorrelation at lags 0, 1, ... as far as it is more than chance, and as far again; {1} for independent ones.
[[nodiscard]] std::vector<double> autocorrelation(const Eigen::VectorXd& residuals, bool is_sampled);

/// Bartlett's weight of a lag among `count`.
[[nodiscard]] inline double bartlett(std::size_t lag, std::size_t count) {
  return 1.0 - static_cast<double>(lag) / static_cast<double>(count);
}

/// The bracket of one signal: rows of J, its residuals over their deviations, and the variance of these; of
/// `scores` (residuals that were bounded) each residual counts for itself.
[[nodiscard]] Eigen::MatrixXd score_covariance(const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals,
                                               double variance, bool is_sampled, bool scores);

}  // namespace dualdamp::identify
