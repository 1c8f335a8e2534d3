#pragma once
/// All analyses, those of scenarios/ and those of bench/, in the order of the reference page.
///
///     scenarios::run(scenarios::load_scenario("rig.yaml", {.analyses = bench::analyses()}))

#include "scenarios/analysis.hpp"

namespace dualdamp::bench {

[[nodiscard]] const scenarios::AnalysisList& analyses();

}  // namespace dualdamp::bench
