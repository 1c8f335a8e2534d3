#pragma once
/// From a fit to predictions: the keys of the analysis `predict` that the result of a fit states.

#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// {type, fitted_readings, free, covariance, undetermined}: what was fitted, the parameters that all records
/// share, and their uncertainty. A prediction fits those of a single record anew. `result`: of the analysis `fit`.
/// Errors: `Json::exception` if a key of a fit is missing or has another type.
[[nodiscard]] Json prediction_keys(const Json& result);

}  // namespace dualdamp::scenarios
