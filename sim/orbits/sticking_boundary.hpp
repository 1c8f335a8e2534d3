#pragma once
/// The sticking boundary: at each frequency the smallest excitation amplitude whose steady state never sticks.
///
/// The engine finds it by bisection, for any law, between an amplitude at which the mass sticks somewhere in the
/// forcing period and one at which it does not; both are computed. If several amplitudes divide sticking from
/// sliding (harmonics, offset, several steady states), it is one of them. For the oscillator of denhartog1931 (only
/// Coulomb friction with static = kinetic, a linear spring, one harmonic of a force or, with the damper to ground,
/// of the base) the result also has Den Hartog's closed form (`sim/analytic/den_hartog.hpp`), which shares no code
/// with the engine.
///
/// Cost: some fifty steady states a frequency.

#include <optional>
#include <span>
#include <vector>

#include "core/outcome.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

struct BoundaryPoint {
  core::Outcome outcome;                ///< not ok(): no boundary was found
  double omega = 0.0;                   ///< rad/s
  double amplitude = 0.0;               ///< m (base) or N (force), to 2e-11; 1e-10 if motions hardly settle there
  double sticks = 0.0;                  ///< the largest amplitude found at which the mass sticks; 0: none
  double slides = 0.0;                  ///< the smallest one found at which it does not stick; 0: none
  double x = 0.0;                       ///< output amplitude at the boundary [m]
  std::optional<double> closed_form{};  ///< Den Hartog's amplitude, if his oscillator is this one
};

/// The boundary at each of `frequencies` [rad/s]. Needs a harmonic excitation and a law that holds the mass.
[[nodiscard]] std::vector<BoundaryPoint> sticking_boundary(const Model& model, std::span<const double> frequencies);

}  // namespace dualdamp::sim
