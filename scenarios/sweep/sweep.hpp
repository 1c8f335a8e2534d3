#pragma once
/// A scenario with a `sweep`: its analysis is repeated for each value of one number of the file, or for each pair
/// of values of two.
///
/// Point number i is the scenario that an override PATH=VALUE gives, and its numbers are bit for bit those of that
/// run. All points are read and checked before the first one runs. The first key varies slowest.
///
/// The run is a campaign: finished points are kept in `points.jsonl` and can be resumed. The result is the list
/// `sweep` of {values (SI, by path), status, result, and where there are any reason, warnings, verification}; see
/// `answer.hpp` for the tables.

#include <string>

#include "scenarios/format/tree.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::scenarios {

/// For a document with a section `sweep`. Errors: `core::InputError` with all problems of all points; a problem of
/// some points only names the first value for which it occurs.
[[nodiscard]] Scenario swept_scenario(Document document, const std::string& name, const LoadOptions& options);

}  // namespace dualdamp::scenarios
