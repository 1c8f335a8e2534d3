#pragma once
/// Rigs with known numbers, their noisy records, and fits to these.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::test {

/// A law with the numbers that a fit has to find again.
struct LawCase {
  std::string law;
  friction::ParameterValues truth;
  std::vector<std::string> sought;
  double amplitude = 5e-3;    ///< of the base [m]
  std::string modifier = {};  ///< of the law, in the name of the case
};
/// dahl, coulomb+drift
[[nodiscard]] std::string name_of(const LawCase& law);

/// Laws of the registry, then some with a modifier, each with a drive under which a history shows what is sought.
[[nodiscard]] const std::vector<LawCase>& law_cases();
[[nodiscard]] const LawCase& law_case_of(const std::string& law);

/// What a fit is made from: a driven history, amplitudes and phases over the input amplitude, a friction loop.
enum class RecordKind { history, pairs, loop };
[[nodiscard]] bool shows(const LawCase& law, RecordKind kind);

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

/// Amplitudes and phases at levels of the input amplitude [m] and the frequency [rad/s], with noise [m, rad].
[[nodiscard]] identify::Record steady_states_of(const identify::Rig& rig,
                                                const std::vector<std::pair<double, double>>& levels, double noise,
                                                double noise_phase, std::uint64_t seed);

/// The law's force along two sines of `amplitude` [m] at 2 and 5.4 Hz, with noise [N]: 2 s at 500 Hz of x, v,
/// force.
[[nodiscard]] identify::Record loop_of(const identify::Rig& rig, double amplitude, double noise,
                                       std::uint64_t seed);
/// The laws without mass, spring, damper and drive.
[[nodiscard]] identify::Rig loop_alone(identify::Rig rig);

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

struct KnownFit {
  identify::Fit fit;
  bool leaves_more_than_the_truth = false;  ///< the search ended beside the least squares
};

/// Noisy records of one kind of the rig of a law of `law_cases()`, each fitted to the law itself, begun 15 % off.
class Laboratory {
 public:
  Laboratory(const LawCase& law, RecordKind kind);
  [[nodiscard]] KnownFit fit(std::uint64_t seed, bool profile = true) const;

 private:
  [[nodiscard]] identify::Record record(std::uint64_t seed) const;

  const LawCase& law_;
  RecordKind kind_;
  identify::Rig rig_;
};

/// A record of few readings of a rig with Coulomb friction.
struct SmallRecord {
  bool is_decay = true;  ///< extremes of a decay, else amplitudes
  int readings = 5;
  bool has_second = true;  ///< with the times of the extremes, or the phases
};
/// Its rig: m, k, c and the friction force.
[[nodiscard]] identify::Rig rig_of(const SmallRecord& plan);
/// Fit of friction and damping to it, begun 15 % off, without profiles.
[[nodiscard]] identify::Fit fit_of(const SmallRecord& plan, std::uint64_t seed);

/// The true value of a parameter of a law, or of the damping.
[[nodiscard]] double truth_of(const identify::Rig& rig, const std::string& name);

/// The parameter of a fit with this name; nullptr: there is none.
[[nodiscard]] const identify::FittedParameter* find_fitted(const identify::Fit& fit, const std::string& name);
/// The same, where there must be one. Errors: `std::invalid_argument`.
[[nodiscard]] const identify::FittedParameter& fitted(const identify::Fit& fit, const std::string& name);

}  // namespace dualdamp::test
