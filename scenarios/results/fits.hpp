#pragma once
/// A fit as an answer: JSON and tables.

#include <string>

#include "identify/fit/fit.hpp"
#include "identify/fit/prediction.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/motion.hpp"

namespace dualdamp::scenarios {

/// Keys `parameters`, `not_identifiable`, `residual`, `signals`, `covariance`, and the table of parameters.
void add_fit(const identify::Fit& fit, const identify::Experiments& experiments, Answer& answer);

/// Of the residuals of the first signal.
[[nodiscard]] std::string residual_unit(const identify::Fit& fit, const identify::Experiments& experiments);

/// Measured and fitted values, one table for each signal of each record, named PREFIX_RECORD_SIGNAL.
void add_curves(const identify::Fit& fit, const identify::Experiments& experiments, const std::string& prefix,
                Answer& answer);

/// `validation`.
[[nodiscard]] Json validation_json(const identify::Prediction& prediction);

[[nodiscard]] ResultFields fit_fields();
/// `prefix`: path of the validation in the result.
[[nodiscard]] ResultFields validation_fields(const std::string& prefix);

}  // namespace dualdamp::scenarios
