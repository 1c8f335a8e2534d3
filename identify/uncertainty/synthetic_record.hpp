#pragma once
/// A record like a measured one, whose truth is known. Without noise it obeys
///
///   m a + c v + F0 sgn v + k (x - y) + offset = f
///
/// exactly, with static friction F0, and its motion is close to the measured one. The noise of the measured signals
/// is added to it.
///
/// Motion: that of a system with these parameters under the recorded drive (`sampled_oscillator.hpp`), from the
/// initial state that brings it closest to the record. A mass without a spring would drift, and a mass may differ
/// from the record by more than a tenth. Such a mass is held to the record by a spring and a damper, whose force is
/// added to the force of the synthetic record.
///
/// Noise of x, v and a: the difference between record and synthetic motion at high frequency, where the law plays
/// no part. Noise of y and force: their own at high frequency, with two upper bounds: what the balance of forces
/// leaves there, and what would move the synthetic mass as far as it differs from the record.
///
/// Rounding of x, v and a: to the steps of the converters that the measured signals show, each with its zero at
/// random between two steps.
///
/// Cost: about 2 us a sample, and for each synthetic record 50 ns a sample and noisy signal.

#include <cstdint>
#include <optional>
#include <vector>

#include "identify/models/force_parameters.hpp"
#include "identify/record.hpp"
#include "identify/records/sensors.hpp"
#include "identify/records/usable_histories.hpp"

namespace dualdamp::identify {

/// Seed from the record itself (FNV-1a over the bits of x). Different records have different draws, so that over
/// many records the intervals have the coverage of their t quantile.
[[nodiscard]] std::uint64_t seed_of(const std::vector<NumberedHistory>& histories);

struct SyntheticRecords {
  Record exact;
  Sensors sensors;
  std::uint64_t seed = 0;  ///< from the measured record

  /// The record with noise: other noise for each number, the same at every call.
  [[nodiscard]] Record record(int number) const;
};

/// Where a motion begins, and where between two samples its drive steps.
struct MotionStart {
  double x0 = 0.0;  ///< m
  double v0 = 0.0;  ///< m/s
  std::vector<double> places = {};
};

/// `starts`: the initial states of a fit of the motion, one for each history; the synthetic motion is that of the
/// fit then, and rests where it rests. Empty: the states that bring the motion closest to the record. A negative c
/// or F0 is set to zero, in `truth` as well. Nothing if the law with these parameters does not follow the measured
/// motion.
[[nodiscard]] std::optional<SyntheticRecords> synthetic_records(const std::vector<NumberedHistory>& histories,
                                                                ForceParameters& truth, double offset,
                                                                const std::vector<MotionStart>& starts = {});

}  // namespace dualdamp::identify
