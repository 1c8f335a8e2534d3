#pragma once
/// Whether a mass that stands, without a drive, never moves again.

#include "sim/engine/engine.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// True only where it is known. The mass is held, or no law can hold it and all forces on it cancel exactly; then
/// no law changes its mode at a time of its own, and the forces and the static limits of all laws stay as they are,
/// or the limits grow. States of laws may still move if they relax without a swing and that weakens nothing
/// (warmth, a late velocity), or if their swings have died out: over a whole swing they change forces and limits by
/// at most 1e-4 of what would release the mass. False: not known, as while an attached mass or a normal load
/// swings. `held`: for how long the mass has been held [s]. The excitation must be `none`.
[[nodiscard]] bool rests_for_good(const Model& model, const Engine& engine, double held);

}  // namespace dualdamp::sim
