#pragma once
/// Values of a checked scenario or of a result, and its numbers as the reader returns them: SI, frequencies with
/// their unit.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// The value at a path such as `sticks[0].start`; null pointer: there is none. An index in the path is a number.
[[nodiscard]] const Json* find_value(const Json& json, std::string_view path);

[[nodiscard]] double number(const Json& value);

/// The number under `key`, or `fallback` if there is none.
[[nodiscard]] double number_or(const Json& section, const std::string& key, double fallback);

/// The unit of a quantity as the user wrote it: "um" of "3 um"; empty if there is none, or if the text has an
/// uncertainty.
[[nodiscard]] std::string written_unit(std::string_view quantity);

/// Stores the unit of the quantity at a path; for a list that of its first item with a unit, under the list's path.
void note_unit(const std::string& path, std::string_view quantity, std::map<std::string, std::string>& units);

/// The values of a list, or of a grid {from, to, count, spacing}.
[[nodiscard]] std::vector<double> grid_values(const Json& grid);

/// Number of these values.
[[nodiscard]] std::size_t grid_size(const Json& grid);

/// Time that `section` asks for by `duration` or by `cycles`, which are periods of the forcing [s].
/// `frequency` [rad/s].
[[nodiscard]] double duration_of(const Json& section, double frequency);

}  // namespace dualdamp::scenarios
