#pragma once
/// The steady states of the oscillators of a batch (`sim/batch/batch.hpp`): packs find those that slide, the search
/// of `sim/orbits/steady_state.hpp` the others, in the same call.
///
/// Results are the same to the last bit for every width and number of threads. Cost on one core with AVX-512: about
/// 0.1 us for a steady state in a pack, tens of us for one that the exact engine computes.

#include <vector>

#include "core/outcome.hpp"
#include "sim/batch/batch.hpp"

namespace dualdamp::sim {

/// One entry for each oscillator; if its outcome is not `done`, its numbers mean nothing.
struct BatchSteadyStates {
  std::vector<core::OutcomeKind> outcome;
  std::vector<double> peak;           ///< max x [m]
  std::vector<double> trough;         ///< min x [m]
  std::vector<double> lag;            ///< of x's fundamental behind the drive [rad], in [0, 2 pi)
  std::vector<double> radius;         ///< largest modulus of a Floquet multiplier of the full period
  std::vector<int> stops;             ///< stops in a period
  std::vector<unsigned char> engine;  ///< 1: found by the exact engine, 0: in a pack
};

/// The steady states approached from rest at x = 0.
[[nodiscard]] BatchSteadyStates steady_states(const OscillatorBatch& batch, const BatchOptions& options = {});

}  // namespace dualdamp::sim
