#pragma once
/// Newton's method on the period map: end = begin.

#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

struct NewtonOptions {
  double omega = 0.0;      ///< rad/s
  double tolerance = 0.0;  ///< closure that is asked for
  double rounding = 0.0;   ///< closure that counts when corrections have sunk into rounding
  int most_steps = 60;
  int most_transients = 60;  ///< periods of transient in place of steps that do not help
};

struct NewtonResult {
  bool found = false;
  int steps = 0;
  int transient_periods = 0;  ///< of the map: as many forcing periods as it passes
};

/// Size of the correction that Newton's method would take, relative to the motion: how well the orbit is known.
/// Infinite when the monodromy matrix gives none, as in a continuum.
[[nodiscard]] double correction_left(const ForcingPeriod& period, double omega);

/// From `period`, which has its monodromy matrix, to an orbit. A step that does not bring the orbit closer is
/// replaced by a period of transient.
[[nodiscard]] NewtonResult close_orbit(PeriodMap& map, const NewtonOptions& options, ForcingPeriod& period);

}  // namespace dualdamp::sim
