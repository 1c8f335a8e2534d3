#pragma once
/// The largest friction with which the mass can have moved as recorded.
///
///   c |v| + F0 <= k (|x| + |y|) + |f| + m V^2/D,   V: largest speed, D: range of x
///
/// Where the speed is largest within a record, spring and drive balance the friction. A mass that is already moving
/// at the beginning of a history has its largest speed there: over the way D, which its energy m V^2/2 must last,
/// a constant friction force is at most m V^2/(2 D), a viscous one at most m V^2/D at the beginning.
///
/// A value above this bound, or an interval that reaches above it, tells nothing that the motion does not tell by
/// itself: the record does not determine this parameter, or the fit failed.
///
/// Speeds are bounded from below: of a history by its fastest change of x, less noise, of steady states and
/// extremes by the mean speed of a half swing.

#include <string>

#include "core/constants.hpp"
#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct LargestFriction {
  double c = core::infinity;   ///< N.s/m
  double F0 = core::infinity;  ///< N
};

/// Of all data of a record; infinite where the mass or the stiffness is unknown, or where nothing moves.
[[nodiscard]] LargestFriction largest_friction(const Record& record, const KnownConstants& constants);

/// Why the record does not determine c and F0: the estimate, or its 95 % interval, is above the largest friction.
/// Empty otherwise.
[[nodiscard]] std::string beyond_motion(const Estimate& estimate, const LargestFriction& largest,
                                        core::Coordinate coordinate);

}  // namespace dualdamp::identify
