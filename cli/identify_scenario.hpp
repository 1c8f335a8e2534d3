#pragma once
/// The command `identify` as a scenario: same checks, same messages, same results.

#include "cli/arguments.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// Errors: `core::InputError` with the options that are wrong, or with what is wrong in the data file.
[[nodiscard]] scenarios::Scenario scenario_of(const IdentifyCommand& command);

}  // namespace dualdamp::cli
