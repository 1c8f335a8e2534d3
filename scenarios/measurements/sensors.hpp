#pragma once
/// Sensors of a synthetic measurement: their keys, and what the values of these say.

#include <vector>

#include "identify/records/sensors.hpp"
#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

/// The keys of a set of sensors.
[[nodiscard]] std::vector<Field> sensor_fields();

/// What a section with these keys says.
[[nodiscard]] identify::Sensors sensors_of(const Json& section);

}  // namespace dualdamp::scenarios
