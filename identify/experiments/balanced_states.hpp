#pragma once
/// Steady states whose motion is held as it was measured, for the first steps of a search.
///
///   P_i e^{i psi} = first harmonic of m x'' + c x' + k x + F(x, x') along x = X cos(w t)
///
/// X is the measured amplitude, P_i the drive that this motion needs. Its prediction of the amplitude under the
/// real drive P is X (2 - P_i/P), that of the phase is psi. Both are smooth and nearly linear in the forces of the
/// laws: there are no jumps between branches, and friction far from the true one still shows how far it is off. The
/// steady states of such a model lie far from the measured ones, and their sum of squares has false minima there.
///
/// Holds for linear springs, and for any spring under a force. The motion of the mass is taken for a sine. Cost:
/// the laws along three periods of 64 samples in each state, no search for a steady state.

#include <cstddef>
#include <memory>
#include <vector>

#include "identify/experiments/experiment.hpp"

namespace dualdamp::identify {

/// `states`: the experiment with measured amplitudes. `with_phase`: of each measured phase, the index of its state.
[[nodiscard]] std::unique_ptr<Experiment> balanced_states(const Experiment& states,
                                                          std::vector<std::size_t> with_phase);

}  // namespace dualdamp::identify
