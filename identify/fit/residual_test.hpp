#pragma once
/// Tests whether residuals are noise, or hold a motion that the fitted rig does not have.
///
/// Sampled signals: noise has the same power at the frequencies of the motion as elsewhere. P_j is the power of the
/// residuals at frequency j. B is the smallest set of frequencies that hold 99 % of the power of the motion; it has
/// b of them, at least eight. r is the number of the others.
///
///   F = (sum_B P_j/b) / (sum_others P_j/r),   2b and 2r degrees of freedom.
///
/// Residuals that choose B are large by selection. Those of the sensor are in the measured signal, and those that
/// other signals of a loop bring with them are in the fitted one. The power of the motion at a frequency is
/// therefore the lesser of the two powers; or, for a motion that the fitted signal lacks, the lesser one of the
/// measured signal at the two frequencies beside it. Where noise exceeds 1 % of the power, B ends at lines that
/// stand out of the residuals by 2 ln N: the largest one of N lines of noise has about ln N times their mean.
///
/// The mean is left out. The test needs no noise level. It detects an error of the motion of a third of the noise,
/// which the rms hardly shows. It also rejects noise that the sensor smoothed. Of a signal that the fit itself
/// filtered, it takes the frequencies up to the cut-off, and divides the power by that of the gain of the filter.
/// Other readings with a stated noise s: chi-square test of sum r_i^2/s^2. A robust fit gives outliers little
/// weight; its residuals enter as it counts them.
///
/// A stated noise may be too small or too large: a two-sided chi-square test with the readings that count as
/// independent. It is called wrong for a chance below 0.001 and a ratio of the deviations beyond a factor of 1.3.
///
/// Source: brockwell1991. Cost: two Fourier transforms.

#include <Eigen/Core>

#include "identify/fit/fit.hpp"
#include "identify/statistics/scatter.hpp"

namespace dualdamp::identify {

/// Whether residuals are errors of integration and rounding, as of exact data: neither noise nor motion.
[[nodiscard]] bool is_rounding(const Eigen::VectorXd& residuals, const Eigen::VectorXd& measured);

/// Fewer samples have no test.
inline constexpr Eigen::Index least_test_samples = 64;

/// The chance that noise alone leaves such residuals. `unknown` for fewer than 64 samples, or for other readings
/// without a stated noise. `outputs`: of the fitted rig; `spent`: number of parameters that these readings
/// determine.
[[nodiscard]] double noise_p_value(const Signal& signal, const Eigen::VectorXd& outputs,
                                   const Eigen::VectorXd& residuals, double spent);

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

}  // namespace dualdamp::identify
