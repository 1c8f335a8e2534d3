#pragma once
/// `stress_test`: how wrong each method is under which departures from Coulomb + viscous friction, how large,
/// measured how.
///
/// The run is a campaign: campaign.hpp.

#include <optional>
#include <string>
#include <vector>

#include "identify/methods.hpp"
#include "identify/records/sensors.hpp"
#include "scenarios/analyses/analysis.hpp"
#include "sim/rigs/rigs.hpp"

namespace dualdamp::bench {

/// Steady states at all these input amplitudes and frequencies: an x-Y curve, a frequency response, or both.
struct ExcitationRange {
  std::string name;
  std::vector<double> amplitudes;   ///< m
  std::vector<double> frequencies;  ///< rad/s; the excitation's own where the scenario names none
};

struct SensorSet {
  std::string name;
  identify::Sensors sensors;
};

/// A free decay beside each range, for the methods that need one: from rest at a displacement.
struct DecayTest {
  double displacement = 0.0;  ///< m
  int peaks = 0;
};

struct StressTest {
  double F0 = 0.0;  ///< the Coulomb friction of the truth [N]
  std::vector<const Rig*> laws;
  std::vector<double> severities;  ///< ascending, > 0
  std::vector<ExcitationRange> ranges;
  std::vector<SensorSet> sensors;
  int seeds = 1;  ///< 0 to seeds - 1
  std::vector<const identify::MethodEntry*> methods;
  std::optional<DecayTest> decay;
};

[[nodiscard]] const scenarios::Analysis& stress_test_analysis();

}  // namespace dualdamp::bench
