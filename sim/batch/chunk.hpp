#pragma once
/// The parts of a batch that loops over it share: they hand a chunk of its oscillators to the packs, and what packs
/// cannot certify to an engine.

#include <cstddef>
#include <optional>
#include <span>

#include "sim/batch/batch.hpp"
#include "sim/batch/kernels.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim::batch {

/// Number of oscillators of one task. A multiple of every width, so only the last task is padded.
inline constexpr std::size_t chunk = 512;

/// The kernels of this width; 0: of the largest. Throws if the processor has no packs of that width.
const Kernels& kernels_of(int width);

/// Throws if a value is out of range, or if the columns differ in length.
void require_valid(const OscillatorBatch& batch);

/// One oscillator of the batch, from rest at x = 0.
[[nodiscard]] Model model_of(const OscillatorBatch& batch, std::size_t i);

/// The orbits of the oscillators from `first` on, at most one chunk, of a valid batch.
void find_orbits(const OscillatorBatch& batch, const Kernels& kernels, std::size_t first,
                 std::span<std::optional<SlidingOrbit>> orbits);

}  // namespace dualdamp::sim::batch
