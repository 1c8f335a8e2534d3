#include "bench/accuracy/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "friction_models/laws/coulomb.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::Measurement;
using scenarios::MeasurementKind;

constexpr double mass = 1.042;          // kg, the paper's
constexpr double stiffness = 1568.0;    // N/m
constexpr double damping = 8.0;         // N.s/m
constexpr double friction_force = 2.0;  // N
constexpr double micrometre = 1e-6;

sim::Model rig(const sim::Excitation& excitation) {
  sim::Model model;
  model.oscillator = {.mass = mass, .stiffness = stiffness, .damping = damping};
  model.excitation = excitation;
  model.friction.emplace_back(friction::Coulomb(friction_force, friction_force));
  return model;
}

sim::Excitation at_resonance(double amplitude) {
  return {
      .type = sim::ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = std::sqrt(stiffness / mass)};
}

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

/// The base is measured ten times better than the mass, its acceleration as well as its displacement.
identify::Sensors unit_sensors() {
  identify::Sensors sensors;
  sensors.x.noise = 1.0;
  sensors.y.noise = 0.1;
  sensors.v.noise = std::sqrt(stiffness / mass);
  sensors.a.noise = stiffness / mass;
  return sensors;
}

identify::Sensors times(double noise, identify::Sensors sensors) {
  for (identify::Sensor* sensor : {&sensors.x, &sensors.y, &sensors.v, &sensors.a}) sensor->noise *= noise;
  return sensors;
}

Experiment sweep() {
  Measurement measurement;
  measurement.amplitudes = steps(4.45e-3, 6.75e-3, 5);
  return {"one sweep", "five amplitudes at resonance, read once", rig(at_resonance(0.0)), measurement,
          unit_sensors()};
}

Experiment sweeps() {
  Experiment experiment = sweep();
  experiment.name = "ten sweeps";
  experiment.meaning = "the same ten times over";
  experiment.measurement.sweeps = 10;
  return experiment;
}

Experiment response() {
  Measurement measurement;
  measurement.frequencies = steps(36.0, 42.0, 13);
  return {"frequency response", "thirteen frequencies from 5.7 to 6.7 Hz at 6 mm, amplitude and phase read once",
          rig(at_resonance(6e-3)), measurement, unit_sensors()};
}

Experiment decay() {
  Measurement measurement;
  measurement.kind = MeasurementKind::free_decay;
  measurement.peaks = 8;
  sim::Model model = rig({});
  model.initial.position = 30e-3;
  return {"free decay", "eight extremes of a free vibration from 30 mm", model, measurement, unit_sensors()};
}

Experiment histories() {
  Measurement measurement;
  measurement.kind = MeasurementKind::histories;
  measurement.amplitudes = {4e-3, 6e-3};
  measurement.settle = 2.0;
  measurement.duration = 3.0;
  measurement.with_v = false;
  identify::Sensors sensors = unit_sensors();
  sensors.sample_rate = 500.0;
  sensors.y.noise = 0.0;
  return {"histories", "y without noise, x and a, at 4 and 6 mm, three seconds each at 500 Hz",
          rig(at_resonance(0.0)), measurement, sensors};
}

/// One second and a noisy base: few independent residuals, and noise of the base that appears in the computed
/// motion.
Experiment short_histories() {
  Experiment experiment = histories();
  experiment.name = "short histories";
  experiment.meaning = "the same for one second, and y with noise";
  experiment.measurement.duration = 1.0;
  experiment.sensors.y.noise = unit_sensors().y.noise;
  experiment.variant_of = "histories";
  return experiment;
}

Experiment random_response() {
  Measurement measurement;
  measurement.kind = MeasurementKind::histories;
  measurement.settle = 5.0;
  measurement.duration = 100.0;
  measurement.with_v = measurement.with_a = false;
  identify::Sensors sensors = unit_sensors();
  sensors.sample_rate = 200.0;
  return {
      "random response", "x and the random force on the mass, 100 s at 200 Hz, each seed with a motion of its own",
      rig({.type = sim::ExcitationType::force_noise, .noise = {.intensity = 2.0, .bandwidth = 380.0, .seed = 1}}),
      measurement, sensors};
}

