#pragma once
/// Test of a law's parameter table: a value that is out of its range, not finite, missing or unknown must be
/// refused, with the value and the range.

#include <vector>

#include "friction_models/parameters.hpp"
#include "sim/conformance/faults.hpp"

namespace dualdamp::sim {

/// Adds the faults of `table` to the list. `values` must be accepted; the test changes one value at a time.
void examine_parameters(const std::vector<friction::Parameter>& table, const friction::ParameterValues& values,
                        Faults& faults);

}  // namespace dualdamp::sim
