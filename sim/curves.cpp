#include "sim/curves.hpp"

namespace dualdamp::sim {

namespace {

CurvePoint point(const Model& model, const SteadyStateOptions& options) {
  return {model.excitation.frequency, model.excitation.amplitude, steady_state(model, options)};
}

}  // namespace

std::vector<CurvePoint> xy_curve(const Model& model, const std::vector<double>& amplitudes,
                                 const SteadyStateOptions& options) {
  std::vector<CurvePoint> curve;
  Model at = model;
  for (const double amplitude : amplitudes) {
    at.excitation.amplitude = amplitude;
    curve.push_back(point(at, options));
  }
  return curve;
}

std::vector<CurvePoint> frequency_response(const Model& model, const std::vector<double>& frequencies,
                                           const SteadyStateOptions& options) {
  std::vector<CurvePoint> curve;
  Model at = model;
  for (const double frequency : frequencies) {
    at.excitation.frequency = frequency;
    curve.push_back(point(at, options));
  }
  return curve;
}

}  // namespace dualdamp::sim
