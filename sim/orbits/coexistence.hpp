#pragma once
/// Further steady states, besides the one that the motion from the initial state approaches. Only these are found:
///
///   * orbits that Newton's method found on the way and that the motion left;
///   * with a cubic spring, orbits near the amplitudes A of harmonic balance,
///     |(k + 3/4 k3 A^2 - m w^2) A + i (c w A + 4 F/pi)| = P, if there are several;
///   * with static friction above kinetic, the orbit that never sticks.
///
/// `steady_state` adds the mirror image of an asymmetric orbit if a motion that begins on it stays there: in a
/// model that is not symmetric it is no orbit. Many kinds are not searched for (other subharmonic orbits, those
/// that stick in another way): an empty list proves nothing.

#include <vector>

#include "sim/orbits/orbit_solver.hpp"

namespace dualdamp::sim {

/// Orbits that attract, each different from the others and from `orbit`. `met`: candidates that are known already.
[[nodiscard]] std::vector<Orbit> other_orbits(const Model& model, const Orbit& orbit, std::vector<Orbit> met,
                                              OrbitSolver& solver);

}  // namespace dualdamp::sim
