#pragma once
/// Structural damping in fits and predictions.

#include <string>
#include <vector>

#include "identify/experiments/experiment.hpp"
#include "scenarios/analyses/shared/fit_setup.hpp"

namespace dualdamp::scenarios {

/// Complains about a loss factor, stated or sought, that the records or the damper exclude: it has no motion in
/// time, and the system has one damper. `key`: of the records, below `analysis`.
void check_structural_damping(const identify::Rig& rig, const std::vector<identify::FitParameter>& sought,
                              const identify::Experiments& experiments, const std::string& key,
                              std::vector<SetupFault>& faults);

}  // namespace dualdamp::scenarios
