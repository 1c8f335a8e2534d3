#include "sim/orbits/batch_steady_states.hpp"

#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>

#include "sim/batch/chunk.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::sim {

namespace {

using batch::chunk;
using batch::Kernels;

void steady_state_by_engine(const OscillatorBatch& batch, std::size_t i, BatchSteadyStates& result) {
  const SteadyState state = steady_state(batch::model_of(batch, i));
  result.engine[i] = 1;
  result.outcome[i] = state.outcome.kind;
  result.peak[i] = state.peak;
  result.trough[i] = state.trough;
  result.lag[i] = state.phase;
  result.stops[i] = state.stops_per_cycle;
  for (const std::complex<double>& value : state.multipliers)
    result.radius[i] = std::max(result.radius[i], std::abs(value));
}

void steady_states_of(const OscillatorBatch& batch, const Kernels& kernels, std::size_t first, std::size_t count,
                      BatchSteadyStates& result) {
  std::array<std::optional<SlidingOrbit>, chunk> orbits;
  batch::find_orbits(batch, kernels, first, std::span(orbits).first(count));
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t i = first + lane;
    if (!orbits[lane]) {
      steady_state_by_engine(batch, i, result);
      continue;
    }
    const SlidingOrbit& orbit = *orbits[lane];
    result.peak[i] = orbit.peak;
    result.trough[i] = -orbit.peak;
    result.lag[i] = orbit.lag;
    result.radius[i] = orbit.radius;
  }
}

}  // namespace

BatchSteadyStates steady_states(const OscillatorBatch& batch, const BatchOptions& options) {
  batch::require_valid(batch);
  BatchSteadyStates result;
  result.outcome.resize(batch.size(), core::OutcomeKind::done);
  for (std::vector<double>* column : {&result.peak, &result.trough, &result.lag, &result.radius})
    column->resize(batch.size(), 0.0);
  result.stops.resize(batch.size(), 0);
  result.engine.resize(batch.size(), 0);
  const Kernels& kernels = batch::kernels_of(options.width);
  in_parts(batch.size(), chunk, options.threads,
           [&](std::size_t first, std::size_t count) { steady_states_of(batch, kernels, first, count, result); });
  return result;
}

}  // namespace dualdamp::sim
