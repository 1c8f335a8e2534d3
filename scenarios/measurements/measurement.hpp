#pragma once
/// A synthetic measurement of the scenario's system: its keys, its checks, and its conversion for `measure.hpp`.

#include <vector>

#include "identify/record.hpp"
#include "scenarios/format/checked_file.hpp"
#include "scenarios/measurements/measure.hpp"

namespace dualdamp::scenarios {

/// `measurement` and `sensors`.
[[nodiscard]] std::vector<Field> measurement_fields();

/// The measurement and its sensors.
void check_measurement(CheckedFile& file);

/// A record of the kind that the measurement will give. It suffices to decide which methods are possible.
[[nodiscard]] identify::Record outline(const CheckedFile& file);

/// The measurement of a checked section `measurement`.
[[nodiscard]] Measurement measurement_of(const Json& section, const sim::Model& model);

}  // namespace dualdamp::scenarios
