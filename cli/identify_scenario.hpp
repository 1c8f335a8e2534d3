#pragma once
/// The commands `identify` and `next` as scenarios: same checks, same messages, same results.

#include "cli/arguments.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// Errors: `core::InputError` with the options that are wrong, or with what is wrong in the data file.
[[nodiscard]] scenarios::Scenario scenario_of(const IdentifyCommand& command);

/// The analysis `design` of a data file, or of a scenario's record.
[[nodiscard]] scenarios::Scenario scenario_of(const NextCommand& command);

}  // namespace dualdamp::cli
