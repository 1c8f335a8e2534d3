#pragma once
/// Synthetic measurements: the motion of a model turned into a record.
///
/// Two steps, so that one motion serves many readings: `motion_of` computes what perfect sensors would see, which
/// takes as long as the motion; `reading` adds what real ones make of it (identify/records/sensors.hpp).

#include <cstdint>
#include <string>
#include <vector>

#include "identify/record.hpp"
#include "identify/records/sensors.hpp"
#include "sim/model.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::scenarios {

/// How friction differs from sweep to sweep: all forces of friction are multiplied by
///   1 + rate (j - 1) + walk (n_1 + ... + n_(j-1)),   j = 1, 2, ...,   n normal with variance 1.
struct FrictionDrift {
  double rate = 0.0;  ///< for each sweep
  double walk = 0.0;  ///< standard deviation of a step
  std::uint64_t seed = 0;
};

enum class MeasurementKind {
  steady_states,  ///< pairs at every frequency and amplitude
  free_decay,     ///< extremes
  histories,      ///< signals at every amplitude
};

struct Measurement {
  MeasurementKind kind = MeasurementKind::steady_states;
  std::vector<double> amplitudes;   ///< m or N; empty: the excitation's own
  std::vector<double> frequencies;  ///< rad/s; empty: the excitation's own
  int sweeps = 1;
  FrictionDrift drift;
  int peaks = 0;
  double duration = 0.0;  ///< of a history [s]
  double settle = 0.0;    ///< time before it that is not recorded [s]
  bool with_v = true;     ///< which signals a history has beside x and that of the drive
  bool with_a = true;
};

struct MotionRecord {
  identify::Record exact;
  /// Steady states that are sampled: their histories give the pairs, of which these are exact.
  std::vector<identify::Pair> sampled_pairs;
  double frequency = identify::unknown;  ///< of the drive [rad/s], where it has one
  std::vector<std::string> warnings;     ///< what could not be measured, and why
};

/// Only the sample rate, the averaged periods and the lags of the sensors count here.
[[nodiscard]] MotionRecord motion_of(const sim::Model& model, const Measurement& measurement,
                                     const identify::Sensors& sensors, const sim::SteadyStateOptions& options = {});

/// `warnings` of the reading are appended.
[[nodiscard]] identify::Record reading(const MotionRecord& motion, const identify::Sensors& sensors,
                                       std::uint64_t seed, std::vector<std::string>& warnings);

/// Such a model with all forces of friction multiplied by `factor` > 0: the same motion as that of one whose other
/// forces, inertia included, are divided by it.
[[nodiscard]] sim::Model with_friction_times(double factor, sim::Model model);

}  // namespace dualdamp::scenarios
