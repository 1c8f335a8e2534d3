#pragma once
/// What the table of a law says about its parameters, tried out: each value beyond its range, not finite, missing
/// or unknown must be refused, with the value and the range.

#include <vector>

#include "friction_models/parameters.hpp"
#include "sim/conformance/faults.hpp"

namespace dualdamp::sim {

/// Adds what is wrong with `table`, starting from `values`, which it should accept.
void examine_parameters(const std::vector<friction::Parameter>& table, const friction::ParameterValues& values,
                        Faults& faults);

}  // namespace dualdamp::sim
