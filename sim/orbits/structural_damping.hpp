#pragma once
/// Structural (hysteretic) damping of a steady vibration: a spring of the complex stiffness k (1 + i eta).
///
/// Such a spring takes pi eta k A^2 from a period of amplitude A at every frequency. At one frequency w it equals a
/// spring k with a parallel viscous damper,
///
///   c = eta k/w                                              [N.s/m]
///
/// between mass and base. A motion in time under a constant eta does not exist: its response to an impulse would
/// begin before the impulse. So only steady vibrations use it. If friction or a cubic spring adds further
/// harmonics, the damper takes n times as much from the harmonic of order n as a constant eta would.
///
/// Source: crandall1970 in `docs/refs.bib`.

#include "sim/model.hpp"

namespace dualdamp::sim {

/// The model with this damper in place of its loss factor, at the frequency of its excitation. Errors:
/// `core::InputError` for an excitation that is not one harmonic, and for a damper to ground with a moving base,
/// because a model has only one damper.
[[nodiscard]] Model with_viscous_equivalent(Model model);

}  // namespace dualdamp::sim
