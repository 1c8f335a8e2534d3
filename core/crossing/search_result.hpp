#pragma once
/// What a search for the first crossing reports (`core/crossing/first_crossing.hpp`).

#include "core/crossing/exponential_basis.hpp"

namespace dualdamp::core {

/// How a search ended. A caller that ignores this would treat a motion that has run away as one without events.
enum class [[nodiscard]] SearchEnd {
  crossing,
  horizon,     ///< no guard crosses before the horizon
  left_range,  ///< a guard left the range of double precision before a crossing or the horizon: no values
  too_long,    ///< too many panels and splits before a crossing or the horizon: no values
};

/// Largest number of panels of one search: some seconds. A period of a guard takes a few panels, so a search can
/// pass millions of periods.
inline constexpr long most_panels = 20'000'000;

struct Crossing {
  bool found = false;
  int guard = -1;                   ///< index of the guard that crossed
  double s = 0.0;                   ///< time of the crossing [s]
  ExponentialBasis::Values values;  ///< E_k at s, or at the horizon if no guard crossed; none after left_range
};

/// A guard touches zero and does not cross.
struct Grazing {
  int guard = -1;
  double s = 0.0;  ///< time [s]
};

/// Count of the searches so far: the certificate that a run can print.
struct SearchCount {
  long searches = 0;  ///< searches for the next event
  long panels = 0;    ///< panels certified, each for all guards at once
  long splits = 0;    ///< panels of one guard that had to be divided
  long grazings = 0;  ///< guards that touched zero without crossing

  /// In units of `sim::Engine::work`, which may also count other work, such as steps.
  [[nodiscard]] long work() const { return searches + panels + splits; }

  SearchCount& operator+=(const SearchCount& other) {
    searches += other.searches;
    panels += other.panels;
    splits += other.splits;
    grazings += other.grazings;
    return *this;
  }
};

}  // namespace dualdamp::core
