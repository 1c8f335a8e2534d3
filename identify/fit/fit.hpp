#pragma once
/// The fit of a rig to records: least squares over all of them with one set of parameters.
///
///   min over p of  sum over signals g of  sum over samples i of  [(output_i(p) - measured_i)/s_g]^2
///
/// s_g is the stated noise of signal g, or else the standard deviation of its residuals, found together with p
/// (maximum likelihood for independent normal errors). The search is Levenberg-Marquardt within bounds
/// (`identify/statistics/least_squares.hpp`) from the best of several starts: the stated values and points of a
/// low-discrepancy sequence around them. For a parameter without a stated value, a size that follows from the data
/// and its unit takes the place of the stated value. Robust fits use Huber's weights, by repeated fits.
///
/// Uncertainty: the covariance is (J^T J)^-1 J^T S J (J^T J)^-1, where S has the autocovariances of the residuals
/// (newey1987), because residuals may be correlated from sample to sample. Each signal has degrees of freedom of
/// its own (`freedom.hpp`), and so has each parameter (welch1947). In a robust fit, the variance of S is that of
/// Huber's estimate (`signal_variance.hpp`). For a profile, the parameter is held at a value and the others are
/// fitted by Gauss-Newton steps with the derivatives at the estimate. Directions of the parameters along which the
/// data allow a change of 100 % are described in words.
///
/// A search that takes more work than `FitOptions::most_work` ends without a result, and says so. Profiles
/// have the same limit of their own; beyond it the fit has none.
///
/// Source: ljung1999, newey1987, huber1964. Errors: `outcome`. Cost: that of a motion, times 40 for the starts and
/// times two for each parameter and step.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/outcome.hpp"
#include "identify/estimate.hpp"
#include "identify/experiments/experiment.hpp"
#include "identify/experiments/rig.hpp"
#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

struct FitOptions {
  bool robust = false;
  bool profile = true;
  bool seeks_loads = true;               ///< of contacts at the first samples (`first_load.hpp`)
  std::vector<RecordValues> known = {};  ///< as in `FitProblem`
  int starts = 0;                        ///< 0: 8 if all parameters have stated values, else 40
  /// Of a search, and of all profiles (`Experiment::work`): some ten minutes of processor time.
  long most_work = 400'000'000;
};

/// Numbers that do not exist are `unknown`.
struct FittedParameter {
  FitParameter parameter;
  double value = 0.0;
  double std = unknown;
  Interval interval95{unknown, unknown};
  Interval profile95{unknown, unknown};
  bool at_bound = false;
  std::string reason;  ///< why a number does not exist
};

/// Parameters that the data cannot separate.
struct TradeOff {
  std::vector<std::string> parameters;
  std::string text;
};

struct FittedSignal {
  SignalRows rows;
  double rms = 0.0;              ///< of the residuals
  double rms_within = 0.0;       ///< the same; of a robust fit, without outliers
  double mean = 0.0;             ///< of the measured signal, minus that of the fit
  double mean_score = 0.0;       ///< mean over its standard error, from samples that count as independent
  double range = 0.0;            ///< rms of the measured signal about its mean
  double noise = unknown;        ///< of the sensor, stated or from the roughness of the signal
  double noise_units = unknown;  ///< rms_within over noise
  double independent = 0.0;      ///< number of samples that count as independent
  double white = 0.0;            ///< the same if the residuals are the noise of the sensor, behind its filter
  double freedom = 0.0;          ///< readings that count, minus the parameters they determine (`freedom.hpp`)
  double p_value = unknown;      ///< chance that the residuals are noise alone (`residual_test.hpp`)
  /// If the noise is stated: variance of the residuals over that of the noise, per degree of freedom; and the
  /// chance of a value so far from 1.
  double chi2_per_freedom = unknown;
  double chi2_p_value = unknown;
  Eigen::VectorXd misses;  ///< outputs minus readings that have a weight
};

struct Fit {
  core::Outcome outcome;
  std::vector<FittedParameter> parameters;
  /// Of the values, without what they may change along `undetermined`. Rows of parameters without a covariance are
  /// zero.
  Eigen::MatrixXd covariance;
  /// Columns: changes of the values that the data do not see. Along these the values have no variance.
  Eigen::MatrixXd undetermined;
  std::vector<TradeOff> not_identifiable;
  std::vector<FittedSignal> signals;
  double noise_units = unknown;       ///< rms_within over noise, of all signals with known noise
  double log_likelihood_count = 0.0;  ///< samples that count as independent
  double deviance = 0.0;              ///< -2 ln of the largest likelihood, without a constant, per sample
  double AICc = unknown;
  int starts = 0;  ///< number of starts that were tried
  Rig rig;         ///< with the fitted values
  std::vector<RecordValues> of_records;
  Eigen::VectorXd outputs;
  Eigen::MatrixXd slopes;  ///< d(outputs)/d(values)
  std::vector<std::string> warnings;
};

/// Fits these parameters of the rig; those of the single records are among them.
[[nodiscard]] Fit fit_rig(const Rig& rig, std::vector<FitParameter> parameters, const Experiments& experiments,
                          const FitOptions& options = {});

/// A rig and what is sought of it.
struct RigToFit {
  Rig rig;
  std::vector<FitParameter> parameters;
};

/// Fits each of these rigs to the same records. When one of them leaves no more than the noise, those that leave
/// three times the noise are not searched from far starts, nor with loads. Only the best by AICc, and what is
/// within 10 of it, has profiles.
[[nodiscard]] std::vector<Fit> fit_rigs(const std::vector<RigToFit>& rigs, const Experiments& experiments,
                                        const FitOptions& options = {});

/// The measured signal of a fitted one.
[[nodiscard]] inline const Signal& signal_of(const Experiments& experiments, const FittedSignal& fitted) {
  return experiments[fitted.rows.experiment]->signals[fitted.rows.signal];
}

/// A parameter of a record among those that were fitted; null if it was not sought.
[[nodiscard]] const FittedParameter* find_of_record(const Fit& fit, std::size_t record, RecordParameter which);

/// rms of the residuals over the rms of the signal, all signals together.
[[nodiscard]] double relative_error(const Fit& fit);

/// rms of the residuals over the rms of the signals, for each experiment; `experiments`: their number.
[[nodiscard]] std::vector<double> relative_errors(const Fit& fit, std::size_t experiments);

/// The uncertainty of the parameters that do not belong to a single record, in their order.
struct SharedUncertainty {
  Eigen::MatrixXd covariance;    ///< as in `Fit`; empty: not known
  Eigen::MatrixXd undetermined;  ///< as in `Fit`; empty: none
};
[[nodiscard]] SharedUncertainty shared_uncertainty(const Fit& fit);

}  // namespace dualdamp::identify
