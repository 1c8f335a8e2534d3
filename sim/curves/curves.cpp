#include "sim/curves/curves.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "sim/curves/curve_part.hpp"
#include "sim/parallel.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

/// The orbits of these points that packs find. Empty if packs cannot compute the model, or if the tolerance is
/// below their closure.
std::vector<std::optional<SlidingOrbit>> in_packs(const Model& model, const SteadyStateOptions& options, int width,
                                                  std::span<const CurvePoint> points) {
  std::optional<OscillatorBatch> batch = batch_of(model, points.size());
  if (!batch || options.tolerance < sliding_closure) return {points.size(), std::nullopt};
  std::ranges::transform(points, batch->amplitude.begin(), &CurvePoint::Y);
  std::ranges::transform(points, batch->frequency.begin(), &CurvePoint::omega);
  return sliding_orbits(*batch, width);
}

/// Computes consecutive points on one thread; `first`: index of the first point.
void compute(Model model, const SteadyStateOptions& options, int width, std::span<CurvePoint> points,
             std::size_t first, CurvePart& part) {
  const std::vector<std::optional<SlidingOrbit>> orbits = in_packs(model, options, width, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (orbits[i]) {
      part.take(*orbits[i], options, points[i]);
      continue;
    }
    model.excitation.frequency = points[i].omega;
    model.excitation.amplitude = points[i].Y;
    part.take(steady_state(model, options), points[i], first + i);
  }
}

/// The curve of points whose `omega` and `Y` are given.
Curve computed(const Model& model, std::vector<CurvePoint> points, const SteadyStateOptions& options,
               const BatchOptions& batch) {
  // A point in a pack takes a microsecond, another point up to some ten milliseconds.
  const std::size_t chunk_size = batch_of(model, 1) ? 64 : 4;
  const std::span<CurvePoint> all(points);
  std::vector<CurvePart> parts((points.size() + chunk_size - 1) / chunk_size);
  in_parts(points.size(), chunk_size, batch.threads, [&](std::size_t first, std::size_t count) {
    compute(model, options, batch.width, all.subspan(first, count), first, parts[first / chunk_size]);
  });

  Curve curve;
  Remarks remarks;
  for (std::size_t first = 0; first < points.size(); first += chunk_size) {
    const std::size_t count = std::min(chunk_size, points.size() - first);
    parts[first / chunk_size].merge_into(curve, all.subspan(first, count), remarks);
  }
  curve.points = std::move(points);
  curve.remarks = remarks.take();
  return curve;
}

/// Checks the model, and the frequencies and amplitudes that replace those of its excitation.
void check(Model model, std::span<const double> frequencies, std::span<const double> amplitudes,
           std::string_view analysis) {
  require_in(friction::positive, "analysis.frequencies", frequencies, "rad/s");
  require_in(friction::not_negative, "analysis.amplitudes", amplitudes, model.unit(model.excitation.unit()));
  if (!frequencies.empty()) model.excitation.frequency = frequencies.front();
  if (!amplitudes.empty()) model.excitation.amplitude = amplitudes.front();
  valid_harmonic(model, analysis);
}

SteadyStateOptions with(OrbitDetail detail, SteadyStateOptions options) {
  options.detail = detail;
  return options;
}

SteadyStateOptions sticks_by_speed(SteadyStateOptions options) {
  options.sticks_by_speed = true;
  return options;
}

}  // namespace

std::string_view name_of(Regime regime) {
  switch (regime) {
    case Regime::no_steady_state:
      return "no steady state";
    case Regime::never_moves:
      return "never moves";
    case Regime::sticks:
      return "rests";
    case Regime::slides_through:
      return "slides through";
  }
  return "";
}

Curve xy_curve(const Model& model, const std::vector<double>& amplitudes, const SteadyStateOptions& options,
               const BatchOptions& batch) {
  check(model, {}, amplitudes, "xy_curve");
  std::vector<CurvePoint> points;
  points.reserve(amplitudes.size());
  for (const double Y : amplitudes) points.push_back({.omega = model.excitation.frequency, .Y = Y});
  return computed(model, std::move(points), with(OrbitDetail::extremes, options), batch);
}

Curve frequency_response(const Model& model, const std::vector<double>& frequencies,
                         const SteadyStateOptions& options, const BatchOptions& batch) {
  check(model, frequencies, {}, "frequency_response");
  std::vector<CurvePoint> points;
  points.reserve(frequencies.size());
  for (const double omega : frequencies) points.push_back({.omega = omega, .Y = model.excitation.amplitude});
  return computed(model, std::move(points), with(OrbitDetail::phase, options), batch);
}

Curve regime_map(const Model& model, const std::vector<double>& frequencies, const std::vector<double>& amplitudes,
                 const SteadyStateOptions& options, const BatchOptions& batch) {
  check(model, frequencies, amplitudes, "regime_map");
  std::vector<CurvePoint> points;
  points.reserve(frequencies.size() * amplitudes.size());
  for (const double omega : frequencies)
    for (const double Y : amplitudes) points.push_back({.omega = omega, .Y = Y});
  return computed(model, std::move(points), sticks_by_speed(with(OrbitDetail::extremes, options)), batch);
}

}  // namespace dualdamp::sim
