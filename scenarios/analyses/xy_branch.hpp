#pragma once
/// `xy_branch`: one orbit continued in input amplitude by arc length.

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] const Analysis& xy_branch_analysis();

}  // namespace dualdamp::scenarios
