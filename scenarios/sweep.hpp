#pragma once
/// A scenario with a `sweep`: its question asked once for each value of a number of the file, or for each pair of
/// values of two.
///
/// Point number i is the scenario that `--set PATH=VALUE` would make of the file, and its numbers are those of that
/// run, bit for bit. All points are read and checked before the first one runs. The first key varies slowest.
///
/// The run is a campaign: finished points are kept in `points.jsonl` and can be resumed. The result is the list
/// `sweep` of {values (SI, by path), status, result, and where there are any reason, warnings, verification}; see
/// `sweep_answer.hpp` for the tables.

#include <string>

#include "scenarios/format/tree.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::scenarios {

/// A document that has the section `sweep`. Errors: `core::InputError` with all problems of all points; one that
/// not all points have names the first value that has it.
[[nodiscard]] Scenario swept_scenario(Document document, const std::string& name, const LoadOptions& options);

}  // namespace dualdamp::scenarios
