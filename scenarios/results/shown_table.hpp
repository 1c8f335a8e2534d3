#pragma once
/// Tables in the units in which results are shown.

#include <cstddef>
#include <set>
#include <string>

#include "scenarios/results/shown_units.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

/// The first rows, with numbers and units as they are shown: of whole columns, of rows whose unit is a text beside
/// the number, of quantities within texts.
[[nodiscard]] Table in_shown_units(const Table& table, const ShownUnits& units, std::size_t rows);

/// The kinds of all quantities of a table.
[[nodiscard]] std::set<std::string> kinds_of(const Table& table);

}  // namespace dualdamp::scenarios
