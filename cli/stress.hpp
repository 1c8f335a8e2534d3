#pragma once
/// The commands `stress export` and `stress score`.

#include <string>

#include "cli/command_line/arguments.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// Writes the records of a stress test and the key. Returns a message. Errors: `core::InputError`, also for a
/// scenario that is no stress test; `scenarios::OutputError`.
[[nodiscard]] std::string export_stress_test(const ExportCommand& command);

/// The scenario of a score: with the seed of the key, and with the answers as entries. Errors: `core::InputError`,
/// also for the key of another stress test.
[[nodiscard]] scenarios::Scenario scenario_of(const ScoreCommand& command);

}  // namespace dualdamp::cli
