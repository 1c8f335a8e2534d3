#pragma once
/// Tests whether the residuals of ordered readings are independent, or correlated from one to the next.
///
///   d = sum (r_{i+1} - r_i)^2 / sum r_i^2
///
/// is near 2 for noise, and small if the residuals keep their sign over several readings. The fit changes the
/// residuals: errors e of equal deviation leave r = (1 - Q Q^T) e, where Q is an orthonormal base of the weighted
/// derivatives. Let A be the matrix of the squared differences. The chance of a statistic d below the found D is
///
///   P(d < D) = P(sum_j lambda_j z_j^2 < 0),   lambda_j: eigenvalues of (1 - Q Q^T)(A - D)(1 - Q Q^T),
///
/// with normal z_j, by Imhof's integral:
///
///   P = 1/2 - 1/pi int_0^inf sin(sum_j atan(lambda_j u)/2) / (u prod_j (1 + lambda_j^2 u^2)^(1/4)) du
///
/// The test needs no noise level. It also rejects slow errors of the sensor. Source: durbin1950, imhof1961. Errors:
/// `unknown` for fewer than four degrees of freedom. Cost: the cube of the number of readings, up to 400. For more,
/// the normal limit with mean 2 and variance 4/n is used.

#include <Eigen/Core>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

/// The test for the readings of a fit, signal by signal.
class SerialTest {
 public:
  /// `misses`, `jacobian`: at the end of the fit. All arguments but `jacobian` must outlive this.
  SerialTest(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& misses,
             const Eigen::MatrixXd& jacobian);

  /// The readings are ordered by their abscissa. Extremes enter with positive sign, because an error of a decay
  /// changes its sign with them. `unknown` if the residuals are no larger than errors of integration and rounding.
  [[nodiscard]] double p_value(const SignalRows& rows) const;

 private:
  const FitProblem& problem_;
  const Eigen::VectorXd& weights_;
  const Eigen::VectorXd& misses_;
  Eigen::MatrixXd base_;
};

/// The chance of such a small d; `unknown` for too few readings. `residuals`: weighted, in the order of the
/// readings; `base`: rows of Q.
[[nodiscard]] double serial_p_value(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& base);

/// P(sum_j lambda_j z_j^2 < 0) for normal z_j.
[[nodiscard]] double chance_below_zero(const Eigen::VectorXd& lambda);

}  // namespace dualdamp::identify
