#pragma once
/// A massless slider that a spring drags along, the spring stretched to the slider's limit.

#include <cmath>

#include "friction_models/law.hpp"

namespace dualdamp::friction {

/// Speed of the slider, positive towards `side` (+1 or -1): its spring is stretched by limit/stiffness, so it lags
/// behind the mass while its limit grows. It slides as long as that is positive.
[[nodiscard]] constexpr Affine dragged_speed(const Affine& limit, int side, double stiffness) {
  return {.constant = -limit.rate / stiffness, .velocity = side - limit.position / stiffness};
}

/// Otherwise the slider stops exactly when the mass does.
[[nodiscard]] inline bool stops_by_itself(const Affine& limit, double stiffness) {
  return limit.rate != 0.0 || std::abs(limit.position) >= stiffness;
}

/// A step of the limit downward makes a slider slide whose mass moves back: it then stops at once.
[[nodiscard]] constexpr bool is_left_behind(int side, Direction direction) { return sign(direction) == -side; }

}  // namespace dualdamp::friction
