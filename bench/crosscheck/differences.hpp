#pragma once
/// The difference of two walks of the same motion, and the allowed difference.
///
/// A motion with friction may depend on its data so strongly that rounding matters: where a guard is grazed, where
/// two events coincide, where the motion is unstable. This sensitivity is measured by the effect of a change of the
/// data by 1e-10 on the motion (`Sensitivity`). Two computations may differ by a tolerance plus a hundred times
/// this effect. Once the sum exceeds a thousandth of the motion nothing more is compared: a named exception.

#include <cstddef>
#include <string>
#include <vector>

#include "bench/crosscheck/walk.hpp"

namespace dualdamp::crosscheck {

/// The effect of a change of the data on the motion at the times of the samples, relative to the size of the
/// motion.
struct Sensitivity {
  std::vector<double> deviation;
  double change = 0.0;       ///< of the data, relative
  double event_shift = 0.0;  ///< largest shift of an event that both motions have [s]
  /// The effect of another tolerance of the same engine (`resolution`); after its end the last value counts.
  std::vector<double> unresolved;
};

struct Difference {
  double worst = 0.0;       ///< of x over its size and v over its size, where compared
  double at = 0.0;          ///< s
  double allowed = 0.0;     ///< there
  double until = 0.0;       ///< the motions were compared up to here [s]
  int resting = 0;          ///< groups of events between which both masses are at rest within the allowed speed
  int coincident = 0;       ///< groups of events at one instant that the walks have in another order or number
  int silent = 0;           ///< switchings or grazings that only one walk has and that do not change the motion
  std::string exception;    ///< why not everything was compared; empty: it was
  std::string fault;        ///< a difference that nothing explains; empty: they agree
  bool same_events = true;  ///< events up to `until` are the same, or their difference has a name
};

/// Deviation of `b` from `a` at the samples that both have, relative to the size of the motion so far.
[[nodiscard]] std::vector<double> deviation(const Walk& a, const Walk& b);

/// How well an engine resolves a motion: the deviation of two walks of the same data with different tolerances, as
/// long as both have the same events. A lost event is not explained by the tolerance.
[[nodiscard]] std::vector<double> resolution(const Walk& a, const Walk& b);

/// The part of a difference that falls with the tolerance: at each sample the deviation of `other` from `motion`,
/// where `tighter`, of the same engine with a tenth of its tolerance, is three times as close; else 0.
[[nodiscard]] std::vector<double> approach(const Walk& motion, const Walk& other, const Walk& tighter);

/// Takes the larger deviation at every sample. After the end of the shorter walk nothing is known.
void widen(Sensitivity& sensitivity, const Walk& motion, const Walk& perturbed);

/// The sample from which on the dependence on the data alone allows too large a difference for a comparison; the
/// number of samples if there is none.
[[nodiscard]] std::size_t first_parted(const Sensitivity& sensitivity);

/// `tolerance`: of the deviation, for a motion that does not depend strongly on its data.
[[nodiscard]] Difference difference(const Walk& a, const Walk& b, const Sensitivity& sensitivity, double tolerance);

}  // namespace dualdamp::crosscheck
