#pragma once
/// Steady states next to a known one, of models that differ little from its model: for searches over parameters and
/// for derivatives. Newton's method starts on the known orbit and keeps its monodromy matrix (the chord method), so
/// a neighbour takes a few passes along its orbit. Where that does not lead to it, each step computes the monodromy
/// matrix anew. If several orbits attract, the neighbour of the known one is found.

#include <Eigen/Core>

#include "sim/engine/state.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

struct KnownOrbit {
  State start;
  Eigen::MatrixXd monodromy;  ///< empty if the motion depends on its past
  long work = 0;              ///< `Engine::work` of its forcing period; 0 if the motion depends on its past
};

/// `state`: a steady state of `model` whose outcome is ok(). Cost: one forcing period with its derivative.
[[nodiscard]] KnownOrbit known_orbit(const Model& model, const SteadyState& state);

/// Whether all motions beside the orbit approach it. False where its monodromy matrix is not known.
[[nodiscard]] bool attracts(const KnownOrbit& orbit);

/// `near`: of a model with the same laws. `share`: the state may be off by this part of its distance from the known
/// one, which is all that a difference quotient needs; 0: only within the tolerance. The result has the Floquet
/// multipliers of the known orbit, or its own if its corrections needed them; `newton_steps` counts corrections. If
/// no correction helps, or the orbit found does not attract, the result is that of `steady_state`, without others;
/// corrections are given up after the work of 200 periods of the known orbit. Needs a harmonic excitation.
[[nodiscard]] SteadyState steady_state_near(const KnownOrbit& near, const Model& model,
                                            const SteadyStateOptions& options = {}, double share = 0.0);

}  // namespace dualdamp::sim
