#pragma once
/// The ranges over friction laws of the method any_law: JSON and tables.

#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/record.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/estimates.hpp"

namespace dualdamp::scenarios {

/// Keys `hull95`, `average95`, `inflation`, `laws` and `aliases` of an estimate.
void add_laws(const identify::LawIntervals& laws, Json& estimate);

/// The laws for a terminal, and as a file.
[[nodiscard]] std::vector<Table> law_tables(const identify::LawIntervals& laws,
                                            const identify::KnownConstants& constants);

[[nodiscard]] ResultFields law_fields();

}  // namespace dualdamp::scenarios
