#pragma once
/// Standard errors of least squares whose readings have errors of unequal size.
///
///   V = A J^T diag[e_i^2/(1 - h_i)] J A,   A = (J^T J)^-1,   h_i = (J A J^T)_ii
///
/// with the residuals e_i (HC2, mackinnon1985). If all errors are equal, the expected value of V is their variance
/// times A. V_jj has the degrees of freedom f_j = tr(B)^2/tr(B^2), where B = M diag[(A J^T)_ji^2/(1 - h_i)] M and
/// M = 1 - J A J^T (bell2002). Cost: the square of the number of readings.

#include <Eigen/Core>

namespace dualdamp::identify {

struct UnequalErrors {
  Eigen::MatrixXd covariance;   ///< V
  Eigen::VectorXd half_widths;  ///< of 95 % intervals, in standard errors: t of each parameter's freedom
};

/// `jacobian` has full rank and more rows than columns.
[[nodiscard]] UnequalErrors unequal_errors(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals);

}  // namespace dualdamp::identify
