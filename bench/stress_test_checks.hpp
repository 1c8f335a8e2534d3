#pragma once
/// What a stress test may ask for, beyond the ranges of single keys.

#include <vector>

#include "bench/departure.hpp"
#include "scenarios/format/checked_file.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::bench {

/// The departures of the section `analysis`: `laws`, then `pairs`.
[[nodiscard]] std::vector<CaseDeparture> departures_of(const scenarios::Json& analysis);

/// Complains of faults, and fills in the departures and methods that the file leaves out.
void check_stress_test(scenarios::CheckedFile& file);

}  // namespace dualdamp::bench