identify::KnownConstants constants_of(const Experiment& experiment) {
  const sim::Excitation& excitation = experiment.model.excitation;
  return {mass, stiffness, excitation.is_harmonic() ? excitation.frequency : identify::unknown};
}

identify::Estimate estimate(const identify::MethodEntry& method, const Experiment& experiment,
                            const scenarios::MotionRecord& motion, double noise, std::uint64_t seed) {
  std::vector<std::string> remarks;
  const identify::Record record = scenarios::reading(motion, times(noise, experiment.sensors), seed, remarks);
  return method.run(record, constants_of(experiment), {});
}

struct Setting {
  const Experiment* experiment = nullptr;
  const scenarios::MotionRecord* motion = nullptr;
};

/// The first experiment whose perfect record gives the method an estimate, and the variants of this experiment.
std::vector<Setting> settings_for(const identify::MethodEntry& method,
                                  const std::vector<scenarios::MotionRecord>& motions) {
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Experiment& experiment = experiments()[i];
    const bool met = settings.empty() ? experiment.variant_of.empty() && method.lacks(motions[i].exact).empty() &&
                                            estimate(method, experiment, motions[i], 0.0, 0).outcome.ok()
                                      : experiment.variant_of == settings.front().experiment->name;
    if (met) settings.push_back({&experiment, &motions[i]});
  }
  return settings;
}

/// Compares one parameter of every estimate with its true value.
ErrorSummary summary(const std::vector<identify::Estimate>& estimates, double truth,
                     double identify::ParameterSet::* number,
                     identify::Interval identify::ParameterIntervals::* interval) {
  ErrorSummary result;
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (const identify::Estimate& estimate : estimates) {
    if (!estimate.outcome.ok()) continue;
    const double error = estimate.value.*number / truth - 1.0;
    ++count;
    sum += error;
    squares += error * error;
    if (!estimate.interval95) continue;
    const auto [low, high] = (*estimate.interval95).*interval;
    ++result.intervals;
    result.covered += low <= truth && truth <= high ? 1 : 0;
  }
  if (count == 0) return result;
  result.bias = sum / count;
  result.spread = std::sqrt(std::max(0.0, squares / count - result.bias * result.bias));
  return result;
}

Cell cell_of(const identify::MethodEntry& method, const Experiment& experiment, double noise,
             const std::vector<identify::Estimate>& estimates) {
  Cell cell{.method = std::string(method.name),
            .experiment = experiment.name,
            .noise = noise,
            .seeds = static_cast<int>(estimates.size())};
  for (const identify::Estimate& estimate : estimates) {
    cell.estimates += estimate.outcome.ok() ? 1 : 0;
    cell.usable += estimate.outcome.ok() && estimate.usable ? 1 : 0;
  }
  using identify::ParameterIntervals;
  using identify::ParameterSet;
  cell.zeta = summary(estimates, truth().zeta, &ParameterSet::zeta, &ParameterIntervals::zeta);
  cell.F0 = summary(estimates, truth().F0, &ParameterSet::F0, &ParameterIntervals::F0);
  return cell;
}

/// If the motion is random, every seed has its own motion: the random numbers are in the motion, not in the
/// reading.
scenarios::MotionRecord motion_for(const Experiment& experiment, std::uint64_t seed) {
  sim::Model model = experiment.model;
  model.excitation.noise.seed = seed;
  return scenarios::motion_of(model, experiment.measurement, experiment.sensors);
}

/// A cell for each noise.
std::vector<Cell> cells_of(const identify::MethodEntry& method, const Setting& setting,
                           const std::vector<double>& noises, int seeds) {
  const Experiment& experiment = *setting.experiment;
  const auto count = static_cast<std::size_t>(seeds);
  std::vector<std::vector<identify::Estimate>> estimates(noises.size(), std::vector<identify::Estimate>(count));
  constexpr std::size_t grain = 8;
  sim::in_parts(count, grain, 0, [&](std::size_t first, std::size_t part) {
    for (std::size_t seed = first; seed < first + part; ++seed) {
      std::optional<scenarios::MotionRecord> own;
      if (experiment.model.excitation.is_noise()) own = motion_for(experiment, seed);
      for (std::size_t i = 0; i < noises.size(); ++i)
        estimates[i][seed] = estimate(method, experiment, own ? *own : *setting.motion, noises[i], seed);
    }
  });
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < noises.size(); ++i)
    cells.push_back(cell_of(method, experiment, noises[i], estimates[i]));
  return cells;
}

