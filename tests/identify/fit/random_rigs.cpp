#include "tests/identify/fit/random_rigs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "sim/motion/simulate.hpp"

namespace dualdamp::test {

namespace {

constexpr double mass = 1.0;
constexpr double stiffness = 1000.0;
constexpr double amplitude = 5e-3;

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : stream_{seed, 910} {}
  double between(double low, double high) { return low + (high - low) * stream_.uniform(next_++); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(between(0.0, static_cast<double>(count))));
  }

 private:
  core::RandomStream stream_;
  std::uint64_t next_ = 0;
};

friction::ParameterValues values_of(const std::string& law, double kinetic, double length, double speed,
                                    Draws& draws) {
  friction::ParameterValues values;
  values.set("kinetic", kinetic);
  const double static_level = kinetic * draws.between(1.05, 1.8);
  const double slow = speed * draws.log_between(0.02, 0.4);
  const double slope = kinetic / (length * draws.log_between(0.01, 0.2));
  const double damping = draws.between(0.05, 0.6) * std::sqrt(slope * mass);
  if (law == "coulomb" || law == "stribeck" || law == "lugre") values.set("static", static_level);
  if (law == "stribeck" || law == "lugre") values.set("stribeck_velocity", slow);
  if (law == "lugre") {
    values.set("sigma0", slope);
    values.set("sigma1", damping);
  }
  if (law == "dahl") values.set("sigma0", slope);
  if (law == "contact_compliance") values.set("contact_stiffness", slope);
  return values;
}

void add_signal(const sim::History& motion, double sim::Sample::* member, double noise, std::uint64_t stream,
                std::vector<double>& signal, std::vector<double>& drawn) {
  double squares = 0.0;
  for (const sim::Sample& sample : motion.samples) squares += sample.*member * (sample.*member);
  const double deviation = noise * std::sqrt(squares / static_cast<double>(motion.samples.size()));
  const core::RandomStream draws{stream, 911};
  double errors = 0.0;
  for (std::size_t i = 0; i < motion.samples.size(); ++i) {
    const double error = deviation * draws.normal(i);
    errors += error * error;
    signal.push_back(motion.samples[i].*member + error);
  }
  drawn.push_back(std::sqrt(errors / static_cast<double>(motion.samples.size())));
}

/// What is measured of the true rig, with noise of its own.
void measure(std::uint64_t seed, double duration, const sim::InitialState& initial, RandomRig& rig) {
  sim::Model model = *identify::model_of(rig.truth);
  model.initial = initial;
  model.solver.tolerance = 1e-11;
  identify::History history;
  constexpr double of_period = 60.0;
  history.sample_rate = of_period * std::sqrt(stiffness / mass) / (2.0 * std::numbers::pi);
  const sim::History motion = sim::simulate(model, {.duration = duration, .sample_rate = history.sample_rate});
  if (!motion.outcome.ok()) throw std::runtime_error("a random rig has no motion: " + motion.outcome.reason);
  rig.drawn_rms.clear();
  if (rig.signals.find('x') != std::string::npos)
    add_signal(motion, &sim::Sample::x, rig.noise, 3 * seed, history.x, rig.drawn_rms);
  if (rig.signals.find('v') != std::string::npos)
    add_signal(motion, &sim::Sample::v, rig.noise, 3 * seed + 1, history.v, rig.drawn_rms);
  if (rig.signals.find('a') != std::string::npos)
    add_signal(motion, &sim::Sample::a, rig.noise, 3 * seed + 2, history.a, rig.drawn_rms);
  rig.record.histories = {std::move(history)};
}

}  // namespace

