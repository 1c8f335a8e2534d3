#pragma once
/// Results for people: aligned tables with units.

#include <string>
#include <vector>

#include "scenarios/run.hpp"

namespace dualdamp::cli {

/// Title, single numbers, lists and the comparison with expected values.
[[nodiscard]] std::string readable(const scenarios::Scenario& scenario, const scenarios::RunResult& result);

/// Rows of texts in columns two blanks apart.
[[nodiscard]] std::string columns(const std::vector<std::vector<std::string>>& rows);

/// How far a long run is: a line on a terminal that is written over and over.
void show(const scenarios::Progress& progress);

}  // namespace dualdamp::cli
