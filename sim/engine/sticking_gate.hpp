#pragma once
/// The sticking gate: decides whether the mass sticks or reverses at the end of a slip.
///
/// A slip ends where the velocity reaches 0. There the sum of forces decides, with
///   pull   sum of all forces on the mass, those of the laws for direction none [N],
///   limit  the sum of the static limits of these laws [N]:
///       |pull| < limit   the mass sticks (event: stop);
///       |pull| > limit   the mass slips in the direction of the pull (event: reversal; grazing if the direction is
///                        that of the slip before);
///       |pull| = limit   the mass sticks unless the excess |pull| - limit grows from this time on.
/// A stick ends where |pull| exceeds the limit (event: release).

#include <cmath>

#include "friction_models/law.hpp"

namespace dualdamp::sim {

/// The direction in which the motion goes on, or none if the mass sticks. If pull and limit are equal within
/// `tolerance` [N], `at_limit()` gives the direction in which the excess grows, or none.
template <class AtLimit>
[[nodiscard]] friction::Direction direction_after_slip(double pull, double limit, double tolerance,
                                                       const AtLimit& at_limit) {
  if (std::abs(pull) < limit - tolerance) return friction::Direction::none;
  if (std::abs(pull) <= limit + tolerance) return at_limit();
  return pull > 0.0 ? friction::Direction::forward : friction::Direction::backward;
}

}  // namespace dualdamp::sim
