#pragma once
/// A drift of friction that a record cannot distinguish from friction over speed.
///
/// In free vibrations from one amplitude, the amplitude falls with time. The work of friction in a swing is a
/// function of the amplitude if friction depends on speed, and a function of time if friction drifts: every falling
/// course of the amplitude makes one of the other. Which relaxation fits better shows only which of a few forms is
/// nearer, so friction over speed is named with every such drift.

#include <vector>

#include "identify/ledger/relaxation_tests.hpp"

namespace dualdamp::identify {

/// Adds to a departure with such a drift the term of friction over speed that explains most, with the changes of
/// the linear model, if it has none yet.
void name_speed_beside_drift(const JointModel& model, const std::vector<RelaxationTest>& tests,
                             FoundDeparture& departure);

}  // namespace dualdamp::identify
