#include "bench/speed/identification.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/speed/timing.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "identify/methods.hpp"
#include "scenarios/measurements/measure.hpp"

namespace dualdamp::bench::speed {

namespace {

/// The bearing of the paper: zeta 0.0987, F0 4.39 N, driven at its natural frequency.
sim::Model bearing() {
  sim::Model model;
  model.oscillator = {.mass = 1.042, .stiffness = 1568.0, .damping = 7.98};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 6e-3, .frequency = std::sqrt(1568.0 / 1.042)};
  model.friction.emplace_back(friction::Coulomb(4.39, 4.39));
  return model;
}

/// What sensors of 20 um make of the bearing's motion.
identify::Record measured(const scenarios::Measurement& measurement, double sample_rate) {
  identify::Sensors sensors;
  sensors.sample_rate = sample_rate;
  sensors.x.noise = sensors.y.noise = 20e-6;
  std::vector<std::string> warnings;
  return scenarios::reading(scenarios::motion_of(bearing(), measurement, sensors), sensors, 1, warnings);
}

identify::Record fifty_pairs() {
  scenarios::Measurement curve{.kind = scenarios::MeasurementKind::steady_states};
  curve.amplitudes = {4.5e-3, 5.25e-3, 6e-3, 6.75e-3, 7.5e-3};
  curve.sweeps = 10;
  return measured(curve, 0.0);
}

identify::Record eight_states_with_phases() {
  scenarios::Measurement curve{.kind = scenarios::MeasurementKind::steady_states};
  for (int i = 0; i < 8; ++i) curve.amplitudes.push_back(4.5e-3 + 0.4e-3 * i);
  return measured(curve, 1000.0);
}

double seconds_for(const char* method, const identify::Record& record, const identify::OptionValues& options,
                   int batches = 9) {
  const identify::MethodEntry& entry = *identify::find_method(method);
  const sim::Model model = bearing();
  const identify::KnownConstants constants{model.oscillator.mass, model.oscillator.stiffness,
                                           model.excitation.frequency};
  bool given = true;
  const std::vector<std::function<void(int)>> works = {[&](int runs) {
    for (int run = 0; run < runs; ++run) given = given && entry.run(record, constants, options).outcome.ok();
  }};
  const double seconds = time_alternately(works, batches, 0.05).front().median;
  if (!given) throw std::runtime_error(std::string(method) + " gave no estimate");
  return seconds;
}

}  // namespace

double seconds_for_bootstrap() {
  return seconds_for("resonance_least_squares", fifty_pairs(), {{"bootstrap", 1000}});
}

double seconds_for_output_error() {
  scenarios::Measurement histories{.kind = scenarios::MeasurementKind::histories};
  histories.duration = 10.0;
  histories.settle = 5.0;
  return seconds_for("output_error", measured(histories, 1000.0), {});
}

double seconds_for_any_law() {
  constexpr int batches = 3;
  return seconds_for("any_law", eight_states_with_phases(), {}, batches);
}

double seconds_for_law_selection() { return seconds_for("law_selection", fifty_pairs(), {}); }

}  // namespace dualdamp::bench::speed
