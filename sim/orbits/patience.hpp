#pragma once
/// How long a motion is followed that does not become periodic: by forcing periods, and by the work that this takes
/// (`Engine::work`), whose amount is the same on every machine. Beyond some five seconds the answer says how far it
/// came.

namespace dualdamp::sim {

struct Patience {
  long periods;  ///< a motion that has not come back after so many is asked whether it is aperiodic
  long work;     ///< of the motion, and as much again of all attempts beside it
};

/// `accuracy`: of the engine, 0 for the exact one.
constexpr Patience patience_with(double accuracy) {
  return accuracy > 0.0 ? Patience{1000, 3'000'000} : Patience{8000, 2'000'000};
}

}  // namespace dualdamp::sim
