#pragma once

#include <cmath>

#include "core/constants.hpp"

namespace dualdamp::core {

/// The angle in [-pi, pi] with the same sine and cosine [rad].
[[nodiscard]] inline double wrapped(double angle) { return std::remainder(angle, two_pi); }

}  // namespace dualdamp::core
