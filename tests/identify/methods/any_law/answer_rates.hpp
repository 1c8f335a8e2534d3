#pragma once
/// How often the answer of the whole identification holds the truth, on random rigs whose friction, spring or drive
/// departs strongly (severity 1, or the largest below 1): eight levels in three sweeps, amplitudes alone, noise 0.5
/// %.

#include <cstdint>

#include "tests/identify/methods/any_law/law_laboratory.hpp"

namespace dualdamp::identify::testing {

/// Prints one line: how many records have an answer, how many of these hold zeta and F0, how many miss one of both
/// by more than 5 % of the truth, and which methods answered. Then prints a line for each miss.
void print_answers(const identify::departures::Departure& departure, int records, std::uint64_t first);

}  // namespace dualdamp::identify::testing
