#pragma once
/// How often the intervals of each method hold the truth where mass, stiffness, frequency and the gains of the
/// sensors are uncertain, and are drawn as their uncertainties say.

#include <cstdint>

#include "tests/identify/ledger/laboratory.hpp"

namespace dualdamp::identify::testing {

/// One line a method: how many of the records it was run on gave an interval, and the coverage of zeta, c and F0 in
/// percent. `deviation`: relative standard uncertainty of m, k, the frequency (a fifth of it) and each gain; 0: the
/// constants are exact.
void print_uncertain_rates(Kind kind, double deviation, int records, std::uint64_t first_seed);

}  // namespace dualdamp::identify::testing
