#pragma once
/// A record like a measured one whose truth is known: free of noise it obeys
///
///   m a + c v + F0 sgn v + k (x - y) + offset = f
///
/// exactly, with friction that is the same at rest, and its motion stays close to the measured one; beside it the
/// noise of the measured signals.
///
/// Motion of the synthetic record: that of a system with these parameters under the recorded drive
/// (`sampled_oscillator.hpp`), from the initial state that brings it closest to the record. A mass that would
/// drift, having no spring, or move more than a tenth beside the record, is held to it by a spring and damper,
/// whose force is added to the synthetic record's. Noise of x, v and a: what is left of them beside the synthetic
/// motion, at high frequency, where the law plays no part. Noise of y and force: their own at high frequency; at
/// most what the balance of forces leaves there, and what would move the synthetic mass as far as it lies beside
/// the record.
///
/// Cost: about 2 us a sample; of a synthetic record, 50 ns a sample and noisy signal.

#include <cstdint>
#include <optional>
#include <vector>

#include "identify/models/force_parameters.hpp"
#include "identify/record.hpp"
#include "identify/records/sensors.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

/// Seed from the record itself (FNV-1a over the bits of x): another record has other draws, so that over many
/// records an interval holds as often as its t quantile says.
[[nodiscard]] std::uint64_t seed_of(const std::vector<NumberedHistory>& histories);

struct SyntheticRecords {
  Record exact;
  Sensors sensors;
  std::uint64_t seed = 0;  ///< from the measured record

  /// With noise: other noise for each number, the same at every call.
  [[nodiscard]] Record record(int number) const;
};

/// Parameters that drive instead of damp count as zero in the synthetic record, and `truth` is set so.
/// Nothing when the law with these parameters does not follow the measured motion.
[[nodiscard]] std::optional<SyntheticRecords> synthetic_records(const std::vector<NumberedHistory>& histories,
                                                                ForceParameters& truth, double offset);

}  // namespace dualdamp::identify
