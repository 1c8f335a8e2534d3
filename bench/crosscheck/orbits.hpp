#pragma once
/// Comparisons of steady states: the monodromy matrix against difference quotients, the orbit against
/// the transient that should end on it.

#include "bench/crosscheck/finding.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::crosscheck {

/// For a scenario with a harmonic drive.
[[nodiscard]] Findings compare_orbits(const scenarios::Scenario& scenario);

}  // namespace dualdamp::crosscheck
