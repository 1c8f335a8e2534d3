#pragma once
/// What to do for a planned measurement, in numbers: levels, frequencies, repetitions, waiting and sampling.

#include <string>

#include "core/coordinate.hpp"
#include "identify/design/candidate.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/shown_units.hpp"

namespace dualdamp::scenarios {

/// The rig, as far as the times of a plan depend on it.
struct PlannedRig {
  double natural = 0.0;  ///< natural frequency [rad/s]
  double zeta = 0.0;     ///< damping ratio, about; not above 0: not known
  core::Coordinate coordinate = core::Coordinate::displacement;
};

/// "8 states: Y = 4 mm, 5 mm, ... at 6.17 Hz; wait 1.5 s after each change; read x and its phase to y", in the
/// units of the user.
[[nodiscard]] std::string instruction_of(const identify::CandidateMeasurement& candidate, const PlannedRig& rig,
                                         const ShownUnits& units);

/// The same numbers, SI: `states` with `Y`, `omega` and `times`, and `settle`; or `release`, `extremes`, `duration`
/// and `sample_rate`.
[[nodiscard]] Json plan_json(const identify::CandidateMeasurement& candidate, const PlannedRig& rig);

}  // namespace dualdamp::scenarios
