#pragma once
/// The commands that draw results: `report`, `--plot` and `compare`.

#include <string>
#include <vector>

#include "cli/command_output.hpp"

namespace dualdamp::cli {

/// Draws the main chart of a result directory into an SVG file. Returns a message. Errors: `core::InputError` if
/// there is no result or no chart, `scenarios::OutputError`.
[[nodiscard]] std::string plot_result(const std::string& directory, const std::string& file,
                                      const std::string& units = {});

/// Draws the main chart of the result of a run into an SVG file. If the result has no chart, a message is added to
/// the output.
void add_plot(CommandOutput& output, const std::string& directory, const std::string& file);

/// Writes the page of a result directory again and, if `plot` names a file, its main chart. Refuses a directory
/// that does not exist. Errors: as `plot_result`; `std::system_error`.
[[nodiscard]] CommandOutput report_on(const std::string& directory, const std::string& units,
                                      const std::string& plot);

/// Writes a comparison of several result directories to `out`. Returns a message. Errors: as `comparison`, and
/// `scenarios::OutputError`.
[[nodiscard]] std::string compare_results(const std::vector<std::string>& directories, const std::string& out,
                                          const std::string& units);

}  // namespace dualdamp::cli
