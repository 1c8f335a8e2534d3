#pragma once
/// Readings that do not belong to the others, and what 1 % of each constant does, in a result.

#include <vector>

#include "identify/ledger/outliers.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/motion.hpp"

namespace dualdamp::scenarios {

/// `bounded`: their influence is.
void add_outliers(const std::vector<identify::Outlier>& outliers, bool bounded, Answer& answer);

void add_sensitivities(const std::vector<identify::Sensitivity>& sensitivities, Answer& answer);

[[nodiscard]] ResultFields outlier_fields();

}  // namespace dualdamp::scenarios
