#pragma once
/// What a search for the first crossing reports (`core/crossing/first_crossing.hpp`).

#include "core/crossing/exponential_basis.hpp"

namespace dualdamp::core {

/// How a search ended. Whoever ignores it takes a motion that has run away for one without events.
enum class [[nodiscard]] SearchEnd {
  crossing,
  horizon,     ///< no guard crosses before it
  left_range,  ///< a guard has left the range of double precision before either: there are no values
  too_long,    ///< too many panels and splits before either: there are no values
};

/// Of one search: some seconds. A period of a guard takes a few, so that millions of them pass.
inline constexpr long most_panels = 20'000'000;

struct Crossing {
  bool found = false;
  int guard = -1;                   ///< index of the guard that crossed
  double s = 0.0;                   ///< where [s]
  ExponentialBasis::Values values;  ///< E_k at s, or at the horizon when nothing was found; none after left_range
};

/// A guard touches zero and does not cross.
struct Grazing {
  int guard = -1;
  double s = 0.0;  ///< s
};

/// What has been searched so far: the certificate a run can print.
struct SearchCount {
  long searches = 0;  ///< searches for the next event
  long panels = 0;    ///< certified, of all guards at once
  long splits = 0;    ///< panels of one guard that had to be divided
  long grazings = 0;  ///< guards that touched zero without crossing

  SearchCount& operator+=(const SearchCount& other) {
    searches += other.searches;
    panels += other.panels;
    splits += other.splits;
    grazings += other.grazings;
    return *this;
  }
};

}  // namespace dualdamp::core
