#pragma once
/// Readings that do not agree with the others, and the effect of 1 % of each constant, as parts of a result.

#include <vector>

#include "identify/outliers/outliers.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/motion.hpp"

namespace dualdamp::scenarios {

/// `bounded`: whether their influence is limited.
void add_outliers(const std::vector<identify::Outlier>& outliers, bool bounded, Answer& answer);

void add_sensitivities(const std::vector<identify::Sensitivity>& sensitivities, Answer& answer);

[[nodiscard]] ResultFields outlier_fields();

}  // namespace dualdamp::scenarios
