#pragma once
/// Measurements that could follow a record, for the advice to compare.

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// A steady state to be measured.
struct PlannedState {
  double Y = 0.0;      ///< input amplitude [m]
  double omega = 0.0;  ///< rad/s

  bool operator==(const PlannedState&) const = default;
};

/// A release from rest, whose extremes are read.
struct PlannedDecay {
  double release = 0.0;  ///< m
  int extremes = 0;

  bool operator==(const PlannedDecay&) const = default;
};

using MeasurementPlan = std::variant<std::vector<PlannedState>, PlannedDecay>;

struct CandidateMeasurement {
  std::string name;  ///< "phase of the same states", one line
  MeasurementPlan plan;
  bool phases = false;  ///< recorded beside the amplitudes of x
  /// Only the phases are new: the amplitudes are those of the record.
  bool only_phases = false;
  double cost = 0.0;  ///< number of states, or of releases
};

/// What the drive can do.
struct DriveLimits {
  double level = std::numeric_limits<double>::infinity();      ///< largest input amplitude [m]
  double frequency = std::numeric_limits<double>::infinity();  ///< largest frequency [rad/s]

  /// Whether this plan is within them.
  [[nodiscard]] bool allow(const MeasurementPlan& plan) const;
};

struct Candidates {
  std::vector<CandidateMeasurement> list;
  std::vector<std::string> left_out;  ///< names of those beyond the limits of the drive
};

/// What a laboratory with this record could do next with the same rig: record the phase, repeat, take two or three
/// levels more often, go to higher levels, another frequency, the resonance curve, or a release. `zeta`: an
/// approximate value, for the width of the resonance. Of candidates that are the same measurement the first is
/// listed. Levels that are taken more often are taken at the measured frequency nearest to the natural one.
[[nodiscard]] Candidates candidates_after(const std::vector<Pair>& states, const KnownConstants& constants,
                                          double zeta, const DriveLimits& limits);

/// What a laboratory with fewer states than ranges over laws need does first: levels evenly spaced from the lowest
/// to the highest of the record, at which the mass moved, at the measured frequency nearest to the natural one, and
/// with phases. Levels of the record are left out. If the record has about one level, they reach up to three times
/// it, or as far as the drive can.
[[nodiscard]] CandidateMeasurement first_levels(const std::vector<Pair>& states, const KnownConstants& constants,
                                                const DriveLimits& limits);

}  // namespace dualdamp::identify
