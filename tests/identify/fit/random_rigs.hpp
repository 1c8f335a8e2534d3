#pragma once
/// Random rigs and their noisy motions, to see where searches end.

#include <cstdint>
#include <string>

#include "identify/fit/fit.hpp"
#include "identify/fit/prediction.hpp"

namespace dualdamp::test {

enum class MotionKind { forced, decay };

/// A rig of 1 kg and 1000 N/m whose damping and law nobody states, and what was measured of it.
struct RandomRig {
  identify::Rig truth;
  identify::Rig sought;  ///< without damping and the numbers of the law
  identify::Record record;
  std::string signals;            ///< x, v, a, xv
  double noise = 0.0;             ///< of the first signal, in parts of its deviation
  std::vector<double> drawn_rms;  ///< of each signal, in its unit
  double periods = 0.0;
};

/// Laws: coulomb (static above kinetic), stribeck, lugre, contact_compliance, dahl. Damping ratios 0.003 to 0.1.
/// Forced: base motion at 0.3 to 1.6 times the natural frequency, kinetic friction 0.05 to 0.9 of what the spring
/// makes of the base. Decays: 2 to 25 swings until Coulomb friction alone would end them. Noise 0.1 % or 1 %.
[[nodiscard]] RandomRig random_rig(const std::string& law, MotionKind kind, std::uint64_t seed,
                                   const std::string& signals = "");

/// The same rig under a base motion that is larger by `factor`, and what was measured of that.
[[nodiscard]] RandomRig driven_again(const RandomRig& rig, double factor, std::uint64_t seed);

/// As a user would have it: of what the rig leaves out, with the beginning of the motion.
[[nodiscard]] identify::Fit fit_of(const RandomRig& rig, bool profile = false);

/// What was measured of it, as `fit_rig` takes it.
[[nodiscard]] identify::Experiments experiments_of(const RandomRig& rig);

/// Another record of the rig by what was fitted to it.
[[nodiscard]] identify::Prediction predicted_by(const identify::Fit& fit, const RandomRig& second);

/// The fit leaves what the noise was, within 2 %.
[[nodiscard]] bool ends_at_noise(const RandomRig& rig, const identify::Fit& fit);

}  // namespace dualdamp::test
