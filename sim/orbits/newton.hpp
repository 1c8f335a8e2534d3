#pragma once
/// Newton's method on the period map, for end = start of a period.

#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

struct NewtonOptions {
  double omega = 0.0;      ///< rad/s
  double tolerance = 0.0;  ///< closure to reach
  double rounding = 0.0;   ///< closure that is enough once rounding limits the corrections
  int most_steps = 60;
  int most_transients = 60;  ///< most periods of transient that replace steps that do not help
};

struct NewtonResult {
  bool found = false;
  int steps = 0;
  int transient_periods = 0;  ///< counted in periods of the map
};

/// Closure that an orbit must have. Corrections cannot bring it below the error of the engine over a period.
struct Closure {
  double tolerance = 0.0;  ///< to reach
  double rounding = 0.0;   ///< that is enough once rounding limits the corrections
};

/// The closure that an engine of this accuracy (`Engine::accuracy`) can reach if `tolerance` is wished.
[[nodiscard]] Closure closure_within(double tolerance, double accuracy);

/// Size of the next correction of Newton's method, relative to the motion: the error of the orbit. Infinite if the
/// monodromy matrix gives no correction, as in a continuum.
[[nodiscard]] double correction_left(const ForcingPeriod& period, double omega);

/// Largest error of an orbit that closes within `closure`, relative to the motion: `closure` times the norm of
/// (I - M)^-1. An orbit that attracts slowly closes nearly as well at some distance from it. At most 1e-2, because
/// a monodromy matrix says nothing of states far away. 0 if the matrix cannot tell the error, as where the period
/// ends in another mode: such an orbit is allowed no error beyond its closure.
[[nodiscard]] double error_of_orbit(const ForcingPeriod& period, double omega, double closure);

/// Changes `period`, which needs its monodromy matrix, to an orbit. A period of transient replaces a step that does
/// not bring the orbit closer.
[[nodiscard]] NewtonResult close_orbit(PeriodMap& map, const NewtonOptions& options, ForcingPeriod& period);

}  // namespace dualdamp::sim
