#pragma once
/// Translates the commands `identify` and `next` to scenarios, so that checks, messages and results are the same.

#include "cli/command_line/arguments.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// Errors: `core::InputError` with the wrong options, or with the faults of the data file.
[[nodiscard]] scenarios::Scenario scenario_of(const IdentifyCommand& command);

/// The analysis `design` for a data file, or for the record of a scenario. Errors: the same.
[[nodiscard]] scenarios::Scenario scenario_of(const NextCommand& command);

}  // namespace dualdamp::cli
