#pragma once
/// How often the intervals of each method hold the truth where mass, stiffness and the gain of x are uncertain, and
/// are drawn as their uncertainties say.

#include <cstdint>

#include "tests/identify/ledger/laboratory.hpp"

namespace dualdamp::identify::testing {

/// One line a method: n, and the coverage of zeta and F0 in percent. 1 % each of m, k and the gain of x.
void print_uncertain_rates(Kind kind, int records, std::uint64_t first_seed);

}  // namespace dualdamp::identify::testing
