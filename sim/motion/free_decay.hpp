#pragma once
/// Free vibrations: the extremes of a motion that nothing drives.

#include <vector>

#include "core/outcome.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// An extreme of a free vibration: a turning point of x.
struct Extreme {
  double t = 0.0;  ///< s
  double x = 0.0;  ///< m, signed
};

struct FreeDecay {
  core::Outcome outcome;
  std::vector<Extreme> extremes;  ///< the initial position is the first if the mass is released from rest
  bool came_to_rest = false;      ///< fewer than requested because the mass never moves again
  bool pauses = false;            ///< fewer because the mass is held for `patience`, but may move again
  bool creeps = false;            ///< fewer because the motion has no turning point within `patience`
  double accuracy = 0.0;          ///< error of the engine, relative to the motion
  long work = 0;                  ///< `Engine::work`

  /// Natural periods.
  static constexpr double patience = 100.0;
};

/// Successive extremes of the motion from `model.initial`; at most `count` of them. The excitation must be `none`.
/// A stick is a pause if the mass is released again, as by a force limit that falls with time, by an attached mass
/// that swings on or by a normal load that vibrates. A place where the mass pauses and goes on in the same
/// direction is no extreme.
[[nodiscard]] FreeDecay free_decay(const Model& model, int count);

}  // namespace dualdamp::sim
