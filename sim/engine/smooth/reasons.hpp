#pragma once
/// Words for why the smooth engine cannot follow a motion: what is wrong ahead of the state X at the local time t.

#include <span>
#include <string>
#include <vector>

#include "friction_models/law.hpp"
#include "sim/engine/flow.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// A vibration that nearly nothing damps and that swings too often in a `shortest_period` [s] of the oscillator and
/// its drive; empty: there is none.
[[nodiscard]] std::string too_fast_vibration(const Flow& flow, std::span<const double> X, double t,
                                             double shortest_period);

/// The law whose force is not a number at most `reach` [s] ahead of the motion, and where; empty: there is none.
/// `now`: the instant of X, with the memories there.
[[nodiscard]] std::string infinite_force(const Model& model, const Flow& flow, std::span<const double> X, double t,
                                         double reach, friction::Instant now,
                                         std::vector<friction::Memory> memories);

}  // namespace dualdamp::sim
