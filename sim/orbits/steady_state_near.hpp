#pragma once
/// Steady states next to a known one, of models that differ little from its model: for searches over parameters and
/// for derivatives. Newton's method begins on the known orbit with its monodromy matrix and keeps that (the chord
/// method), so that a neighbour takes a few passes along its orbit. Where orbits coexist it is the known one's
/// neighbour that is found.

#include <Eigen/Core>

#include "sim/engine/state.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

struct KnownOrbit {
  State start;
  Eigen::MatrixXd monodromy;  ///< empty where the motion depends on its past
};

/// `state`: a steady state of `model`, found. Cost: one forcing period with its derivative.
[[nodiscard]] KnownOrbit known_orbit(const Model& model, const SteadyState& state);

/// `near`: of a model with the same laws. Its Floquet multipliers stand for those of the neighbour, and
/// `newton_steps` counts corrections. Where the method does not converge quickly the result is that of
/// `steady_state`. Needs a harmonic excitation.
[[nodiscard]] SteadyState steady_state_near(const KnownOrbit& near, const Model& model,
                                            const SteadyStateOptions& options = {});

}  // namespace dualdamp::sim
