#pragma once
/// Curves as a shaker measures them: the drive is stepped from level to level, and the motion at each level begins
/// in the steady state of the level before. If several steady states attract (a cubic spring, static friction above
/// kinetic), the motion stays on its branch until the branch ends. There the curve jumps, at different levels on
/// the way up and on the way down.
///
/// A step takes place at the end of a forcing period; the phase of the drive stays the same. A level without a
/// steady state has a reason; the next level then begins in the last steady state. If all motions approach one
/// orbit, the curve is that of `curves.hpp` to rounding. Cost: one `steady_state` for each level, one after the
/// other on one thread.

#include <vector>

#include "sim/curves/curves.hpp"

namespace dualdamp::sim {

enum class Stepping {
  up,    ///< levels in ascending order, the first from the model's initial state
  down,  ///< in descending order
  both,  ///< up, then down from the state at the highest level, which is listed twice
};

/// `levels` in the order of the steps.
[[nodiscard]] std::vector<double> stepped(std::vector<double> levels, Stepping stepping);

/// Steps the amplitude of the model's excitation through `amplitudes` [m or N].
[[nodiscard]] Curve stepped_xy_curve(const Model& model, const std::vector<double>& amplitudes, Stepping stepping,
                                     const SteadyStateOptions& options = {});

/// Steps the frequency of the model's excitation through `frequencies` [rad/s].
[[nodiscard]] Curve stepped_frequency_response(const Model& model, const std::vector<double>& frequencies,
                                               Stepping stepping, const SteadyStateOptions& options = {});

}  // namespace dualdamp::sim
