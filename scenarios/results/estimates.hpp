#pragma once
/// Estimates of identification methods as an answer: JSON, tables, and what they say together.

#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/motion.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] Answer answer_of(const std::vector<identify::Estimate>& estimates, const identify::Record& record);

[[nodiscard]] ResultFields estimate_fields();

}  // namespace dualdamp::scenarios
