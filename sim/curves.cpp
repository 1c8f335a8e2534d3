#include "sim/curves.hpp"

namespace dualdamp::sim {

namespace {

/// Steady states with one quantity of the excitation set to each of `values`.
std::vector<CurvePoint> sweep(Model model, double Excitation::* quantity, const std::vector<double>& values,
                              const SteadyStateOptions& options) {
  std::vector<CurvePoint> curve;
  for (const double value : values) {
    model.excitation.*quantity = value;
    curve.push_back({model.excitation.frequency, model.excitation.amplitude, steady_state(model, options)});
  }
  return curve;
}

}  // namespace

std::vector<CurvePoint> xy_curve(const Model& model, const std::vector<double>& amplitudes,
                                 const SteadyStateOptions& options) {
  return sweep(model, &Excitation::amplitude, amplitudes, options);
}

std::vector<CurvePoint> frequency_response(const Model& model, const std::vector<double>& frequencies,
                                           const SteadyStateOptions& options) {
  return sweep(model, &Excitation::frequency, frequencies, options);
}

}  // namespace dualdamp::sim
