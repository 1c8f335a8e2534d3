#pragma once
/// The sticking boundary: at each frequency the smallest excitation amplitude whose steady state never sticks.
///
/// Found from the engine, for any law, by bisection: below it every orbit sticks somewhere in the forcing period.
/// Where the oscillator is the one of denhartog1931 (all friction Coulomb's with static = kinetic, one harmonic,
/// damper to ground) his closed form stands beside it (`sim/analytic/den_hartog.hpp`): two routes that share no
/// code.
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
  double amplitude = 0.0;               ///< m (base) or N (force); its closed form is met to 2e-11
  double x = 0.0;                       ///< output amplitude there [m]
  std::optional<double> closed_form{};  ///< Den Hartog's amplitude, where his oscillator is this one
};

/// At each of `frequencies` [rad/s]; needs a harmonic excitation and a law that holds the mass.
[[nodiscard]] std::vector<BoundaryPoint> sticking_boundary(const Model& model, std::span<const double> frequencies);

}  // namespace dualdamp::sim
