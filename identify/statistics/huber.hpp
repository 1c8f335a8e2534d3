#pragma once
/// Huber's M-estimate: his sum, the deviation of readings among outliers, and the variance of the estimate.
///
///   psi(u) = u within the bound c, else c times its sign;   u: residual over deviation
///
/// Deviation: the residuals up to three times the one of their median are no outliers, and their mean square with
/// the degrees of freedom is the variance. The median alone has less than half of the efficiency, and that of few
/// residuals of a fit is far too small by chance. Both are divided by the degrees of freedom, not by the number of
/// readings.
///
/// Variance of the estimate over that of least squares with readings of this deviation:
///
///   V = [sum psi^2/f] / [mean psi']^2 K^2,   K = 1 + p/n (1 - mean psi')/(mean psi')
///
/// n: readings, p: parameters that they determine, f = n - p. Of few readings, V is too small by chance as often as
/// too large; it is at least that of normal readings with as many outliers.
///
/// Source: huber1964, huber1981 (7.6), street1988. Cost: linear.

#include <Eigen/Core>

namespace dualdamp::identify {

/// c, in deviations.
inline constexpr double huber_bound = 1.345;

/// A larger residual is an outlier, in deviations: one of 370 normal ones.
inline constexpr double rare_residual = 3.0;

/// Sum over residuals in units of their deviation: their squares, beyond the bound lines that continue them.
[[nodiscard]] double huber_sum(const Eigen::VectorXd& residuals);

/// psi of each residual.
[[nodiscard]] Eigen::VectorXd huber_scores(const Eigen::VectorXd& residuals);

struct RobustDeviation {
  double deviation = 0.0;
  double freedom = 0.0;   ///< of the residuals that are no outliers
  double outliers = 0.0;  ///< their share
};
/// The standard deviation of the readings that are no outliers. `residuals`: at least one; `freedom`: readings
/// minus the parameters that they determine, > 0.
[[nodiscard]] RobustDeviation robust_deviation(const Eigen::VectorXd& residuals, double freedom);

/// V of normal readings of deviation one, of which a share are outliers.
[[nodiscard]] double normal_huber_variance(double bound, double outliers);

/// V of these residuals, in units of their deviation.
[[nodiscard]] double huber_variance(const Eigen::VectorXd& residuals, double freedom, double outliers);

}  // namespace dualdamp::identify
