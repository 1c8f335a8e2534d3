#pragma once
/// Curves of steady states: output amplitude over input amplitude, and over frequency.

#include <vector>

#include "sim/steady_state.hpp"

namespace dualdamp::sim {

/// One steady state of a curve. When `state.outcome` is not ok() the point has no number, only a reason.
struct CurvePoint {
  double omega = 0.0;  ///< rad/s
  double Y = 0.0;      ///< m (base) or N (force)
  SteadyState state;
};

/// The model's excitation amplitude is replaced by each of `amplitudes` [m or N] in turn.
[[nodiscard]] std::vector<CurvePoint> xy_curve(const Model& model, const std::vector<double>& amplitudes,
                                               const SteadyStateOptions& options = {});

/// The model's excitation frequency is replaced by each of `frequencies` [rad/s] in turn.
[[nodiscard]] std::vector<CurvePoint> frequency_response(const Model& model, const std::vector<double>& frequencies,
                                                         const SteadyStateOptions& options = {});

}  // namespace dualdamp::sim
