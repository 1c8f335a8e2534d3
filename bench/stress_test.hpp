#pragma once
/// `stress_test`: how wrong each method is, by departure from Coulomb + viscous friction, severity, range and
/// sensors.
///
/// The run is a campaign: campaign.hpp.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/departure.hpp"
#include "bench/score/case_answer.hpp"
#include "identify/methods.hpp"
#include "identify/records/sensors.hpp"
#include "scenarios/analysis.hpp"

namespace dualdamp::bench {

/// Steady states at all these input amplitudes and frequencies: an x-Y curve, a frequency response, or a
/// combination of both.
struct ExcitationRange {
  std::string name;
  std::vector<double> amplitudes;   ///< m, in any order
  std::vector<double> frequencies;  ///< rad/s, in any order; empty: that of the rig
  int sweeps = 1;                   ///< how often all of them are measured, one after the other

  /// The frequencies, where `of_rig` is that of the rig.
  [[nodiscard]] std::vector<double> frequencies_or(double of_rig) const {
    return frequencies.empty() ? std::vector{of_rig} : frequencies;
  }
};

struct SensorSet {
  std::string name;
  identify::Sensors sensors;
};

/// A free decay, from rest at a displacement, beside each range; for the methods that need one.
struct DecayTest {
  double displacement = 0.0;  ///< m
  int peaks = 0;
};

/// The sampled response to a random drive, from rest, beside each range; for the methods that need one.
struct RandomTest {
  sim::Excitation drive;     ///< noise, whose seed each motion has of its own (grid.hpp)
  double duration = 0.0;     ///< s
  double settle = 0.0;       ///< time before it that is not recorded [s]
  double sample_rate = 0.0;  ///< Hz

  [[nodiscard]] double samples() const { return duration * sample_rate; }
};

/// The truth of one rig, and its drive.
struct TrueRig {
  Truth truth;
  double frequency = 0.0;  ///< of the drive, where a range names none [rad/s]

  [[nodiscard]] TrueParameters parameters() const { return {sim::damping_ratio(truth.model.oscillator), truth.F0}; }
};

struct StressTest {
  std::vector<TrueRig> rigs;
  std::vector<CaseDeparture> departures;
  std::vector<double> severities;  ///< ascending, > 0
  std::vector<ExcitationRange> ranges;
  std::vector<SensorSet> sensors;
  int seeds = 1;          ///< cases of each motion and set of sensors
  std::int64_t seed = 0;  ///< of all random draws, which are independent from case to case
  std::vector<const identify::MethodEntry*> methods;
  std::optional<DecayTest> decay;
  std::optional<RandomTest> random;
  std::vector<Entry> entries;  ///< answers of programs outside, scored beside the methods

  /// Number of entrants: the methods, then the entries.
  [[nodiscard]] std::size_t entrants() const { return methods.size() + entries.size(); }
  [[nodiscard]] std::string entrant(std::size_t number) const {
    return number < methods.size() ? std::string(methods[number]->name) : entries[number - methods.size()].name;
  }
};

/// The stress test that a question asks for; nullptr where it asks for something else.
[[nodiscard]] const StressTest* stress_test_of(const scenarios::Question& question);

/// The question with these entries.
[[nodiscard]] std::unique_ptr<const scenarios::Question> question_of(StressTest question);

[[nodiscard]] const scenarios::Analysis& stress_test_analysis();

}  // namespace dualdamp::bench
