#pragma once
/// Sensors of a synthetic measurement: their keys, and the sensors that the values describe.

#include <string>
#include <vector>

#include "identify/records/sensors.hpp"
#include "scenarios/format/checked_file.hpp"
#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

/// The keys of a set of sensors.
[[nodiscard]] std::vector<Field> sensor_fields();

/// Refuses outliers of which the section at this path states only the spacing or only the size.
void check_outliers(CheckedFile& file, const std::string& path);

/// The sensors that a section with these keys describes.
[[nodiscard]] identify::Sensors sensors_of(const Json& section);

}  // namespace dualdamp::scenarios
