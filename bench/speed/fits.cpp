#include "bench/speed/fits.hpp"

#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "identify/fit/prediction.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/run.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::bench::speed {

namespace {

/// 1 kg, 1000 N/m, 1 N.s/m under a base motion of 5 mm at 4 Hz.
identify::Rig rig_with(const char* law, friction::ParameterValues values) {
  identify::Rig rig;
  rig.known.oscillator = {.mass = 1.0, .stiffness = 1000.0, .damping = 1.0};
  rig.known.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 5e-3, .frequency = core::two_pi * 4.0};
  rig.known.solver.tolerance = 1e-9;
  rig.laws.push_back({friction::find_law(law), std::move(values)});
  return rig;
}

identify::Rig coulomb_rig() { return rig_with("coulomb", {{"kinetic", 1.0}}); }

identify::Experiments measured(const identify::Rig& rig, std::uint64_t seed) {
  identify::Record record;
  identify::History& history = record.histories.emplace_back();
  history.sample_rate = 1000.0;
  const sim::History motion =
      sim::simulate(*identify::model_of(rig), {.duration = 10.0, .sample_rate = history.sample_rate});
  const core::RandomStream draws{seed, 930};
  constexpr double noise = 1e-5;
  for (std::size_t i = 0; i < motion.samples.size(); ++i)
    history.x.push_back(motion.samples[i].x + noise * draws.normal(i));
  std::string fault;
  return identify::experiments_of(record, {.name = "measured"}, fault);
}

/// Steady states at sixteen levels of the base, with phases.
identify::Experiments measured_states(const identify::Rig& rig) {
  constexpr double noise = 1e-5;
  constexpr double noise_of_phase = 3e-3;
  const core::RandomStream draws{1, 931};
  sim::Model model = *identify::model_of(rig);
  identify::Record record;
  std::vector<identify::Pair>& pairs = record.pairs.emplace().pairs;
  for (std::uint64_t i = 0; i < 16; ++i) {
    model.excitation.amplitude = 2e-3 + 4e-4 * static_cast<double>(i);
    const sim::SteadyState state = sim::steady_state(model, {.detail = sim::OrbitDetail::phase, .others = false});
    pairs.push_back({.Y = model.excitation.amplitude,
                     .x = state.amplitude + noise * draws.normal(2 * i),
                     .number = static_cast<int>(i) + 1,
                     .omega = model.excitation.frequency,
                     .phase = state.phase + noise_of_phase * draws.normal(2 * i + 1)});
  }
  std::string fault;
  return identify::experiments_of(record, {.name = "measured", .sigma_x = noise, .sigma_phase = noise_of_phase},
                                  fault);
}

double seconds_of(const std::function<bool()>& work) {
  const std::clock_t start = std::clock();
  if (!work()) throw std::runtime_error("a fit that is timed failed");
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

identify::Fit fit_from_nothing(identify::Rig rig, const identify::Experiments& experiments) {
  rig.known.oscillator.damping = identify::unknown;
  rig.laws.front().values = {};
  std::vector<std::string> faults;
  std::vector<identify::FitParameter> parameters = identify::unstated_parameters(rig, faults);
  for (const identify::RecordParameter each : experiments.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  return identify::fit_rig(rig, std::move(parameters), experiments);
}

/// `most`: rms of the residuals, over their noise.
double seconds_for_fit(const identify::Rig& rig, const identify::Experiments& experiments, double most = 1.1) {
  return seconds_of([&] {
    const identify::Fit fit = fit_from_nothing(rig, experiments);
    return fit.outcome.ok() && fit.noise_units < most;
  });
}

}  // namespace

double seconds_for_coulomb_fit() { return seconds_for_fit(coulomb_rig(), measured(coulomb_rig(), 1)); }

double seconds_for_lugre_fit() {
  const identify::Rig rig = rig_with(
      "lugre",
      {{"kinetic", 1.0}, {"static", 1.5}, {"stribeck_velocity", 0.03}, {"sigma0", 5000.0}, {"sigma1", 20.0}});
  return seconds_for_fit(rig, measured(rig, 1));
}

double seconds_for_dahl_fit() {
  constexpr double few_readings = 1.5;
  const identify::Rig rig = rig_with("dahl", {{"kinetic", 1.0}, {"sigma0", 5000.0}});
  return seconds_for_fit(rig, measured_states(rig), few_readings);
}

double seconds_for_prediction() {
  const identify::Fit fit = fit_from_nothing(coulomb_rig(), measured(coulomb_rig(), 1));
  const identify::Experiments other = measured(coulomb_rig(), 2);
  std::vector<identify::FitParameter> parameters;
  for (const identify::FittedParameter& fitted : fit.parameters) parameters.push_back(fitted.parameter);
  return seconds_of([&] {
    return identify::predict_records(fit.rig, parameters, identify::shared_uncertainty(fit), other).outcome.ok();
  });
}

double seconds_for_sweep() {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "dualdamp_speed_sweep.yaml";
  std::ofstream(file) << "schema: " << scenarios::schema_name
                      << "\n"
                         "system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb}}\n"
                         "excitation: {type: base_harmonic, frequency: natural}\n"
                         "analysis: {type: steady_state}\n"
                         "sweep:\n"
                         "  system.friction.kinetic: {from: 1 N, to: 5 N, count: 100}\n"
                         "  excitation.amplitude: {from: 10 cm, to: 30 cm, count: 100}\n";
  const scenarios::Scenario scenario = scenarios::load_scenario(file.string());
  std::filesystem::remove(file);
  return seconds_of([&] { return scenarios::run(scenario).status == core::ExitStatus::done; });
}

}  // namespace dualdamp::bench::speed
