#pragma once
/// Covariance of least squares with residuals that are correlated from sample to sample, signal by signal.
///
///   (J^T J)^-1 [ sum over signals, lags l of w_l c_l (J_t^T J_(t+l) + its transpose) ] (J^T J)^-1
///
/// c_l: autocovariance of the signal's residuals, w_l: Bartlett's weights (newey1987). Readings that are not
/// samples are taken as independent. correlated_regression.hpp solves a regression of samples and gives its
/// covariance at once, with the products of residuals and rows in place of c_l.

#include <Eigen/Core>

namespace dualdamp::identify {

/// Number of samples that count as independent: N/(1 + 2 sum of the autocorrelation with Bartlett's weights).
[[nodiscard]] double independent_samples(const Eigen::VectorXd& residuals, bool is_sampled);

/// The bracket for one signal. `rows`: of J; `residuals`: over their deviation; `variance`: of these.
[[nodiscard]] Eigen::MatrixXd score_covariance(const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals,
                                               double variance, bool is_sampled);

}  // namespace dualdamp::identify
