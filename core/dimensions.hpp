#pragma once
/// The quantities that scenarios and data files hold: what they are called in messages, and their usual units.

#include <string_view>
#include <vector>

#include "core/coordinate.hpp"

namespace dualdamp::core {

struct Dimension {
  std::string_view si_unit;
  std::string_view noun;                ///< "a mass"
  std::string_view example;             ///< "5 kg"
  std::vector<std::string_view> units;  ///< that messages and pages name; others are converted too
};

/// By the SI unit of a displacement's quantity; nothing where the table does not hold it.
[[nodiscard]] const Dimension* find_dimension(std::string_view si_unit, Coordinate coordinate);
/// Of the table for displacements alone.
[[nodiscard]] bool is_dimension(std::string_view si_unit);

}  // namespace dualdamp::core
