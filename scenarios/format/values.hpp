#pragma once
/// Numbers of a checked scenario as the reader returns them: SI, frequencies with their unit.

#include <cstddef>
#include <string>
#include <vector>

#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] double number(const Json& value);

/// The number under `key`, or `fallback` where there is none.
[[nodiscard]] double number_or(const Json& section, const std::string& key, double fallback);

/// The values of a list, or of a grid {from, to, count, spacing}.
[[nodiscard]] std::vector<double> grid_values(const Json& grid);

/// How many they are.
[[nodiscard]] std::size_t grid_size(const Json& grid);

/// Time that `section` asks for by `duration` or by `cycles`, which are periods of the forcing [s].
/// `frequency` [rad/s].
[[nodiscard]] double duration_of(const Json& section, double frequency);

}  // namespace dualdamp::scenarios
