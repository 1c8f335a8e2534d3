#pragma once
/// The scenario format as a table of keys. Contract: docs/user-guide.md.

#include "scenarios/analysis.hpp"
#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

inline constexpr std::string_view schema_name = "dualdamp/1";

/// The keys of a scenario whose `analysis` is one of these.
[[nodiscard]] Section scenario_format(const AnalysisList& analyses);

}  // namespace dualdamp::scenarios
