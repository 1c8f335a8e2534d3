#pragma once
/// Synthetic measurements: the motion of a model turned into a record.
///
/// There are two steps, so that one motion can be read many times. `motion_of` computes the readings of perfect
/// sensors, which takes as long as the motion; `reading` applies the errors of real sensors
/// (identify/records/sensors.hpp).

#include <cstdint>
#include <string>
#include <vector>

#include "identify/record.hpp"
#include "identify/records/sensors.hpp"
#include "sim/model.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::scenarios {

/// Change of friction from sweep to sweep: all friction forces are multiplied by
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
  bool with_v = true;     ///< signals of a history beside x and the drive
  bool with_a = true;
};

struct MotionRecord {
  identify::Record exact;
  /// For sampled steady states: their histories give the pairs; these are the exact ones.
  std::vector<identify::Pair> sampled_pairs;
  double frequency = identify::unknown;  ///< of the drive [rad/s], if it has one
  std::vector<std::string> warnings;     ///< what could not be measured, and why
};

/// Only the sample rate, the averaged periods and the lags of the sensors are used here.
[[nodiscard]] MotionRecord motion_of(const sim::Model& model, const Measurement& measurement,
                                     const identify::Sensors& sensors, const sim::SteadyStateOptions& options = {});

/// `warnings` of the reading are appended.
[[nodiscard]] identify::Record reading(const MotionRecord& motion, const identify::Sensors& sensors,
                                       std::uint64_t seed, std::vector<std::string>& warnings);

/// The model with all friction forces multiplied by `factor` > 0. Its motion is that of a model whose other forces,
/// including inertia, are divided by the factor.
[[nodiscard]] sim::Model with_friction_times(double factor, sim::Model model);

}  // namespace dualdamp::scenarios
