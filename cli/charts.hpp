#pragma once
/// The commands that draw results: `--plot` and `compare`.

#include <string>
#include <vector>

#include "cli/command_output.hpp"

namespace dualdamp::cli {

/// Draws the main chart of a result directory into an SVG file. Returns a message. Errors: `core::InputError` if
/// there is no result or no chart, `scenarios::OutputError`.
[[nodiscard]] std::string plot_result(const std::string& directory, const std::string& file,
                                      const std::string& units = {});

/// The same after a run. If the result has no chart, a message is added to the output.
void add_plot(CommandOutput& output, const std::string& directory, const std::string& file);

/// Writes a comparison of several result directories to `out`. Returns a message. Errors: as `comparison`, and
/// `scenarios::OutputError`.
[[nodiscard]] std::string compare_results(const std::vector<std::string>& directories, const std::string& out,
                                          const std::string& units);

}  // namespace dualdamp::cli
