#pragma once
/// Zeros of the sensors of the records of a fit.

#include <string>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"

namespace dualdamp::scenarios {

/// Subtracts zeros of x that are larger than the displacement at which friction can hold the mass, as `identify`
/// does, except for records whose `offset` is fitted. Returns warnings.
[[nodiscard]] std::vector<std::string> remove_zeros(std::vector<DataItem>& items, const sim::Model& model,
                                                    const Sought& sought);

}  // namespace dualdamp::scenarios
