#pragma once
/// What comes before the free motion in the records of a fit that nothing drives.

#include <string>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"

namespace dualdamp::scenarios {

/// Leaves out the samples before the release or the blow of records that nothing drives, as `identify` does
/// (identify/records/free_part.hpp), except where `initial` states the state at the first sample. Leaves out the
/// blow of force that histories follow. Returns warnings.
[[nodiscard]] std::vector<std::string> leave_out_holds(std::vector<DataItem>& items, const sim::Model& model,
                                                       bool initial_is_known);

}  // namespace dualdamp::scenarios
