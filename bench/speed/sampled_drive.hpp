#pragma once
/// Time of a motion under a drive of many samples.

#include "bench/speed/standard_case.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::bench::speed {

/// Processor seconds on one core for `sim::simulate` of the standard case under `count` samples of its base motion,
/// 628 in a period, with energy account and certificate, including the preparation of the samples.
[[nodiscard]] double seconds_for_sampled_drive(const StandardCase& work, int count,
                                               sim::Interpolation interpolation);

}  // namespace dualdamp::bench::speed
