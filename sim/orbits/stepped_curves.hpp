#pragma once
/// Curves as a shaker measures them: the drive is stepped from level to level, and the motion at each level begins
/// in the steady state of the level before. Where several steady states attract (a cubic spring, static friction
/// above kinetic) it stays on its branch until the branch ends, so that the curve jumps, and at another level on
/// the way down than on the way up.
///
/// A step takes place at the end of a forcing period, with the phase of the drive kept. A level without a steady
/// state has a reason; the next one then begins in the last steady state there was. Where all motions meet in one
/// orbit the curve is that of `curves.hpp` to rounding. Cost: that of `steady_state` for each level, one after the
/// other on one thread.

#include <vector>

#include "sim/orbits/curves.hpp"

namespace dualdamp::sim {

enum class Stepping {
  up,    ///< levels in ascending order, the first from the model's initial state
  down,  ///< in descending order
  both,  ///< up, then down from the state at the highest level, which is there twice
};

/// `levels` in the order in which they are stepped through.
[[nodiscard]] std::vector<double> stepped(std::vector<double> levels, Stepping stepping);

/// The model's excitation amplitude is stepped through `amplitudes` [m or N].
[[nodiscard]] Curve stepped_xy_curve(const Model& model, const std::vector<double>& amplitudes, Stepping stepping,
                                     const SteadyStateOptions& options = {});

/// The model's excitation frequency is stepped through `frequencies` [rad/s].
[[nodiscard]] Curve stepped_frequency_response(const Model& model, const std::vector<double>& frequencies,
                                               Stepping stepping, const SteadyStateOptions& options = {});

}  // namespace dualdamp::sim
