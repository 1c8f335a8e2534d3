#pragma once
/// Tests whether the residuals of ordered readings are independent, or correlated from one to the next.
///
///   d = sum (r_{i+1} - r_i)^2 / sum r_i^2
///
/// is near 2 for noise, and small if the residuals keep their sign over several readings. Neighbours: extremes of a
/// decay by number or time; steady states of one level by their frequency, or of one frequency by their level where
/// there are fewer frequencies than levels. A level is held to some percent. Of readings at one place, all orders
/// are as good: d has the mean over them. The order of the rows in a file therefore has no effect.
///
/// The fit changes the residuals: errors e of equal deviation leave r = (1 - Q Q^T) e, where Q is an orthonormal
/// base of the weighted derivatives. A robust fit leaves Huber's scores, those beyond the bound at the bound:
/// psi = (1 - Q T^T) e, where Q is a base of the derivatives of the readings within the bound, zero at the others,
/// and T continues it to the others, which pull at the estimate but do not follow it (huber1981). Let S be the
/// covariance of r, and A the matrix of the squared differences. The chance of a statistic d below the found D is
///
///   P(d < D) = P(sum_j lambda_j z_j^2 < 0),   lambda_j: eigenvalues of S^(1/2) (A - D) S^(1/2),
///
/// with normal z_j, by Imhof's integral:
///
///   P = 1/2 - 1/pi int_0^inf sin(sum_j atan(lambda_j u)/2) / (u prod_j (1 + lambda_j^2 u^2)^(1/4)) du
///
/// The test needs no noise level. It also rejects slow errors of the sensor. Source: durbin1950, imhof1961. Errors:
/// `unknown` for fewer than four degrees of freedom, or if there are no neighbours. Cost: the cube of the number of
/// readings, up to 400. For more, the normal limit is used, with the mean and the variance of d for r = e.

#include <Eigen/Core>
#include <vector>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

/// Readings at one place, and such places in their order.
using SamePlace = std::vector<Eigen::Index>;
using ReadingLine = std::vector<SamePlace>;

/// The lines of neighbours of a signal that is not sampled.
[[nodiscard]] std::vector<ReadingLine> lines_of(const Signal& signal, bool steady_states);

/// How a fit changes errors of equal deviation: 1 - Q T^T.
struct FitInfluence {
  Eigen::MatrixXd Q, T;  ///< of the tested readings
  Eigen::MatrixXd gram;  ///< T^T T, of all readings of the fit

  [[nodiscard]] Eigen::MatrixXd covariance() const;
};

/// The test for the readings of a fit, signal by signal.
class SerialTest {
 public:
  /// `unbounded`: weights without Huber's bound; `misses`, `jacobian`: at the end of the fit. `problem` must
  /// outlive this.
  SerialTest(const FitProblem& problem, const Eigen::VectorXd& unbounded, const Eigen::VectorXd& weights,
             const Eigen::VectorXd& misses, const Eigen::MatrixXd& jacobian);

  /// Extremes enter with positive sign, because an error of a decay changes its sign with them. `unknown` if the
  /// residuals are no larger than errors of integration and rounding.
  [[nodiscard]] double p_value(const SignalRows& rows) const;

 private:
  const FitProblem& problem_;
  Eigen::VectorXd misses_, scores_;
  FitInfluence influence_;
};

/// The chance of such a small d; `unknown` for too few readings. `residuals`: weighted.
[[nodiscard]] double serial_p_value(const Eigen::VectorXd& residuals, const std::vector<ReadingLine>& lines,
                                    const FitInfluence& influence);

/// The same for residuals in their order of least squares; `base`: rows of Q.
[[nodiscard]] double serial_p_value(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& base);

/// P(sum_j lambda_j z_j^2 < 0) for normal z_j.
[[nodiscard]] double chance_below_zero(const Eigen::VectorXd& lambda);

}  // namespace dualdamp::identify
