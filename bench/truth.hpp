#pragma once
/// The truth of the analyses of bench/: one Coulomb law and viscous damping, and nothing else.

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::bench {

/// Complains where the system is anything else.
void check_truth(scenarios::CheckedFile& file);

/// Complains where an option or a sweep names the amplitude of the drive, which the levels of the analysis replace;
/// a scenario may state it for other analyses.
void refuse_replaced_amplitude(scenarios::CheckedFile& file);

}  // namespace dualdamp::bench
