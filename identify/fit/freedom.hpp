#pragma once
/// Degrees of freedom of the residuals of each signal.
///
///   f_s = n_s - trace of the block of signal s of J (J^T J)^-1 J^T
///
/// n_s: readings that count; J: weighted derivatives of all readings. The sum of f_s is the number of readings
/// minus that of the parameters that they determine. A signal of few readings that determines most of the
/// parameters has far less than its share of that sum, and the mean square of its residuals must be divided by f_s.
///
/// Cost: one QR decomposition of J.

#include <Eigen/Core>
#include <vector>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

/// With fewer degrees of freedom, residuals do not show the deviation of their signal. (One, less rounding.)
inline constexpr double least_freedom = 0.99;

/// f of each signal. `rows`: J; columns of zeros count for nothing.
[[nodiscard]] std::vector<double> freedoms_of(const FitProblem& problem, const Eigen::MatrixXd& rows);

/// Degrees of freedom of a sum of independent variances, each estimated with its own (welch1947).
[[nodiscard]] double joint_freedom(const std::vector<double>& variances, const std::vector<double>& freedoms);

/// What the scores of a signal gain because the deviations that weigh the signals against each other are found from
/// the residuals: 2 (2/f) (A - A Phi A). A: the part of the signal in the normal matrix, whose inverse is Phi; 2/f:
/// variance of the logarithm of its variance. None for a single signal, or if the noise is stated (f is infinite).
/// Source: kenward1997.
[[nodiscard]] Eigen::MatrixXd doubt_of_weights(const Eigen::MatrixXd& normal_of_signal,
                                               const Eigen::MatrixXd& inverse_of_all, double freedom);

}  // namespace dualdamp::identify
