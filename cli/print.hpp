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

}  // namespace dualdamp::cli
