#pragma once
/// Many steady states of one model: output amplitude over input amplitude, over frequency, and over both.
///
/// Points are computed in parallel. Each starts from the model's initial state and depends on its own numbers only,
/// so results are the same for every number of threads. If batches can compute the model (`sim/batch/batch.hpp`),
/// its points are tried in packs first: points that do not stick cost about 0.1 us there and differ from
/// `steady_state` by rounding. Every other point is one `steady_state`. Memory: 48 bytes a point.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/batch.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

/// Kinds of steady states by the sticks of the mass.
enum class Regime {
  no_steady_state,
  never_moves,
  sticks,          ///< once or several times in a period
  slides_through,  ///< it never sticks
};

/// "no steady state", "never moves", "rests", "slides through".
[[nodiscard]] std::string_view name_of(Regime regime);

/// One steady state. If there is none, only `omega` and `Y` are valid.
struct CurvePoint {
  double omega = 0.0;  ///< rad/s
  double Y = 0.0;      ///< m (base) or N (force)
  double x = 0.0;      ///< output amplitude (peak - trough)/2 [m]
  double phase = 0.0;  ///< lag of x's fundamental [rad], as that of the steady state; of a frequency response only
  int stops = 0;       ///< stops in one period of the motion
  int sticks = 0;      ///< sticks in a period; in a regime map also by speed (`SteadyState::stick_count`)
  bool stable = false;
  std::uint32_t reason = 0;  ///< 0: there is a steady state; else an index into `Curve::reasons`

  [[nodiscard]] bool ok() const { return reason == 0; }
  /// As that of the steady state.
  [[nodiscard]] bool never_moves() const { return x == 0.0; }
  [[nodiscard]] Regime regime() const {
    if (!ok()) return Regime::no_steady_state;
    if (sticks == 0) return Regime::slides_through;
    return never_moves() ? Regime::never_moves : Regime::sticks;
  }
};

/// A reason or warning that some of the points have.
struct Remark {
  std::string text;
  std::size_t first = 0;  ///< index of the first point
  std::size_t count = 0;
};

struct Curve {
  std::vector<CurvePoint> points;
  std::vector<std::string> reasons = {""};  ///< distinct reasons for points without numbers; the first is empty
  std::vector<Remark> remarks;              ///< reasons and warnings in order of first appearance
  core::SearchCount certificate;            ///< of all points together

  [[nodiscard]] const std::string& reason(const CurvePoint& point) const { return reasons[point.reason]; }
};

/// Steady states over input amplitude: `amplitudes` [m or N] replace the amplitude of the model's excitation.
[[nodiscard]] Curve xy_curve(const Model& model, const std::vector<double>& amplitudes,
                             const SteadyStateOptions& options = {}, const BatchOptions& batch = {});

/// Steady states over frequency: `frequencies` [rad/s] replace the frequency of the model's excitation.
[[nodiscard]] Curve frequency_response(const Model& model, const std::vector<double>& frequencies,
                                       const SteadyStateOptions& options = {}, const BatchOptions& batch = {});

/// Steady states over both: all amplitudes at the first frequency, then at the next.
[[nodiscard]] Curve regime_map(const Model& model, const std::vector<double>& frequencies,
                               const std::vector<double>& amplitudes, const SteadyStateOptions& options = {},
                               const BatchOptions& batch = {});

}  // namespace dualdamp::sim
