#pragma once
/// The fit of a rig to records: least squares over all of them with one set of parameters.
///
///   min over p of  sum over signals g of  sum over samples i of  [(output_i(p) - measured_i)/s_g]^2
///
/// s_g is the stated noise of signal g, or else the deviation of its own residuals, found together with p (maximum
/// likelihood of independent normal errors). Levenberg-Marquardt within bounds (`identify/statistics/
/// least_squares.hpp`) from the best of several starts: the stated values, and points of a low-discrepancy sequence
/// about them, or, where nothing is stated, about sizes that follow from the data and the unit of the parameter.
/// Robust: Huber's weights, by repeated fits.
///
/// Uncertainty: of residuals that are alike from sample to sample the covariance is (J^T J)^-1 J^T S J (J^T J)^-1
/// with their own autocovariances in S (newey1987); profile: the parameter is held and the others follow by Gauss
/// and Newton's steps with the derivatives of the estimate. Directions of the parameters along which the data allow
/// a change of 100 % are told in words. Comparison of laws: AICc (burnham2002) with as many samples as count as
/// independent.
///
/// Source: ljung1999, burnham2002, newey1987, huber1964. Errors: `outcome`. Cost: of the motion, times 40 for the
/// starts and two for each parameter and step.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/outcome.hpp"
#include "identify/fit/experiment.hpp"
#include "identify/fit/problem.hpp"
#include "identify/fit/rig.hpp"

namespace dualdamp::identify {

struct FitOptions {
  bool robust = false;
  bool profile = true;
  int starts = 0;  ///< 0: 40 where something is not stated, else 8
};

/// A number that does not exist is `unknown`.
struct FittedParameter {
  FitParameter parameter;
  double value = 0.0;
  double std = unknown;
  std::array<double, 2> interval95{unknown, unknown};
  std::array<double, 2> profile95{unknown, unknown};
  bool at_bound = false;
  std::string reason;  ///< why a number does not exist
};

/// What the data cannot tell apart.
struct TradeOff {
  std::vector<std::string> parameters;
  std::string text;
};

struct FittedSignal {
  SignalRows rows;
  double rms = 0.0;              ///< of the residuals
  double range = 0.0;            ///< rms of the measured signal about its mean
  double noise = unknown;        ///< of the sensor, stated or by the roughness of the signal
  double noise_units = unknown;  ///< rms over it
  double independent = 0.0;      ///< samples that count as such
  double p_value = unknown;      ///< chance that the residuals are noise alone (`residual_test.hpp`)
  /// Of a stated noise: variance of the residuals over it, per degree of freedom, and the chance of one so far
  /// from 1.
  double chi2_per_freedom = unknown;
  double chi2_p_value = unknown;
};

struct Fit {
  core::Outcome outcome;
  std::vector<FittedParameter> parameters;
  Eigen::MatrixXd covariance;  ///< of the values; rows of parameters without one are zero
  std::vector<TradeOff> not_identifiable;
  std::vector<FittedSignal> signals;
  double noise_units = unknown;       ///< of all signals whose noise is known
  double log_likelihood_count = 0.0;  ///< samples that count as independent
  double deviance = 0.0;              ///< -2 ln of the largest likelihood, but for a constant, per sample
  double AICc = unknown;
  int starts = 0;  ///< tried
  Rig rig;         ///< with the fitted values
  std::vector<OwnValues> own;
  Eigen::VectorXd outputs;
  Eigen::MatrixXd slopes;  ///< d(outputs)/d(values)
  std::vector<std::string> warnings;
};

using Experiments = std::vector<std::unique_ptr<Experiment>>;

/// Fits these parameters of the rig, each record's own among them.
[[nodiscard]] Fit fit_rig(const Rig& rig, std::vector<FitParameter> parameters, const Experiments& experiments,
                          const FitOptions& options = {});

/// The covariance of the parameters that are no record's own, in their order.
[[nodiscard]] Eigen::MatrixXd shared_covariance(const Fit& fit);

/// AICc of each fit of the same data, set in them: all with the count of the one that leaves least.
void compare_fits(std::vector<Fit>& fits);

}  // namespace dualdamp::identify
