#pragma once
/// Whether residuals of readings in an order are noise, or alike from one to the next.
///
///   d = sum (r_{i+1} - r_i)^2 / sum r_i^2
///
/// is near 2 for noise and small where the fitted rig is off now to one side, now to the other. The fit itself has
/// made the residuals what they are: of errors e with one deviation it leaves r = (1 - Q Q^T) e, Q an orthonormal
/// base of the weighted derivatives. With A the matrix of the squared differences the chance of so small a d is
///
///   P(d < D) = P(sum_j lambda_j z_j^2 < 0),   lambda_j: eigenvalues of (1 - Q Q^T)(A - D)(1 - Q Q^T),
///
/// z_j normal, which the integral of Imhof gives:
///
///   P = 1/2 - 1/pi int_0^inf sin(sum_j atan(lambda_j u)/2) / (u prod_j (1 + lambda_j^2 u^2)^(1/4)) du
///
/// It needs no noise level. Slow errors of the sensor show, too. Source: durbin1950, imhof1961. Errors: fewer than
/// four degrees of freedom tell nothing. Cost: the cube of the number of readings, 400 at most; of more the normal
/// limit, mean 2 and variance 4/n.

#include <Eigen/Core>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

/// Of the readings of a fit, signal by signal.
class SerialTest {
 public:
  /// At the end of a fit; all but the derivatives outlive this.
  SerialTest(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& misses,
             const Eigen::MatrixXd& jacobian);

  /// The readings in the order of what they are drawn over; extremes are taken by their size, as what is off in a
  /// decay turns its sign with them. `unknown` where integration and rounding leave all there is.
  [[nodiscard]] double p_value(const SignalRows& rows) const;

 private:
  const FitProblem& problem_;
  const Eigen::VectorXd& weights_;
  const Eigen::VectorXd& misses_;
  Eigen::MatrixXd base_;
};

/// The chance of residuals so alike; `unknown` where there are too few. `residuals`: weighted, in the order of the
/// readings; `base`: rows of Q.
[[nodiscard]] double serial_p_value(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& base);

/// P(sum_j lambda_j z_j^2 < 0) of normal z_j.
[[nodiscard]] double chance_below_zero(const Eigen::VectorXd& lambda);

}  // namespace dualdamp::identify
