#pragma once
/// Structural (hysteretic) damping of a steady vibration: a spring of the complex stiffness k (1 + i eta).
///
/// Such a spring takes pi eta k A^2 from a period of amplitude A at every frequency. At one frequency w it is a
/// spring k with a viscous damper beside it,
///
///   c = eta k/w                                              [N.s/m]
///
/// between the same two ends, mass and base. A motion in time under a constant eta does not exist: its response to
/// an impulse would begin before the impulse. So only steady vibrations have it. Where friction or a cubic spring
/// makes further harmonics, the damper takes n times as much from the harmonic of order n as a constant eta would.
///
/// Source: crandall1970 in `docs/refs.bib`.

#include "sim/model.hpp"

namespace dualdamp::sim {

/// The model with its loss factor as that damper, at the frequency of its excitation. Errors: `core::InputError`
/// for an excitation that is not one harmonic, and where a damper to ground is beside a base in motion: the model
/// has one damper.
[[nodiscard]] Model with_viscous_equivalent(Model model);

}  // namespace dualdamp::sim
