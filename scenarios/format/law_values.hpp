#pragma once
/// Conversion between the JSON of a law in a resolved scenario and the values of its parameters.

#include "friction_models/parameters.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// The parameters of `table` that `section` has; other keys are ignored.
[[nodiscard]] friction::ParameterValues law_values(const std::vector<friction::Parameter>& table,
                                                   const Json& section,
                                                   core::Coordinate coordinate = core::Coordinate::displacement);

/// In the order of `table`.
[[nodiscard]] Json law_json(const std::vector<friction::Parameter>& table, const friction::ParameterValues& values);

}  // namespace dualdamp::scenarios
