#pragma once
/// Rigs with known numbers, their noisy records, and fits to these.

#include <cstdint>
#include <string>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::test {

/// A law with the numbers that a fit has to find again.
struct LawCase {
  std::string law;
  friction::ParameterValues truth;
  std::vector<std::string> sought;
  double amplitude = 5e-3;  ///< of the base [m]
};

/// Laws of the registry, each with a drive under which a history shows what is sought.
[[nodiscard]] const std::vector<LawCase>& law_cases();
[[nodiscard]] const LawCase& law_case_of(const std::string& law);

/// m = 1 kg, k = 1000 N/m, c = 1 N.s/m, base motion at 4 Hz.
[[nodiscard]] identify::Rig rig_with(const LawCase& law);

/// x and v, sampled from rest, with white noise of these deviations [m, m/s]; 0: without the signal v.
struct HistoryPlan {
  double duration = 2.0;
  double rate = 500.0;
  double noise_x = 1e-5;
  double noise_v = 0.0;
  sim::InitialState initial{};
};
[[nodiscard]] identify::Record history_of(const identify::Rig& rig, const HistoryPlan& plan, std::uint64_t seed);

/// Extremes of a free vibration from `position`, with noise [m].
[[nodiscard]] identify::Record decay_of_rig(identify::Rig rig, double position, int peaks, double noise,
                                            std::uint64_t seed);

/// Amplitudes and phases over frequency [rad/s] at one input amplitude [m], with noise [m, rad].
[[nodiscard]] identify::Record response_of(const identify::Rig& rig, double amplitude,
                                           const std::vector<double>& frequencies, double noise, double noise_phase,
                                           std::uint64_t seed);

/// Numbers of the rig by name, begun at `factor` times their value.
[[nodiscard]] std::vector<identify::FitParameter> sought_in(identify::Rig& rig,
                                                            const std::vector<std::string>& names, double factor);

/// Fit of a noisy history to its own law, begun 15 % off.
[[nodiscard]] identify::Fit fit_of(const LawCase& law, std::uint64_t seed, const HistoryPlan& plan = {},
                                   bool profile = true);

/// The true value of a parameter of a law.
[[nodiscard]] double truth_of(const identify::Rig& rig, const std::string& name);

}  // namespace dualdamp::test
