#pragma once
/// How long a motion that does not become periodic is integrated: a limit of forcing periods, and a limit of work
/// (`Engine::work`), which is the same on every machine. After some five seconds the program gives up, and the
/// message states the number of forcing periods.

namespace dualdamp::sim {

struct Patience {
  long periods;  ///< a motion that has not come back after this many is tested for being aperiodic
  long work;     ///< of the motion; all attempts to find an orbit near it may take as much again
};

/// `accuracy`: Engine::accuracy(), 0 for the exact engine.
constexpr Patience patience_with(double accuracy) {
  return accuracy > 0.0 ? Patience{1000, 3'000'000} : Patience{8000, 2'000'000};
}

}  // namespace dualdamp::sim
