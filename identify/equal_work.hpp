#pragma once
/// Coulomb friction beside viscous friction that does the same work.

#include <numbers>

namespace dualdamp::identify {

/// F0/(c V) of Coulomb and viscous friction that do the same work in a period of a harmonic motion of amplitude X
/// and peak speed V: 4 F0 X = pi c V X.
inline constexpr double coulomb_per_viscous = 0.25 * std::numbers::pi;

}  // namespace dualdamp::identify
