#pragma once
/// Estimates of identification methods as an answer: JSON, tables, and the combined answer.

#include <string>

#include "identify/answer/answer.hpp"
#include "identify/estimate.hpp"
#include "identify/record.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/motion.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] Answer answer_of(const identify::Identification& found, const identify::Record& record,
                               const identify::KnownConstants& constants);

/// {zeta, c, x_f, F0}; null if there is none.
[[nodiscard]] Json parameters_json(const identify::ParameterSet& set);
[[nodiscard]] Json interval_json(const identify::ParameterIntervals& intervals);
/// The four parameters under `prefix`.
[[nodiscard]] ResultFields parameter_fields(const std::string& prefix, const std::string& suffix,
                                            const std::string& what);

[[nodiscard]] ResultFields estimate_fields();

}  // namespace dualdamp::scenarios
