#pragma once
/// How far two walks of the same motion are apart, and how far they may be.
///
/// A motion with friction may depend on its data more strongly than any rounding allows: where a guard is grazed,
/// where two events coincide, where the motion is unstable. What a change of the data by 1e-10 does to the motion
/// itself measures that (`Sensitivity`). Two computations may differ by a tolerance and some thirty times that
/// much. From the time on where that exceeds a thousandth of the motion nothing is compared: a named exception.

#include <optional>
#include <string>
#include <vector>

#include "bench/crosscheck/walk.hpp"

namespace dualdamp::crosscheck {

/// What a change of the data does to the motion at the times of the samples, relative to its size.
struct Sensitivity {
  std::vector<double> deviation;
  double change = 0.0;       ///< of the data, relative
  double event_shift = 0.0;  ///< largest shift of an event that both motions have [s]
  /// What another tolerance of the same engine changes (`resolution`); beyond its end as much as there.
  std::vector<double> unresolved;
};

struct Difference {
  double worst = 0.0;     ///< of x over its size and v over its size, where compared
  double at = 0.0;        ///< s
  double allowed = 0.0;   ///< there
  double until = 0.0;     ///< the motions were compared up to here [s]
  int resting = 0;        ///< groups of events between which both masses are at rest within what is allowed
  int coincident = 0;     ///< groups of events that both walks have within rounding, in another order or number
  int silent = 0;         ///< switchings that only one walk has and that leave the motion as it is
  std::string exception;  ///< why not everything was compared; empty: it was
  std::string fault;      ///< what cannot be explained; empty: they agree
};

/// Deviation of `b` from `a` at the samples that both have, relative to the size of the motion so far.
[[nodiscard]] std::vector<double> deviation(const Walk& a, const Walk& b);

/// How far an engine resolves a motion: the deviation of two walks of the same data by different tolerances, as far
/// as both have the same events: a lost event is no question of tolerance.
[[nodiscard]] std::vector<double> resolution(const Walk& a, const Walk& b);

/// The larger of both at every sample; where a walk has fewer samples nothing is known beyond.
void widen(Sensitivity& sensitivity, const Walk& motion, const Walk& perturbed);

/// `tolerance`: of the deviation, for a motion that depends on its data mildly.
[[nodiscard]] Difference difference(const Walk& a, const Walk& b, const Sensitivity& sensitivity, double tolerance);

}  // namespace dualdamp::crosscheck
