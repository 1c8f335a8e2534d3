#include "bench/speed/identification.hpp"

#include <sys/resource.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/speed/timing.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "identify/design/design.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods.hpp"
#include "scenarios/measurements/measure.hpp"

namespace dualdamp::bench::speed {

namespace {

constexpr double sampled = 1000.0;  // Hz
constexpr int few = 3;              // batches for work that takes seconds

/// The bearing of the paper: zeta 0.0987, F0 4.39 N, driven at its natural frequency.
sim::Model bearing() {
  sim::Model model;
  model.oscillator = {.mass = 1.042, .stiffness = 1568.0, .damping = 7.98};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 6e-3, .frequency = std::sqrt(1568.0 / 1.042)};
  model.friction.emplace_back(friction::Coulomb(4.39, 4.39));
  return model;
}

/// A rig with little damping, released so that it swings for long.
sim::Model released() {
  sim::Model model = bearing();
  model.oscillator.damping = 1.6;
  model.excitation = {};
  model.friction.clear();
  model.friction.emplace_back(friction::Coulomb(0.4, 0.4));
  model.initial.position = 20e-3;
  return model;
}

/// The record of a motion by sensors with a noise of 20 um.
identify::Record measured(const scenarios::Measurement& measurement, double sample_rate,
                          const sim::Model& model = bearing()) {
  identify::Sensors sensors;
  sensors.sample_rate = sample_rate;
  sensors.x.noise = sensors.y.noise = 20e-6;
  sensors.v.noise = 1e-3;
  sensors.a.noise = 0.05;
  std::vector<std::string> warnings;
  return scenarios::reading(scenarios::motion_of(model, measurement, sensors), sensors, 1, warnings);
}

identify::Record fifty_pairs() {
  scenarios::Measurement curve{.kind = scenarios::MeasurementKind::steady_states};
  curve.amplitudes = {4.5e-3, 5.25e-3, 6e-3, 6.75e-3, 7.5e-3};
  curve.sweeps = 10;
  return measured(curve, 0.0);
}

/// Eight levels at resonance; with a sample rate also their phases.
identify::Record eight_states(double sample_rate) {
  scenarios::Measurement curve{.kind = scenarios::MeasurementKind::steady_states};
  for (int i = 0; i < 8; ++i) curve.amplitudes.push_back(4.5e-3 + 0.4e-3 * i);
  return measured(curve, sample_rate);
}

identify::Record response() {
  scenarios::Measurement curve{.kind = scenarios::MeasurementKind::steady_states};
  const double natural = bearing().excitation.frequency;
  for (int i = 0; i < 21; ++i) curve.frequencies.push_back(natural * (0.8 + 0.02 * i));
  return measured(curve, sampled);
}

identify::Record histories(const sim::Model& model) {
  scenarios::Measurement measurement{.kind = scenarios::MeasurementKind::histories};
  measurement.duration = 12.0;
  return measured(measurement, 2.0 * sampled, model);
}

identify::Record decay() {
  return measured({.kind = scenarios::MeasurementKind::free_decay, .peaks = 24}, 0.0, released());
}

identify::Record record_of(AnyLawRecord record) {
  switch (record) {
    case AnyLawRecord::states:
      return eight_states(sampled);
    case AnyLawRecord::response:
      return response();
    case AnyLawRecord::decay:
      return decay();
    case AnyLawRecord::history:
      return histories(released());
  }
  return {};
}

identify::KnownConstants constants() {
  const sim::Model model = bearing();
  return {model.oscillator.mass, model.oscillator.stiffness, model.excitation.frequency};
}

/// Median processor time of all threads.
double seconds_for(const std::function<void()>& work, int batches) {
  const std::vector<std::function<void(int)>> works = {[&](int runs) {
    for (int run = 0; run < runs; ++run) work();
  }};
  return time_alternately(works, batches, 0.05).front().median;
}

double seconds_for(const char* method, const identify::Record& record, const identify::OptionValues& options,
                   int batches = 9) {
  const identify::MethodEntry& entry = *identify::find_method(method);
  bool given = true;
  const double seconds =
      seconds_for([&] { given = given && entry.run(record, constants(), options).outcome.ok(); }, batches);
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

double seconds_for_any_law(AnyLawRecord record) { return seconds_for("any_law", record_of(record), {}, few); }

double seconds_for_design() {
  const identify::Record record = eight_states(0.0);
  bool given = true;
  const double seconds =
      seconds_for([&] { given = given && identify::design_after(record, constants(), {}, {}).index() == 0; }, few);
  if (!given) throw std::runtime_error("there is no advice");
  return seconds;
}

double seconds_for_ledger() {
  const identify::Record record = histories(bearing());
  return seconds_for([&] { static_cast<void>(identify::ledger_of(record, constants())); }, few);
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-3 * static_cast<double>(usage.ru_maxrss);
}

double seconds_for_law_selection() { return seconds_for("law_selection", fifty_pairs(), {}); }

}  // namespace dualdamp::bench::speed
