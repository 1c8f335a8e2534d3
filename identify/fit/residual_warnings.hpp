#pragma once
/// Warnings of what the residuals of a fit say against the law, the constants and the sensors.
///
/// The test for noise leaves out the mean (`residual_test.hpp`). Of the residuals of a history, a mean above four
/// standard errors, or one that makes up half of their mean square, speaks of the zero of the sensor, unless this
/// zero is sought. So does a zero that would take away a third of the sum of squares of residuals that are no
/// noise: for a small change (a score test), what the other parameters can do about it does not count.
///
/// Cost: linear.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A sentence for each signal whose residuals contradict its stated noise.
[[nodiscard]] std::vector<std::string> contradictions_of_stated(const Experiments& experiments, const Fit& fit);

/// Adds warnings to `fit`: signals whose residuals are not noise, and stated noises that are wrong. Also signals
/// whose residuals look like noise, but far above that of the sensor; not in a `robust` fit, where outliers do
/// that. Beside outliers it says nothing else, unless the fit is `robust`: they move the fit. Also signals whose
/// zero is off; `fit.parameters` say which zeros are sought. `zero_gains`: of each signal.
void warn_of_residuals(const Experiments& experiments, bool robust, const std::vector<double>& zero_gains,
                       Fit& fit);

/// Of each signal, the share of its sum of squares that a small shift of its zero would take away beside all
/// parameters. `weights`, `misses`, `jacobian`: of all rows, at the end of the search.
[[nodiscard]] std::vector<double> zero_gains_of(const FitProblem& problem, const Eigen::VectorXd& weights,
                                                const Eigen::VectorXd& misses, const Eigen::MatrixXd& jacobian);

}  // namespace dualdamp::identify
