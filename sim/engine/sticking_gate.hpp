#pragma once
/// The sticking gate: where a slip ends, does the mass stick or reverse?
///
/// A slip ends where the velocity reaches 0. There the sum of forces decides, with
///   pull   all forces on the mass, those of the laws for direction none [N],
///   limit  the sum of the static limits of these laws [N]:
///       |pull| < limit   the mass sticks (event: stop);
///       |pull| > limit   the mass slips in the direction of the pull (event: reversal, or none where it goes on);
///       |pull| = limit   the mass sticks unless the excess |pull| - limit grows from here on.
/// A stick ends where |pull| exceeds the limit (event: release).

#include <cmath>

#include "friction_models/law.hpp"

namespace dualdamp::sim {

/// The direction in which the motion goes on, or none: the mass sticks. Where pull and limit are equal within
/// `tolerance` [N], `at_limit()` says in which direction the excess grows, or none.
template <class AtLimit>
[[nodiscard]] friction::Direction direction_after_slip(double pull, double limit, double tolerance,
                                                       const AtLimit& at_limit) {
  if (std::abs(pull) < limit - tolerance) return friction::Direction::none;
  if (std::abs(pull) <= limit + tolerance) return at_limit();
  return pull > 0.0 ? friction::Direction::forward : friction::Direction::backward;
}

}  // namespace dualdamp::sim
