#pragma once

#include <limits>
#include <numbers>

namespace dualdamp::core {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double two_pi = 2.0 * std::numbers::pi;  ///< a full turn [rad]

}  // namespace dualdamp::core
