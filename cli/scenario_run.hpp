#pragma once
/// From scenario files to results on the disk: what `run` and the commands about data files do with each of them.
/// Under mpirun all processes take part, and only the first one says anything.

#include <string>

#include "cli/command_line/arguments.hpp"
#include "cli/command_output.hpp"
#include "scenarios/run.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// Meets the other processes of mpirun, if there are any. Errors: `std::runtime_error` if MPI cannot start.
void join_processes();
/// Whether this process prints nothing: of several processes, only the first one prints.
[[nodiscard]] bool is_silent();

/// Errors: `scenarios::OutputError` if results cannot be written there, before anything is computed.
void refuse_unusable(const std::string& directory);
/// The name of the results: the file name without extension.
[[nodiscard]] std::string stem_of(const std::string& file);
[[nodiscard]] std::string output_directory(const RunCommand& command, const std::string& file);

/// The units of `--show-in`, which were checked when the option was read.
void show_in(const std::string& units, scenarios::Scenario& scenario);

/// What `check` says. `directory`: where the results would be written; empty if nothing would be run.
[[nodiscard]] CommandOutput checked(const scenarios::Scenario& scenario, const std::string& directory,
                                    const ResultFiles& files = {});

/// Errors: those of `scenarios::run` and of writing the files.
[[nodiscard]] CommandOutput run_and_write(scenarios::Scenario scenario, scenarios::RunOptions options, bool quiet);

/// One file of `run`. Faults are part of the output.
[[nodiscard]] CommandOutput run_file(const RunCommand& command, const std::string& file);

}  // namespace dualdamp::cli
