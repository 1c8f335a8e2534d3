#pragma once
/// How fast a motion under a drive of many samples is computed.

#include "bench/speed/standard_case.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::bench::speed {

/// Processor seconds on one core for `sim::simulate` of the standard case under `count` samples of its base motion,
/// 628 in a period, with energy account and certificate; the samples' own preparation is part of it.
[[nodiscard]] double seconds_for_sampled_drive(const StandardCase& work, int count,
                                               sim::Interpolation interpolation);

}  // namespace dualdamp::bench::speed
