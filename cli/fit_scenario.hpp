#pragma once
/// Translates the commands `fit` and `predict` to scenarios, so that checks, messages and results are the same.

#include "cli/command_line/arguments.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// Errors: `core::InputError` with the wrong options, or with the faults of a data file.
[[nodiscard]] scenarios::Scenario scenario_of(const FitCommand& command);

/// Errors: the same; also `core::InputError` if the result is not that of a fit.
[[nodiscard]] scenarios::Scenario scenario_of(const PredictCommand& command);

}  // namespace dualdamp::cli
