#pragma once
/// Times of steady states.

#include "bench/speed/standard_case.hpp"

namespace dualdamp::bench::speed {

/// Processor seconds for the steady state of the standard case from rest: transient, Newton's method, energy
/// account.
[[nodiscard]] double seconds_for_steady_state(const StandardCase& work);

/// Processor seconds on one core for an x-Y curve of the standard case: `count` amplitudes from 1.05 to 10 times
/// F0/k, sticking ones included.
[[nodiscard]] double seconds_for_curve(const StandardCase& work, int count);

/// Processor seconds on one core for an x-Y curve under lugre (smooth_cases(), the first): `count` amplitudes from
/// 1.5 to 10 times F0/k, motions that creep included.
[[nodiscard]] double seconds_for_smooth_curve(int count);

/// Steady states a second, by the clock, of `count` oscillators that do not stick, in batches on all cores. They
/// surround the standard case: zeta in 0.05..0.35, r in 0.7..1.3, friction at most 0.3 of the drive's force, drawn
/// at random.
[[nodiscard]] double steady_states_per_second(const StandardCase& work, int count);

}  // namespace dualdamp::bench::speed
