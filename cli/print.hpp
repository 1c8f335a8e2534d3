#pragma once
/// Results for people: aligned tables with units.

#include <string>

#include "scenarios/run.hpp"

namespace dualdamp::cli {

/// Title, single numbers, lists and the comparison with expected values.
[[nodiscard]] std::string readable(const scenarios::Scenario& scenario, const scenarios::RunResult& result);

/// Columns of `table` side by side under their names, two blanks apart. Long tables are cut.
[[nodiscard]] std::string readable(const scenarios::Table& table);

}  // namespace dualdamp::cli
