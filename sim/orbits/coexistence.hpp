#pragma once
/// Steady states beside the one that the motion from the initial state approaches, where they are easily known:
///
///   * orbits that Newton's method met on the way and that the motion left;
///   * with a cubic spring, orbits near the amplitudes A of harmonic balance,
///     |(k + 3/4 k3 A^2 - m w^2) A + i (c w A + 4 F/pi)| = P, where these are several;
///   * with static friction above kinetic, the orbit that never sticks.
///
/// And of an orbit that is not its own mirror image in a model that is, the mirror image. This finds none of many
/// kinds (subharmonic ones, those that stick in another way): an empty list proves nothing.

#include <vector>

#include "sim/orbits/orbit_solver.hpp"

namespace dualdamp::sim {

/// Each attracts and is none of the others, and not `orbit`. `met`: candidates that are known already.
[[nodiscard]] std::vector<Orbit> other_orbits(const Model& model, const Orbit& orbit, std::vector<Orbit> met,
                                              OrbitSolver& solver);

/// Whether the model is its own mirror image in x = 0, told by two periods of its motion.
[[nodiscard]] bool is_symmetric(const Model& model);

}  // namespace dualdamp::sim
