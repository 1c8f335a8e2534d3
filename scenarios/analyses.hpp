#pragma once
/// The list of the analyses of this library: explicit, one line an analysis, in the order of the reference page.

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] const AnalysisList& analyses();

}  // namespace dualdamp::scenarios
