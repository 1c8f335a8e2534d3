#pragma once
/// Sizes of states that follow from the motion.

#include <limits>

namespace dualdamp::friction {

/// The value in `scales` for a state that is a velocity [m/s]: its size is that of the velocity of the mass. (The
/// size of a state that is left at 0 is that of the position.)
inline constexpr double size_of_velocity = std::numeric_limits<double>::infinity();

}  // namespace dualdamp::friction
