#pragma once
/// The commands `fit` and `predict` as scenarios: same checks, same messages, same results.

#include "cli/arguments.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// Errors: `core::InputError` with the options that are wrong, or with what is wrong in a data file.
[[nodiscard]] scenarios::Scenario scenario_of(const FitCommand& command);

/// The same; and where the result is none of a fit.
[[nodiscard]] scenarios::Scenario scenario_of(const PredictCommand& command);

}  // namespace dualdamp::cli
