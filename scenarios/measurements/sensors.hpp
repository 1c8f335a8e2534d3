#pragma once
/// Sensors of a synthetic measurement: their keys, and the sensors that the values describe.

#include <vector>

#include "identify/records/sensors.hpp"
#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

/// The keys of a set of sensors.
[[nodiscard]] std::vector<Field> sensor_fields();

/// The sensors that a section with these keys describes.
[[nodiscard]] identify::Sensors sensors_of(const Json& section);

}  // namespace dualdamp::scenarios