RandomRig random_rig(const std::string& law, MotionKind kind, std::uint64_t seed, const std::string& signals) {
  Draws draws(seed);
  RandomRig rig;
  const double natural = std::sqrt(stiffness / mass);
  const double zeta = draws.log_between(0.003, 0.1);
  rig.truth.known.oscillator = {
      .mass = mass, .stiffness = stiffness, .damping = 2.0 * zeta * std::sqrt(mass * stiffness)};
  rig.truth.known.solver.tolerance = 1e-9;
  double kinetic = 0.0;
  double speed = natural * amplitude;
  sim::InitialState initial;
  double duration = 0.0;
  if (kind == MotionKind::forced) {
    const double ratio = draws.log_between(0.3, 1.6);
    rig.truth.known.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = ratio * natural};
    kinetic = stiffness * amplitude * draws.log_between(0.05, 0.9);
    speed *= ratio;
    rig.periods = std::floor(draws.between(6.0, 25.0));
    duration = rig.periods * 2.0 * std::numbers::pi / (ratio * natural);
  } else {
    rig.periods = draws.between(2.0, 25.0);
    kinetic = stiffness * amplitude / (4.0 * rig.periods);
    initial.position = amplitude;
    duration = (rig.periods + 1.0) * 2.0 * std::numbers::pi / natural;
  }
  rig.truth.laws.push_back({friction::find_law(law), values_of(law, kinetic, amplitude, speed, draws)});
  static const std::vector<std::string> kinds = {"x", "v", "xv", "x"};
  rig.signals = signals.empty() ? kinds[draws.below(kinds.size())] : signals;
  rig.noise = draws.below(2) == 0 ? 1e-3 : 1e-2;

  measure(seed, duration, initial, rig);
  rig.sought = rig.truth;
  rig.sought.known.oscillator.damping = identify::unknown;
  rig.sought.laws.front().values = {};
  return rig;
}

RandomRig driven_again(const RandomRig& rig, double factor, std::uint64_t seed) {
  RandomRig again = rig;
  again.truth.known.excitation.amplitude *= factor;
  again.sought.known.excitation.amplitude *= factor;
  const double duration = rig.periods * 2.0 * std::numbers::pi / rig.truth.known.excitation.frequency;
  measure(seed, duration, {}, again);
  return again;
}

identify::Experiments experiments_of(const RandomRig& rig) {
  std::string fault;
  identify::Experiments experiments = identify::experiments_of(rig.record, {.name = "random"}, fault);
  if (!fault.empty()) throw std::runtime_error("a random record cannot be used: " + fault);
  return experiments;
}

identify::Fit fit_of(const RandomRig& rig, bool profile) {
  const identify::Experiments experiments = experiments_of(rig);
  std::string fault;
  std::vector<std::string> faults;
  std::vector<identify::FitParameter> parameters = identify::unstated_parameters(rig.sought, faults);
  if (rig.sought.laws.front().entry->name == "coulomb" && rig.truth.laws.front().values.has("static")) {
    std::vector<identify::FitParameter> levels =
        identify::named(identify::parameters_of(rig.sought), "static", fault);
    parameters.push_back(levels.at(0));
    identify::arrange(rig.sought, parameters);
  }
  if (!fault.empty() || !faults.empty()) throw std::runtime_error("a random rig cannot be fitted: " + fault);
  for (const identify::RecordParameter each : experiments.at(0)->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments[0], 0, each, true));
  return identify::fit_rig(rig.sought, std::move(parameters), experiments, {.profile = profile});
}

identify::Prediction predicted_by(const identify::Fit& fit, const RandomRig& second) {
  identify::Rig rig = fit.rig;
  rig.known.excitation = second.truth.known.excitation;
  std::vector<identify::FitParameter> parameters;
  for (const identify::FittedParameter& fitted : fit.parameters) parameters.push_back(fitted.parameter);
  return identify::predict_records(rig, parameters, shared_uncertainty(fit), experiments_of(second));
}

bool ends_at_noise(const RandomRig& rig, const identify::Fit& fit) {
  if (!fit.outcome.ok()) return false;
  constexpr double allowed = 1.02;
  for (std::size_t s = 0; s < fit.signals.size(); ++s)
    if (fit.signals[s].rms > allowed * rig.drawn_rms[s]) return false;
  return true;
}

}  // namespace dualdamp::test
