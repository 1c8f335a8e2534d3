#pragma once
/// Tests whether residuals are noise, or hold a motion that the fitted rig does not have.
///
/// Sampled signals: noise has the same power at the frequencies of the motion as elsewhere. P_j is the power of the
/// residuals at frequency j. B is the smallest set of frequencies that hold 99 % of the power of the measured
/// signal; it has b of them, at least eight. r is the number of the others.
///
///   F = (sum_B P_j/b) / (sum_others P_j/r),   2b and 2r degrees of freedom.
///
/// The test needs no noise level. It detects an error of the motion of a third of the noise, which the rms hardly
/// shows. It also rejects noise that the sensor smoothed. Of a signal that the fit itself filtered, it takes the
/// frequencies up to the cut-off, and divides the power by that of the gain of the filter. Other readings with a
/// stated noise s: chi-square test of sum r_i^2/s^2. A robust fit gives outliers little weight; its residuals enter
/// as it counts them.
///
/// A stated noise may be too small or too large: a two-sided chi-square test with the readings that count as
/// independent. It is called wrong for a chance below 0.001 and a ratio of the deviations beyond a factor of 1.3.
///
/// The test leaves out the mean. Of the residuals of a history, a mean above four standard errors, or one that
/// makes up half of their mean square, speaks of the zero of the sensor, unless this zero is sought. So does a zero
/// that would take away a third of the sum of squares of residuals that are no noise: for a small change (a score
/// test), what the other parameters can do about it does not count.
///
/// Source: brockwell1991. Cost: two Fourier transforms.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/fit/fit.hpp"
#include "identify/statistics/scatter.hpp"

namespace dualdamp::identify {

/// Whether residuals are errors of integration and rounding, as of exact data: neither noise nor motion.
[[nodiscard]] bool is_rounding(const Eigen::VectorXd& residuals, const Eigen::VectorXd& measured);

/// The chance that noise alone leaves such residuals. `unknown` for fewer than 64 samples, or for other readings
/// without a stated noise. `spent`: number of parameters that these readings determine.
[[nodiscard]] double noise_p_value(const Signal& signal, const Eigen::VectorXd& residuals, double spent);

/// The residuals of a signal as a robust fit counts them: those beyond Huber's bound are at the bound. `weights`:
/// at the end of the fit; equal weights leave the residuals unchanged.
[[nodiscard]] Eigen::VectorXd bounded_residuals(const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights);

/// Whether a chance agrees with noise: it is at least 0.001, or `unknown`.
[[nodiscard]] bool is_noise(double p_value);

/// Sets `chi2_per_freedom` and `chi2_p_value` of a signal with a stated noise. `deviation`: of the residuals;
/// `freedom`: number of independent readings, minus the parameters that they determine.
void compare_with_stated(double deviation, double freedom, FittedSignal& signal);

/// How the residuals scatter beside the stated noise.
[[nodiscard]] ScatterBesideStated scatter_beside_stated(const FittedSignal& signal);

/// A sentence for each signal whose residuals contradict its stated noise.
[[nodiscard]] std::vector<std::string> contradictions_of_stated(const Experiments& experiments, const Fit& fit);

/// Adds warnings to `fit`: signals whose residuals are not noise, and stated noises that are wrong. Also signals
/// whose residuals look like noise, but far above that of the sensor; not in a `robust` fit, where outliers do
/// that. Of outliers it says nothing else: they move the fit. Also signals whose zero is off; `fit.parameters` say
/// which zeros are sought. `zero_gains`: of each signal.
void warn_of_residuals(const Experiments& experiments, bool robust, const std::vector<double>& zero_gains,
                       Fit& fit);

/// Of each signal, the share of its sum of squares that a small shift of its zero would take away beside all
/// parameters. `weights`, `misses`, `jacobian`: of all rows, at the end of the search.
[[nodiscard]] std::vector<double> zero_gains_of(const FitProblem& problem, const Eigen::VectorXd& weights,
                                                const Eigen::VectorXd& misses, const Eigen::MatrixXd& jacobian);

}  // namespace dualdamp::identify
