#pragma once
/// A law's parameters between the JSON of a resolved scenario and the values the law is made of.

#include "friction_models/parameters.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// Those of `table` that `section` has; other keys of it are left alone.
[[nodiscard]] friction::ParameterValues law_values(const std::vector<friction::Parameter>& table,
                                                   const Json& section,
                                                   core::Coordinate coordinate = core::Coordinate::displacement);

/// In the order of `table`.
[[nodiscard]] Json law_json(const std::vector<friction::Parameter>& table, const friction::ParameterValues& values);

}  // namespace dualdamp::scenarios
