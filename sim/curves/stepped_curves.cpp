#include "sim/curves/stepped_curves.hpp"

#include <algorithm>

#include "core/cancellation.hpp"
#include "sim/curves/curve_part.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

/// The curve of points whose `omega` and `Y` are given, computed one after the other.
Curve followed(Model model, std::vector<CurvePoint> points, SteadyStateOptions options) {
  CurvePart part;
  for (std::size_t i = 0; i < points.size(); ++i) {
    core::stop_if_cancelled();
    model.excitation.frequency = points[i].omega;
    model.excitation.amplitude = points[i].Y;
    const SteadyState state = steady_state(model, options);
    if (state.outcome.ok()) options.from = state.start;
    part.take(state, points[i], i);
  }
  Curve curve;
  Remarks remarks;
  part.merge_into(curve, points, remarks);
  curve.points = std::move(points);
  curve.remarks = remarks.take();
  return curve;
}

}  // namespace

std::vector<double> stepped(std::vector<double> levels, Stepping stepping) {
  std::ranges::sort(levels);
  if (stepping == Stepping::down) std::ranges::reverse(levels);
  if (stepping == Stepping::both) {
    const std::vector<double> up = levels;
    levels.insert(levels.end(), up.rbegin(), up.rend());
  }
  return levels;
}

Curve stepped_xy_curve(const Model& model, const std::vector<double>& amplitudes, Stepping stepping,
                       const SteadyStateOptions& options) {
  require_in(friction::not_negative, "analysis.amplitudes", amplitudes, model.unit(model.excitation.unit()));
  std::vector<CurvePoint> points;
  for (const double Y : stepped(amplitudes, stepping))
    points.push_back({.omega = model.excitation.frequency, .Y = Y});
  SteadyStateOptions brief = options;
  brief.detail = OrbitDetail::extremes;
  return followed(model, std::move(points), brief);
}

Curve stepped_frequency_response(const Model& model, const std::vector<double>& frequencies, Stepping stepping,
                                 const SteadyStateOptions& options) {
  require_in(friction::positive, "analysis.frequencies", frequencies, "rad/s");
  std::vector<CurvePoint> points;
  for (const double omega : stepped(frequencies, stepping))
    points.push_back({.omega = omega, .Y = model.excitation.amplitude});
  return followed(model, std::move(points), options);
}

}  // namespace dualdamp::sim
