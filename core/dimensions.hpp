#pragma once
/// The quantities of scenarios and data files: their names in messages, and their usual units.

#include <string_view>
#include <vector>

#include "core/coordinate.hpp"

namespace dualdamp::core {

struct Dimension {
  std::string_view si_unit;
  std::string_view noun;                ///< "a mass"
  std::string_view example;             ///< "5 kg"
  std::vector<std::string_view> units;  ///< named in messages and pages; other units are converted too
};

/// The dimension with this SI unit, as stated for a displacement; nullptr where the table does not hold it.
[[nodiscard]] const Dimension* find_dimension(std::string_view si_unit, Coordinate coordinate);
/// Whether the table for displacements holds this SI unit.
[[nodiscard]] bool is_dimension(std::string_view si_unit);

}  // namespace dualdamp::core
