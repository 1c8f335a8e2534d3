#pragma once
/// The response to a random drive, beside each curve of a stress test: its keys, their checks, its motion.
///
/// A random force on the mass, or a random motion of the base, replaces the drive of the curve. So the frequency
/// and the harmonics of the curve's drive, and departures of them, have no effect. Friction, spring, constants and
/// sensors are those of the case.
///
/// A record holds either this history or those of sampled steady states: methods that read histories take all
/// histories of a record, and it would not be clear which of them a score is about.

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

/// An outline of such a history, from which follows which methods can read it.
[[nodiscard]] identify::History random_outline(const scenarios::Json& section);

/// The test of a checked section.
[[nodiscard]] RandomTest random_test_of(const scenarios::Json& section);

/// The response of a model as seen by perfect sensors with the delays of `sensors`. A phase lag becomes the delay
/// that it is at `frequency` [rad/s], that of the curve's drive. Cost: a simulation of settle + duration.
[[nodiscard]] scenarios::MotionRecord random_motion(const RandomTest& test, sim::Model model, std::uint64_t seed,
                                                    const identify::Sensors& sensors, double frequency);

}  // namespace dualdamp::bench
