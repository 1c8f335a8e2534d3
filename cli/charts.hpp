#pragma once
/// The commands that draw results: `report`, `--plot` and `compare`; and `--mat`, which writes their tables.

#include <string>
#include <vector>

#include "cli/command_line/arguments.hpp"
#include "cli/command_output.hpp"

namespace dualdamp::cli {

/// Draws the main chart of a result directory into an SVG file. Returns a message. Errors: `core::InputError` if
/// there is no result or no chart, `scenarios::OutputError`.
[[nodiscard]] std::string plot_result(const std::string& directory, const std::string& file,
                                      const std::string& units = {});

/// Writes the tables of a result directory into a MATLAB file (`scenarios/results/mat_file.hpp`). Returns a
/// message. Errors: `core::InputError` if there is no result or a table was changed, `scenarios::OutputError`.
[[nodiscard]] std::string export_result(const std::string& directory, const std::string& file);

/// Both after a run, if they are asked for. If the result has no chart, a message is added to the output.
void add_files(CommandOutput& output, const std::string& directory, const ResultFiles& files);

/// Writes the page of a result directory again and the files that are asked for. Refuses a directory that does not
/// exist. Errors: as `plot_result`; `std::system_error`.
[[nodiscard]] CommandOutput report_on(const std::string& directory, const std::string& units,
                                      const ResultFiles& files);

/// Writes a comparison of several result directories to `out`. Returns a message. Errors: as `comparison`, and
/// `scenarios::OutputError`.
[[nodiscard]] std::string compare_results(const std::vector<std::string>& directories, const std::string& out,
                                          const std::string& units);

}  // namespace dualdamp::cli
