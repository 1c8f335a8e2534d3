#pragma once
/// Records of random rigs whose friction departs from Coulomb and viscous friction in a known way, to measure how
/// often the ranges over laws hold the truth. The engines compute the motions; rigs, severities and noise are
/// random.

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "identify/departures/departures.hpp"
#include "identify/design/candidate.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "identify/methods/any_law/severity_curve.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify::testing {

enum class LawRecord {
  phases,      ///< eight levels at resonance, amplitude and phase
  amplitudes,  ///< eight levels at resonance, amplitudes alone
  response,    ///< 21 frequencies across resonance, amplitude and phase
  extremes,    ///< extremes of a release
  history,     ///< x of a release, sampled
};

[[nodiscard]] std::string_view name_of(LawRecord kind);

/// A rig with Coulomb and viscous friction and the motion in the middle of its tests.
struct LawRig {
  identify::departures::Truth truth;
  identify::departures::ReferenceMotion reference;
  double zeta = 0.0;
  double noise = 0.003;  ///< of an amplitude over the reference amplitude, of a phase in rad
  KnownConstants constants;
};

/// The same seed gives the same rig: mass 0.3 to 10 kg, 2 to 20 Hz, zeta 0.02 to 0.12 (forced) or 0.005 to 0.03
/// (released), a friction that takes 0.25 to 0.6 of the drive in the middle of the tests.
[[nodiscard]] LawRig law_rig(LawRecord kind, std::uint64_t seed);

/// A record of the rig under a departure of this severity; nullptr: under plain friction. The same seed gives the
/// same noise under every law. Empty if a state was not found.
[[nodiscard]] Record law_record(LawRecord kind, const LawRig& rig, const identify::departures::Departure* departure,
                                double severity, std::uint64_t seed);

/// A record of given states.
[[nodiscard]] Record states_record(const LawRig& rig, const identify::departures::Departure* departure,
                                   double severity, const std::vector<PlannedState>& states, bool phases,
                                   std::uint64_t seed);

/// Laws whose fits take most of the time. The tests that leave them out do not speak of them, or claim more without
/// them: the hull of fewer laws is narrower.
inline const std::vector<std::string> slow_laws = {
    "bouc_wen", "dahl",  "elasto_plastic",  "friction_lag", "generalized_maxwell_slip",
    "iwan",     "lugre", "normal_vibration"};

/// All laws but these: what a test leaves out that says nothing of the other laws. Each of them takes time, in
/// advice as a truth and as a rival of every truth.
inline std::vector<std::string> all_laws_but(const std::vector<std::string>& kept) {
  std::vector<std::string> others = library_names();
  std::erase_if(others, [&](const std::string& name) { return std::ranges::find(kept, name) != kept.end(); });
  return others;
}

inline bool holds(const Interval& interval, double value) { return interval[0] <= value && value <= interval[1]; }
inline double width(const Interval& interval) { return interval[1] - interval[0]; }

}  // namespace dualdamp::identify::testing
