#pragma once
/// Small-sample statistics shared by the methods.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Does one more term explain more of the residuals than chance? F test of a fit with the columns `jacobian`
/// against the same fit with `term` added, both linearised at the estimate. `range` is that of the data: the scale
/// of `effect`, and of the rounding below which residuals carry no information. Nothing if no degree of freedom
/// would be left, or if the term depends linearly on the columns. `spent`: degrees of freedom used beside those of
/// the columns.
[[nodiscard]] std::optional<LackOfFit> added_term_test(const Eigen::MatrixXd& jacobian,
                                                       const Eigen::VectorXd& residual, const Eigen::VectorXd& term,
                                                       double range, std::string name, int spent = 0);

/// zeta and x_f [m] with what follows from them: c = 2 zeta sqrt(m k), F0 = k x_f.
[[nodiscard]] ParameterSet parameters(double zeta, double x_f, const KnownConstants& constants);

/// value - half to value + half.
[[nodiscard]] Interval around(double value, double half);

/// Intervals of `half_width` standard errors around the values.
[[nodiscard]] ParameterIntervals around(const ParameterSet& values, const ParameterSet& errors, double half_width);

/// A 95 % interval of `value` that also holds an independent error with this standard deviation: both sides grow by
/// the root of the sum of squares. A value outside counts as the nearer end.
[[nodiscard]] Interval widened(const Interval& interval, double value, double deviation);

/// Sets standard errors, intervals value +- half_width std, covariance and correlation of `estimate` from the
/// covariance of (zeta, x_f [m]).
void set_uncertainty(Estimate& estimate, const Eigen::Matrix2d& covariance, double half_width,
                     const KnownConstants& constants);

/// As above, with two half widths in standard errors: that of zeta and c, and that of x_f and F0.
void set_uncertainty(Estimate& estimate, const Eigen::Matrix2d& covariance, const Eigen::Vector2d& half_widths,
                     const KnownConstants& constants);

/// Corrects the 95 % intervals, if there are any, for the bias of the method. `read(theta)`: what the method
/// estimates from data that the exact law gives at theta; nothing if the law gives none. The truth is the theta for
/// which the method reads the estimate; two steps find it. The estimate itself is not changed. `own`:
/// read(estimate).
void allow_for_misreading(Estimate& estimate, const ParameterSet& own,
                          const std::function<std::optional<ParameterSet>(const ParameterSet&)>& read);

}  // namespace dualdamp::identify
