#pragma once
/// The truth that the analyses of bench/ depart from: one Coulomb law and damping, and nothing else.

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::bench {

/// Complains where the system is anything else.
void check_truth(scenarios::CheckedFile& file);

}  // namespace dualdamp::bench