std::string noise_text(double noise) { return fmt::format("{:.0f} um", noise / micrometre); }

bool outside(const ErrorSummary& score) {
  return score.intervals > 0 && (score.coverage() < least_coverage || score.coverage() > most_coverage);
}

std::string coverage_text(const ErrorSummary& score) {
  if (score.intervals == 0) return "-";
  return fmt::format("{:.1f}{}", 100.0 * score.coverage(), outside(score) ? " !" : "");
}

}  // namespace

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> list = {sweep(),     sweeps(),          response(),       decay(),
                                               histories(), short_histories(), random_response()};
  return list;
}

TrueFriction truth() { return {damping / identify::critical_damping(mass, stiffness), friction_force}; }

std::vector<Cell> accuracy(const std::vector<const identify::MethodEntry*>& methods,
                           const std::vector<double>& noises, int seeds) {
  std::vector<scenarios::MotionRecord> motions;
  for (const Experiment& experiment : experiments())
    motions.push_back(scenarios::motion_of(experiment.model, experiment.measurement, experiment.sensors));
  std::vector<Cell> cells;
  for (const identify::MethodEntry* method : methods) {
    for (const Setting& setting : settings_for(*method, motions))
      std::ranges::move(cells_of(*method, setting, noises, seeds), std::back_inserter(cells));
  }
  return cells;
}

Coverage coverage(const std::vector<Cell>& cells) {
  Coverage result;
  for (const Cell& cell : cells) {
    for (const auto& [name, score] :
         {std::pair<std::string, const ErrorSummary&>{"zeta", cell.zeta}, {"F0", cell.F0}}) {
      if (score.intervals == 0) continue;
      ++result.claimed;
      if (outside(score))
        result.outside.push_back(fmt::format("{}, {}, {}, {}: {:.1f} %", cell.method, cell.experiment,
                                             noise_text(cell.noise), name, 100.0 * score.coverage()));
    }
  }
  return result;
}

std::string accuracy_row(const Cell& cell) {
  return fmt::format("| `{}` | {} | {} | {:.1f} | {:+.2f} | {:.2f} | {} | {:+.2f} | {:.2f} | {} |\n", cell.method,
                     cell.experiment, noise_text(cell.noise), 100.0 * cell.usable / cell.seeds,
                     100.0 * cell.zeta.bias, 100.0 * cell.zeta.spread, coverage_text(cell.zeta),
                     100.0 * cell.F0.bias, 100.0 * cell.F0.spread, coverage_text(cell.F0));
}

std::string accuracy_page(const std::vector<Cell>& cells) {
  std::string page = fmt::format(
      R"(# How accurate the methods are

Generated by `scripts/accuracy`. Every method reads synthetic measurements of the paper's rig with the friction that
the method assumes, zeta = {:.5f} and F0 = {:.0f} N: {} measurements of each experiment, each with other noise.

* noise: standard deviation of one reading of x; that of y is a tenth of it, that of the acceleration wn^2 times it
* usable: share of the estimates that are usable, in per cent
* bias, spread: mean error and standard deviation of the method's own values, in per cent of the true value; for
  methods that read histories `identify` reports the middle of the interval instead
* coverage: share of 95 % intervals that hold the true value, in per cent; an exclamation mark stands where it is
  not between {:.0f} and {:.0f} %, a dash where the method gives no intervals

The experiments:

)",
      truth().zeta, truth().F0, cells.empty() ? 0 : cells.front().seeds, 100.0 * least_coverage,
      100.0 * most_coverage);
  for (const Experiment& experiment : experiments())
    page += fmt::format("* {}: {}\n", experiment.name, experiment.meaning);
  page +=
      "\n| method | experiment | noise | usable | zeta bias | spread | coverage | F0 bias | spread | coverage |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Cell& cell : cells) page += accuracy_row(cell);
  const Coverage covered = coverage(cells);
  return page + fmt::format("\n{} of the {} coverages lie outside these limits.\n", covered.outside.size(),
                            covered.claimed);
}

}  // namespace dualdamp::bench
