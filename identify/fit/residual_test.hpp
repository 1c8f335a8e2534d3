#pragma once
/// Whether residuals are noise, or hold motion that the fitted rig does not make.
///
/// Of a sampled signal: noise has as much power where the motion is as elsewhere. With P_j the power of the
/// residuals at frequency j, B the fewest frequencies that hold 99 % of the power of the measured signal (eight at
/// least), b of them, and r others,
///
///   F = (sum_B P_j/b) / (sum_others P_j/r),   2b and 2r degrees of freedom.
///
/// It needs no noise level, and finds what hardly shows in the rms: a motion that is off by a third of the noise.
/// Noise that a sensor has made smooth looks like a motion, too. Of other readings with a stated noise s: the
/// chi-square test of sum r_i^2/s^2.
///
/// A stated noise is compared with the residuals on both sides: chi-square over its degrees of freedom, of the
/// readings that count as independent. Beyond a chance of 0.001 and a factor of 1.3 the statement is called wrong.
///
/// Source: brockwell1991. Cost: two Fourier transforms.

#include <Eigen/Core>
#include <string>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// The chance that noise alone has so much power where the motion is; `unknown` where fewer than 64 samples or no
/// stated noise do not tell. `parameters`: how many were fitted.
[[nodiscard]] double noise_p_value(const Signal& signal, const Eigen::VectorXd& residuals, std::size_t parameters);

/// Whether such a chance is noise's, or none is known.
[[nodiscard]] bool is_noise(double p_value);

/// The standard deviation of residuals among which some are no noise: by the median of their sizes.
[[nodiscard]] double robust_deviation(const Eigen::VectorXd& residuals);

/// Sets the misfit against a stated noise. `deviation`: of the residuals; `freedom`: independent readings without
/// the parameters that they determine, > 0.
void compare_with_stated(double deviation, double freedom, FittedSignal& signal);

/// Whether the residuals contradict the stated noise: > 0 they are larger, < 0 smaller, 0 they do not.
[[nodiscard]] int contradicts_stated(const FittedSignal& signal);

/// Says in `fit.warnings` which signals hold more than noise, and which noise was not as stated.
void warn_of_residuals(const Experiments& experiments, Fit& fit);

}  // namespace dualdamp::identify
