#pragma once
/// Comparison of a result with the values a scenario expects.

#include <vector>

#include "scenarios/format/json.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::scenarios {

/// `result` without the lists that are `tables`.
/// Errors: `core::InputError` for a path that is not in the result.
[[nodiscard]] std::vector<Check> compare(const std::vector<Expectation>& expectations, const Json& result,
                                         const std::vector<Table>& tables);

}  // namespace dualdamp::scenarios
