#pragma once
/// A massless slider that a spring drags along, the spring stretched to the slider's limit.

#include "friction_models/law.hpp"

namespace dualdamp::friction {

/// Speed of the slider, positive towards `side` (+1 or -1). Its spring is stretched by limit/stiffness, so it lags
/// behind the mass while its limit grows. Needs |d limit/dx| < stiffness; under a constant limit it stops with the
/// mass.
[[nodiscard]] constexpr Affine dragged_speed(const Affine& limit, int side, double stiffness) {
  return {.constant = -limit.rate / stiffness, .velocity = side - limit.position / stiffness};
}

}  // namespace dualdamp::friction
