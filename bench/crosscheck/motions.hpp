#pragma once
/// Comparisons of one motion: exact against smooth engine (or explicit against implicit steps), its energy account,
/// its image in the mirror and in other units.

#include <cstdint>

#include "bench/crosscheck/finding.hpp"
#include "scenarios/format/json.hpp"
#include "sim/model.hpp"

namespace dualdamp::crosscheck {

/// Duration of the motion of a drawn scenario [s].
[[nodiscard]] double duration_of(const scenarios::Json& scenario, const sim::Model& model);

/// `draw`: seed of the changes of the data that measure how strongly the motion depends on them.
[[nodiscard]] Findings compare_motions(const scenarios::Json& scenario, std::uint64_t draw);

}  // namespace dualdamp::crosscheck
