#pragma once
/// What an analysis answers: JSON, tables, warnings; one function a kind of result of `sim` and `identify`.

#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"
#include "scenarios/json.hpp"
#include "scenarios/run.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/continuation.hpp"
#include "sim/orbits/curves.hpp"
#include "sim/orbits/sticking_boundary.hpp"

namespace dualdamp::scenarios {

struct Answer {
  Json result;          ///< null: there is none; null inside: the list is a table of that key
  std::string failure;  ///< why not
  std::vector<std::string> warnings;
  std::vector<Table> tables;
};

[[nodiscard]] Answer answer(const sim::History& history, const sim::Excitation& excitation);
/// `orbit`: samples over one period.
[[nodiscard]] Answer answer(const sim::SteadyState& state, const std::vector<sim::Sample>& orbit,
                            const sim::Excitation& excitation);
[[nodiscard]] Answer answer(const sim::FreeDecay& decay);

enum class CurveOver { amplitude, frequency };

/// `unit` of the amplitudes: m or N.
[[nodiscard]] Answer answer(const sim::Curve& curve, CurveOver over, const std::string& unit);

[[nodiscard]] Answer answer_map(const sim::Curve& map, const std::string& unit);
/// The sticking boundary beside a map.
void add_boundary(Answer& answer, const std::vector<sim::BoundaryPoint>& boundary, const std::string& unit);

[[nodiscard]] Answer answer(const sim::Branch& branch, sim::BranchParameter parameter, const std::string& unit);

[[nodiscard]] Answer answer(const std::vector<identify::Estimate>& estimates, const identify::Record& record);

}  // namespace dualdamp::scenarios
