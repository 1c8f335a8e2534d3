#pragma once
/// How often the intervals of each method hold the truth if mass, stiffness, frequency and the gains of the sensors
/// have random errors of the stated uncertainties.

#include <cstdint>

#include "tests/identify/ledger/laboratory.hpp"

namespace dualdamp::identify::testing {

/// Prints one line for each method: how many of its records gave an interval, and the coverage of zeta, c and F0 in
/// percent. `deviation`: relative standard uncertainty of m, k, the frequency (a fifth of it) and each gain; 0: the
/// constants are exact.
void print_uncertain_rates(Kind kind, double deviation, int records, std::uint64_t first_seed);

}  // namespace dualdamp::identify::testing
