#pragma once
/// Records: what a laboratory measures, whether it came from a file or from the simulator.
///
/// A method gets a record and the constants a laboratory would know (`KnownConstants`), never the system that
/// produced it.

#include <optional>
#include <string>
#include <vector>

namespace dualdamp::identify {

/// Constants a laboratory knows before the test. SI.
struct KnownConstants {
  double mass = 0.0;       ///< m [kg], > 0
  double stiffness = 0.0;  ///< k [N/m], > 0
  double frequency = 0.0;  ///< forcing frequency w [rad/s], > 0; unused by free_decay
};

/// One measured input-output amplitude pair at one frequency.
struct Pair {
  double Y = 0.0;     ///< input amplitude [m]
  double x = 0.0;     ///< output amplitude [m]
  std::string sweep;  ///< label of the sweep it belongs to; may be empty
  /// Number of the pair in the record, from 1: what messages and exclusion lists name.
  int number = 0;
};

/// x-Y pairs at one frequency.
struct PairRecord {
  std::vector<Pair> pairs;
};

/// Extremes of a free vibration: signed turning points in order of time, about an unknown offset.
struct DecayRecord {
  std::vector<double> extremes;  ///< m
  std::vector<double> times;     ///< s, increasing, one for each extreme; empty when they were not measured
};

/// A record holds what was measured; absent kinds are empty optionals.
struct Record {
  std::optional<PairRecord> pairs;
  std::optional<DecayRecord> decay;
};

}  // namespace dualdamp::identify
