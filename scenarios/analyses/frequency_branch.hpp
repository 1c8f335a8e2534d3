#pragma once
/// `frequency_branch`: one orbit continued in frequency by arc length.

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] const Analysis& frequency_branch_analysis();

}  // namespace dualdamp::scenarios
