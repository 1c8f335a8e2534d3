#pragma once
/// How long a motion is followed that does not become periodic: by forcing periods, and by the work that this
/// takes. Work is counted in searches for events and their panels, whose numbers are the same on every machine: an
/// exact one takes about 1 us, the five of a step of the smooth engine 5 to 15 us. Beyond some five seconds the
/// answer says how far it came.

#include "core/search_result.hpp"

namespace dualdamp::sim {

struct Patience {
  long periods;  ///< a motion that has not come back after so many is asked whether it is aperiodic
  long work;     ///< of the motion and of all attempts beside it; asked after half of it
};

/// `accuracy`: of the engine, 0 for the exact one.
constexpr Patience patience_with(double accuracy) {
  return accuracy > 0.0 ? Patience{1000, 1'500'000} : Patience{8000, 2'000'000};
}

[[nodiscard]] inline long work(const core::SearchCount& count) { return count.searches + count.panels; }

}  // namespace dualdamp::sim
