#pragma once
/// The scenario format as a table of keys. Contract: docs/user-guide.md.

#include "scenarios/analysis.hpp"
#include "scenarios/format/keys.hpp"
#include "scenarios/format/limits.hpp"

namespace dualdamp::scenarios {

/// The keys of a scenario whose `analysis` is one of these.
[[nodiscard]] Section scenario_format(const AnalysisList& analyses);

}  // namespace dualdamp::scenarios
