#pragma once
/// The motions of a rig as perfect sensors see them: a curve of steady states and, if the stress test has decays, a
/// decay. The response to a random drive is separate (random_response.hpp), since only records are made from it,
/// and no consequence (consequence.hpp).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/prediction.hpp"
#include "bench/stress_test.hpp"
#include "core/outcome.hpp"
#include "identify/records/sensors.hpp"
#include "scenarios/measurements/measure.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::bench {

struct Motions {
  scenarios::MotionRecord curve;
  std::optional<scenarios::MotionRecord> decay;
  int peaks = 0;        ///< extremes of the decay that were asked for; a mass that comes to rest has fewer
  double stated = 1.0;  ///< frequency that the laboratory believes in, over the one it drives at

  /// The record that the sensors make of them. `warnings` are appended.
  [[nodiscard]] identify::Record reading(const identify::Sensors& sensors, std::uint64_t seed,
                                         std::vector<std::string>& warnings) const;
};

/// Adds the history that the sensors make of a random response.
void add_reading(const scenarios::MotionRecord& response, const identify::Sensors& sensors, std::uint64_t seed,
                 identify::Record& record);

/// The motion that severities are relative to, or why there is none.
struct Reference {
  ReferenceMotion motion;
  core::Outcome outcome;
};

/// A rig driven over a range, as a laboratory sets it.
class MotionMaker {
 public:
  MotionMaker(const StressTest& question, const TrueRig& rig, const ExcitationRange& range,
              const sim::SteadyStateOptions& options);

  /// The motion of the truth in the middle of the range. A mass that sticks or hardly moves gives none.
  [[nodiscard]] Reference reference() const;

  /// `model` is driven at its own frequency; the laboratory believes that it is the frequency of the rig. All
  /// friction of the model grows by `growth`, relative, from the first sweep to the last. `stretch` multiplies all
  /// input amplitudes.
  [[nodiscard]] Motions motions(const sim::Model& model, const identify::Sensors& sensors, double growth = 0.0,
                                double stretch = 1.0) const;

  /// The response to the stress test's random drive with this seed; nothing where it has none. `sensors` give the
  /// delays of the readings.
  [[nodiscard]] std::optional<scenarios::MotionRecord> random_response(const sim::Model& model,
                                                                       const identify::Sensors& sensors,
                                                                       std::uint64_t seed) const;

  /// Amplitudes of the model in the tests of prediction.hpp, which no record holds; NaN where it has no steady
  /// state or does not move.
  [[nodiscard]] UnmeasuredAmplitudes unmeasured(const sim::Model& model) const;

 private:
  const StressTest& question_;
  const TrueRig& rig_;
  const ExcitationRange& range_;
  const sim::SteadyStateOptions& options_;
};

}  // namespace dualdamp::bench
