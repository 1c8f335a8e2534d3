#pragma once
/// Gross faults of signs in records that `gross_faults` (identify/records/plausibility.hpp) does not read: pairs
/// under a driving force, and friction loops. The energy that a force gives to a motion has one sign.
///
/// Errors: none thrown. Cost: linear.

#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/setting.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Of pairs under a driving force of amplitude Y [N]: the signs of the phases.
[[nodiscard]] std::vector<core::Diagnostic> gross_faults_under_force(const PairRecord& pairs,
                                                                     const KnownConstants& constants,
                                                                     const std::string& file,
                                                                     const core::SettingWords& words = {});

/// Of friction loops, whose force moves the mass along the measured motion: the sign of the force.
[[nodiscard]] std::vector<core::Diagnostic> gross_faults_of_loops(const Record& record,
                                                                  const KnownConstants& constants,
                                                                  const std::string& file,
                                                                  const core::SettingWords& words = {});

}  // namespace dualdamp::identify
