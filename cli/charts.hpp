#pragma once
/// The commands that draw results: `--plot` and `compare`.

#include <string>
#include <vector>

#include "cli/reports.hpp"

namespace dualdamp::cli {

/// Draws the main chart of a result directory into an SVG file; returns what was written. Errors:
/// `core::InputError` where there is none, `scenarios::OutputError`.
[[nodiscard]] std::string plot_result(const std::string& directory, const std::string& file,
                                      const std::string& units = {});

/// The same behind a run, whose results are there already: that they have no chart is one more message.
void add_plot(Report& report, const std::string& directory, const std::string& file);

/// Lays the curves of several result directories over each other; returns what was written to `out`.
[[nodiscard]] std::string compare_results(const std::vector<std::string>& directories, const std::string& out,
                                          const std::string& units);

}  // namespace dualdamp::cli
