#pragma once
/// A lower bound of the amplitude of every steady state, by its harmonics.
///
/// Let friction never exceed F [N]. Its harmonic of any order is then at most 4 F/pi. With the drive's force P at
/// the frequency w, the harmonic X of the displacement has
///
///   |k - m w^2 + i c w| X >= P - 4 F/pi.
///
/// At an undamped resonance the left side is zero: if P exceeds 4 F/pi, there is no steady state.

#include "sim/model.hpp"

namespace dualdamp::sim {

/// m; infinite if there can be no steady state; 0: nothing is known, as where the spring is not linear or the force
/// of a law has no constant bound.
[[nodiscard]] double least_amplitude(const Model& model);

}  // namespace dualdamp::sim
