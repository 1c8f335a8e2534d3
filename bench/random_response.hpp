#pragma once
/// The response to a random drive, beside each curve of a stress test: its keys, what they must be, its motion.
///
/// The drive is a random force on the mass, or the base in random motion, instead of the drive of the curve: its
/// frequency and its harmonics are not there, and no departure of them is. Friction, spring, constants and sensors
/// are those of the case.
///
/// A record holds this history or those of sampled steady states, not both: methods that read histories take all
/// that a record holds, and it would not be clear which ones they are tested by.

#include <cstdint>

#include "bench/stress_test.hpp"
#include "identify/record.hpp"
#include "identify/records/sensors.hpp"
#include "scenarios/format/checked_file.hpp"
#include "scenarios/measurements/measure.hpp"
#include "sim/model.hpp"

namespace dualdamp::bench {

/// `random_response`
[[nodiscard]] scenarios::Field random_response_key();

/// Complains where the analysis asks for a response that is too long, or for sampled steady states beside it.
void check_random_response(scenarios::CheckedFile& file);

/// A history of its kind: enough to tell which methods it allows.
[[nodiscard]] identify::History random_outline(const scenarios::Json& section);

/// What a checked section says.
[[nodiscard]] RandomTest random_test_of(const scenarios::Json& section);

/// The response of a model as perfect sensors see it that come as late as `sensors`; a phase lag is the time that
/// it is at `frequency` [rad/s], that of the curve's drive. Cost: a simulation of settle + duration.
[[nodiscard]] scenarios::MotionRecord random_motion(const RandomTest& test, sim::Model model, std::uint64_t seed,
                                                    const identify::Sensors& sensors, double frequency);

}  // namespace dualdamp::bench
