#pragma once
/// Parts of an answer about motions that several analyses use, each with the fields that describe it.

#include <string>
#include <vector>

#include "core/crossing/first_crossing.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/format/result_field.hpp"
#include "scenarios/results/table.hpp"
#include "sim/motion/simulate.hpp"

namespace dualdamp::scenarios {

using ResultFields = std::vector<ResultField>;

/// The lists, one after the other.
[[nodiscard]] ResultFields joined(ResultFields first, const ResultFields& second);

/// The energy balance.
[[nodiscard]] Json energy_json(const sim::Energy& energy);
[[nodiscard]] ResultFields energy_fields();

/// The certificate of the search for events; nothing for the smooth engine.
void add_certificate(Json& result, const sim::Model& model, const core::SearchCount& count);
[[nodiscard]] ResultFields certificate_fields();

/// Why a steady state has no phase.
[[nodiscard]] std::string why_no_phase(const sim::Model& model, bool never_moves);

/// Samples of a motion, with a column for its drive.
[[nodiscard]] Table history_table(std::string name, const std::vector<sim::Sample>& samples,
                                  const sim::Excitation& excitation);

/// "m" or "N": the unit of the excitation's amplitude.
[[nodiscard]] std::string amplitude_unit(const sim::Excitation& excitation);

}  // namespace dualdamp::scenarios
