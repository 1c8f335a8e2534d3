#pragma once
/// Results as text for the terminal: aligned tables with units.

#include <string>
#include <vector>

#include "scenarios/run.hpp"

namespace dualdamp::cli {

/// The result as text: title, single numbers, lists, and the comparison with expected values.
[[nodiscard]] std::string readable(const scenarios::Scenario& scenario, const scenarios::RunResult& result);

/// Rows of texts as aligned columns, two blanks apart.
[[nodiscard]] std::string columns(const std::vector<std::vector<std::string>>& rows);

/// Aligned columns whose cells are sentences: a long cell takes several lines.
[[nodiscard]] std::string folded_columns(const std::vector<std::vector<std::string>>& rows);

/// Shows the progress of a long run as one line on the terminal, which each call overwrites.
void show(const scenarios::Progress& progress);

}  // namespace dualdamp::cli
