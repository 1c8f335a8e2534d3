#pragma once
/// A massless slider that slides at its force limit, dragged by a spring.

#include <cmath>

#include "friction_models/law.hpp"

namespace dualdamp::friction {

/// Speed of the slider, positive in the direction `side` (+1 or -1) of the force. Its spring is stretched by
/// limit/stiffness, so the slider is slower than the mass while the force limit grows. It slides as long as its
/// speed is positive.
[[nodiscard]] constexpr Affine dragged_speed(const Affine& limit, int side, double stiffness) {
  return {.constant = -limit.rate / stiffness, .velocity = side - limit.position / stiffness};
}

/// Whether the slider stops at a guard of its own; otherwise it stops exactly when the mass does.
[[nodiscard]] inline bool stops_by_itself(const Affine& limit, double stiffness) {
  return limit.rate != 0.0 || std::abs(limit.position) >= stiffness;
}

/// Whether the slider slides against the motion of the mass, as after a step of the force limit downward; it then
/// stops at once.
[[nodiscard]] constexpr bool is_left_behind(int side, Direction direction) { return sign(direction) == -side; }

}  // namespace dualdamp::friction
