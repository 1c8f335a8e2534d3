#pragma once
/// Sizes of states that are known only with the motion.

#include <limits>

namespace dualdamp::friction {

/// What a law says in `scales` of a state that is a velocity [m/s]: it has the size of the velocity of the mass, as
/// a state without a size has that of its position.
inline constexpr double size_of_velocity = std::numeric_limits<double>::infinity();

}  // namespace dualdamp::friction
