#pragma once
/// Linear least squares on samples of a motion, whose errors are not independent.
///
/// Residuals of neighbouring samples are correlated, because noise went through a filter and because errors of the
/// model last for many samples. Covariance with Bartlett's weights (newey1987):
///
///   C = (W^T W)^-1 [ S_0 + sum_l (1 - l/(L+1)) (S_l + S_l^T) ] (W^T W)^-1,   S_l = sum_t r_t r_(t-l) w_t w_(t-l)^T
///
/// with L twice the lag at which the correlation of the residuals has fallen to that of chance. The number of
/// residuals that count as independent is N/(1 + 2 sum (1 - l/(L+1)) rho_l).
///
/// This one solves a regression whose rows are all samples. residual_covariance.hpp is for a fit that is solved
/// elsewhere and reads several signals, each with a correlation of its own, or none.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"

namespace dualdamp::identify {

struct CorrelatedFit {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd residuals;
  double deviation = 0.0;    ///< of the residuals
  double independent = 0.0;  ///< residuals that count as such
  double condition = 1.0;    ///< of the columns, scaled to equal length

  /// Degrees of freedom left, at least one.
  [[nodiscard]] double freedom() const;
};

/// `blocks`: rows at which another record begins; residuals of different records are uncorrelated; 0 may be left
/// out. Nothing if the columns are linearly dependent.
[[nodiscard]] std::optional<CorrelatedFit> fit_correlated(const Eigen::MatrixXd& columns,
                                                          const Eigen::VectorXd& target,
                                                          const std::vector<Eigen::Index>& blocks);

/// Does one more column explain more than chance? Student's t test of its coefficient, squared, with the covariance
/// above. `range`: scale of the test's effect.
[[nodiscard]] std::optional<LackOfFit> correlated_term_test(const Eigen::MatrixXd& columns,
                                                            const Eigen::VectorXd& target,
                                                            const Eigen::VectorXd& term,
                                                            const std::vector<Eigen::Index>& blocks, double range,
                                                            std::string name);

}  // namespace dualdamp::identify
