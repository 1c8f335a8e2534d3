#pragma once
/// The answer of an identification and its ledger of assumptions: JSON and tables.

#include "identify/answer/answer.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/estimates.hpp"

namespace dualdamp::scenarios {

/// Keys `answer`, `answer_reason`, `assumptions`, `family_level`, `verdict`, and the tables.
void add_ledger(const identify::Identification& found, Answer& answer);

[[nodiscard]] ResultFields ledger_fields();

}  // namespace dualdamp::scenarios
