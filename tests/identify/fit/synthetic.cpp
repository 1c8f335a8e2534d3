#include "tests/identify/fit/synthetic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::test {

using friction::ParameterValues;

namespace {

std::vector<LawCase> usual_cases() {
  using List = std::vector<ParameterValues>;
  return {
      {"coulomb", {{"kinetic", 1.0}}, {"kinetic"}},
      {"stribeck",
       {{"kinetic", 1.0}, {"static", 1.6}, {"stribeck_velocity", 0.05}},
       {"kinetic", "static", "stribeck_velocity"}},
      {"dahl", {{"kinetic", 1.0}, {"sigma0", 5000.0}}, {"kinetic", "sigma0"}},
      {"lugre",
       {{"kinetic", 1.0}, {"static", 1.5}, {"stribeck_velocity", 0.03}, {"sigma0", 5000.0}, {"sigma1", 20.0}},
       {"kinetic", "static", "stribeck_velocity", "sigma0", "sigma1"}},
      {"generalized_maxwell_slip",
       {{"elements", List{{{"stiffness", 6000.0}, {"share", 0.4}}, {{"stiffness", 1000.0}, {"share", 0.6}}}},
        {"kinetic", 1.0},
        {"static", 1.5},
        {"stribeck_velocity", 0.05},
        {"attraction", 100.0}},
       {"elements", "kinetic", "static", "stribeck_velocity", "attraction"}},
      {"contact_compliance", {{"kinetic", 1.0}, {"contact_stiffness", 3000.0}}, {"kinetic", "contact_stiffness"}},
      {"bouc_wen",
       {{"limit", 1.0}, {"stiffness", 3000.0}, {"exponent", 1.5}},
       {"limit", "friction.stiffness", "exponent"}},
      {"elasto_plastic",
       {{"kinetic", 1.0},
        {"static", 1.5},
        {"stribeck_velocity", 0.05},
        {"sigma0", 5000.0},
        {"sigma1", 20.0},
        {"elastic_limit", 1e-4}},
       {"kinetic", "static", "stribeck_velocity", "sigma0"}},
      {"friction_lag",
       {{"kinetic", 1.0}, {"static", 1.6}, {"stribeck_velocity", 0.05}, {"lag", 0.005}},
       {"kinetic", "static", "stribeck_velocity", "lag"}},
      {"iwan", {{"stiffness", 2000.0}, {"limit", 2.0}, {"count", 20.0}}, {"friction.stiffness", "limit"}},
      {"reset_integrator",
       {{"kinetic", 1.0}, {"stiffness", 5000.0}, {"static_gain", 0.5}},
       {"kinetic", "friction.stiffness", "static_gain"}},
      {"viscous_power",
       {{"coefficient", 3.0}, {"exponent", 1.7}, {"reference_velocity", 0.3}},
       {"coefficient", "exponent"}},
      {"viscous_saturating",
       {{"coefficient", 15.0}, {"saturation_velocity", 0.2}},
       {"coefficient", "saturation_velocity"}}};
}

std::vector<LawCase> further_cases() {
  return {
      {"attached_mass",
       {{"mass", 0.2}, {"stiffness", 300.0}, {"damping", 0.5}},
       {"friction.mass", "friction.stiffness", "friction.damping"}},
      // The draws of the seed are the same for each stiffness, not for each snap distance.
      {"bristle",
       {{"stiffness", 40.0}, {"snap_distance", 2e-3}, {"count", 30.0}, {"seed", 1.0}},
       {"friction.stiffness"}},
      {"asymmetric_coulomb",
       {{"kinetic_forward", 1.2}, {"kinetic_backward", 0.8}, {"viscous_forward", 2.0}, {"viscous_backward", 1.0}},
       {"kinetic_forward", "kinetic_backward", "viscous_forward", "viscous_backward"}},
      {"free_play", {{"kinetic", 1.0}, {"play", 1e-3}}, {"kinetic", "play"}},
      {"gap_spring", {{"stiffness", 2000.0}, {"gap", 3e-3}}, {"friction.stiffness", "gap"}},
      {"iwan_four_parameter",
       {{"stiffness", 2000.0}, {"limit", 2.0}, {"exponent", -0.3}, {"beta", 0.5}, {"count", 30.0}},
       {"friction.stiffness", "limit", "exponent", "beta"}},
      {"rate_state",
       {{"normal_force", 10.0},
        {"mu0", 0.1},
        {"a", 0.01},
        {"b", 0.015},
        {"slip_distance", 1e-3},
        {"reference_velocity", 0.01}},
       {"mu0", "a", "b", "slip_distance"}},
      {"normal_vibration",
       {{"mu", 0.1},
        {"weight", 10.0},
        {"normal_mass", 0.1},
        {"static_approach", 1e-4},
        {"normal_damping_ratio", 0.1},
        {"lift", 10.0},
        {"lift_velocity", 0.5}},
       {"mu", "lift"}}};
}

std::vector<LawCase> modified_cases() {
  const std::vector<ParameterValues> warming = {{{"power", 0.3}, {"time_constant", 0.5}}};
  const ParameterValues stribeck = {{"kinetic", 1.0}, {"static", 1.6}, {"stribeck_velocity", 0.05}, {"drift", 0.1}};
  return {{.law = "coulomb",
           .truth = {{"kinetic", 1.0}, {"drift", -0.1}},
           .sought = {"kinetic", "drift"},
           .modifier = "drift"},
          {.law = "coulomb",
           .truth = {{"kinetic", 1.0}, {"position_slope", 40.0}},
           .sought = {"kinetic", "position_slope"},
           .modifier = "position_slope"},
          {.law = "coulomb",
           .truth = {{"kinetic", 2.0}, {"warming", warming}},
           .sought = {"kinetic", "warming.power", "warming.time_constant"},
           .modifier = "warming"},
          {.law = "dahl",
           .truth = {{"kinetic", 1.0}, {"sigma0", 5000.0}, {"position_slope", 40.0}},
           .sought = {"kinetic", "sigma0", "position_slope"},
           .modifier = "position_slope"},
          {.law = "stribeck",
           .truth = stribeck,
           .sought = {"kinetic", "static", "stribeck_velocity", "drift"},
           .modifier = "drift"}};
}

}  // namespace

std::string name_of(const LawCase& law) { return law.modifier.empty() ? law.law : law.law + "+" + law.modifier; }

const std::vector<LawCase>& law_cases() {
  static const std::vector<LawCase> cases = [] {
    std::vector<LawCase> all = usual_cases();
    for (LawCase& further : further_cases()) all.push_back(std::move(further));
    for (LawCase& modified : modified_cases()) all.push_back(std::move(modified));
    return all;
  }();
  return cases;
}

const LawCase& law_case_of(const std::string& law) {
  const auto found = std::ranges::find(law_cases(), law, name_of);
  if (found == law_cases().end()) throw std::invalid_argument("there is no case of " + law);
  return *found;
}

bool shows(const LawCase& law, RecordKind kind) {
  // Of a random law no motion is periodic.
  return kind != RecordKind::pairs || !friction::find_law(law.law)->is_random;
}

identify::Rig rig_with(const LawCase& law) {
  identify::Rig rig;
  rig.known.oscillator = {.mass = 1.0, .stiffness = 1000.0, .damping = 1.0};
  rig.known.excitation = {.type = sim::ExcitationType::base_harmonic,
                          .amplitude = law.amplitude,
                          .frequency = 2.0 * std::numbers::pi * 4.0};
  rig.known.solver.tolerance = 1e-9;
  rig.laws.push_back({friction::find_law(law.law), law.truth});
  return rig;
}

identify::Record history_of(const identify::Rig& rig, const HistoryPlan& plan, std::uint64_t seed) {
  sim::Model model = *identify::model_of(rig);
  model.initial = plan.initial;
  model.solver.tolerance = 1e-11;
  const sim::History motion = sim::simulate(model, {.duration = plan.duration, .sample_rate = plan.rate});
  identify::History history;
  history.sample_rate = plan.rate;
  const core::RandomStream of_x{seed, 900};
  const core::RandomStream of_v{seed, 901};
  for (std::size_t i = 0; i < motion.samples.size(); ++i) {
    history.x.push_back(motion.samples[i].x + plan.noise_x * of_x.normal(i));
    if (plan.noise_v > 0.0) history.v.push_back(motion.samples[i].v + plan.noise_v * of_v.normal(i));
  }
  identify::Record record;
  record.histories.push_back(std::move(history));
  return record;
}

identify::Record decay_of_rig(identify::Rig rig, double position, int peaks, double noise, std::uint64_t seed) {
  rig.known.excitation = {};
  sim::Model model = *identify::model_of(rig);
  model.initial = {position, 0.0};
  const sim::FreeDecay decay = sim::free_decay(model, peaks);
  identify::DecayRecord record;
  const core::RandomStream draws{seed, 902};
  for (std::size_t i = 0; i < decay.extremes.size(); ++i) {
    record.extremes.push_back(decay.extremes[i].x + noise * draws.normal(i));
    record.times.push_back(decay.extremes[i].t + 1e-4 * draws.normal(1000 + i));
  }
  identify::Record result;
  result.decay = std::move(record);
  return result;
}

identify::Record steady_states_of(const identify::Rig& rig, const std::vector<std::pair<double, double>>& levels,
                                  double noise, double noise_phase, std::uint64_t seed) {
  sim::Model model = *identify::model_of(rig);
  identify::PairRecord record;
  const core::RandomStream draws{seed, 903};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::tie(model.excitation.amplitude, model.excitation.frequency) = levels[i];
    const sim::SteadyState state = sim::steady_state(model);
    record.pairs.push_back({.Y = levels[i].first,
                            .x = state.amplitude + noise * draws.normal(2 * i),
                            .number = static_cast<int>(i) + 1,
                            .omega = levels[i].second,
                            .phase = state.phase + noise_phase * draws.normal(2 * i + 1)});
  }
  identify::Record result;
  result.pairs = std::move(record);
  return result;
}

identify::Record response_of(const identify::Rig& rig, double amplitude, const std::vector<double>& frequencies,
                             double noise, double noise_phase, std::uint64_t seed) {
  std::vector<std::pair<double, double>> levels;
  for (const double frequency : frequencies) levels.emplace_back(amplitude, frequency);
  return steady_states_of(rig, levels, noise, noise_phase, seed);
}

identify::Record loop_of(const identify::Rig& rig, double amplitude, double noise, std::uint64_t seed) {
  constexpr double rate = 500.0;
  constexpr int finer = 20;
  constexpr int samples = 1000;
  identify::History dense;
  dense.sample_rate = rate * finer;
  for (int i = 0; i <= samples * finer; ++i) {
    const double t = i / dense.sample_rate;
    constexpr double slow = 2.0 * std::numbers::pi * 2.0;
    constexpr double fast = 2.7 * slow;
    dense.x.push_back(amplitude * (std::sin(slow * t) + 0.4 * std::sin(fast * t)));
    dense.v.push_back(amplitude * (slow * std::cos(slow * t) + 0.4 * fast * std::cos(fast * t)));
  }
  dense.force.assign(dense.x.size(), 0.0);
  identify::Record record;
  record.histories.push_back(dense);
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  Eigen::VectorXd force;
  if (!fault.empty() || !experiments.front()->predict(*identify::model_of(loop_alone(rig)), {}, force))
    throw std::runtime_error("a law has no loop: " + fault);
  identify::History loop{.sample_rate = rate};
  const core::RandomStream draws{seed, 904};
  for (int i = 0; i <= samples; ++i) {
    const auto at = static_cast<std::size_t>(i * finer);
    loop.x.push_back(dense.x[at]);
    loop.v.push_back(dense.v[at]);
    loop.force.push_back(force[i * finer] + noise * draws.normal(static_cast<std::uint64_t>(i)));
  }
  record.histories = {loop};
  return record;
}

identify::Rig loop_alone(identify::Rig rig) {
  rig.known.oscillator = {.mass = identify::unknown, .stiffness = identify::unknown, .damping = identify::unknown};
  rig.known.excitation = {};
  return rig;
}

std::vector<identify::FitParameter> sought_in(identify::Rig& rig, const std::vector<std::string>& names,
                                              double factor) {
  std::vector<identify::FitParameter> parameters;
  const std::vector<identify::FitParameter> all = identify::parameters_of(rig);
  for (const std::string& name : names) {
    std::string fault;
    for (identify::FitParameter& found : identify::named(all, name, fault)) {
      if (!found.path.ends_with("share")) found.stated *= factor;
      parameters.push_back(std::move(found));
    }
    if (!fault.empty()) throw std::invalid_argument(fault);
  }
  identify::arrange(rig, parameters);
  return parameters;
}

namespace {

identify::Fit fit_of(identify::Rig rig, const std::vector<std::string>& sought,
                     const identify::Experiments& experiments, bool profile) {
  constexpr double off = 1.15;
  std::vector<identify::FitParameter> parameters = sought_in(rig, sought, off);
  for (const identify::RecordParameter each : experiments.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  return identify::fit_rig(rig, std::move(parameters), experiments, {.profile = profile});
}

identify::Experiments experiments_of(const identify::Record& record, RecordKind kind) {
  std::string fault;
  identify::Experiments experiments =
      identify::experiments_of(record, {.name = "synthetic", .loop = kind == RecordKind::loop}, fault);
  if (!fault.empty()) throw std::invalid_argument(fault);
  return experiments;
}

/// Sum over the signals of N ln(rms).
double deviance_of(const identify::Experiments& experiments, const Eigen::VectorXd& outputs) {
  double sum = 0.0;
  Eigen::Index at = 0;
  for (const identify::Signal& signal : experiments.front()->signals) {
    const auto count = static_cast<Eigen::Index>(signal.measured.size());
    const Eigen::Map<const Eigen::VectorXd> measured(signal.measured.data(), count);
    sum += static_cast<double>(count) * std::log((outputs.segment(at, count) - measured).norm());
    at += count;
  }
  return sum;
}

}  // namespace

identify::Fit fit_of(const LawCase& law, std::uint64_t seed, const HistoryPlan& plan, bool profile) {
  const identify::Rig rig = rig_with(law);
  return fit_of(rig, law.sought, experiments_of(history_of(rig, plan, seed), RecordKind::history), profile);
}

Laboratory::Laboratory(const LawCase& law, RecordKind kind)
    : law_(law), kind_(kind), rig_(kind == RecordKind::loop ? loop_alone(rig_with(law)) : rig_with(law)) {}

identify::Record Laboratory::record(std::uint64_t seed) const {
  constexpr double noise_x = 1e-5;
  constexpr double noise_phase = 3e-3;
  constexpr double noise_force = 0.01;
  const identify::Rig rig = rig_with(law_);
  if (kind_ == RecordKind::history) return history_of(rig, {.noise_x = noise_x}, seed);
  if (kind_ == RecordKind::loop) return loop_of(rig, law_.amplitude, noise_force, seed);
  std::vector<std::pair<double, double>> levels;
  constexpr int count = 16;
  for (int i = 0; i < count; ++i)
    levels.emplace_back(law_.amplitude * (0.4 + 0.08 * i), rig.known.excitation.frequency);
  return steady_states_of(rig, levels, noise_x, noise_phase, seed);
}

KnownFit Laboratory::fit(std::uint64_t seed, bool profile) const {
  // Draws of its own for each law: the luck of one seed is not that of all laws.
  const auto number = static_cast<std::uint64_t>(&law_ - law_cases().data());
  const identify::Experiments experiments = experiments_of(record(1000 * number + seed), kind_);
  KnownFit known{fit_of(rig_, law_.sought, experiments, profile)};
  Eigen::VectorXd truth;
  if (!experiments.front()->predict(*identify::model_of(rig_), {}, truth))
    throw std::runtime_error("the true rig of " + law_.law + " has no motion");
  known.leaves_more_than_the_truth =
      known.fit.outcome.ok() && deviance_of(experiments, known.fit.outputs) > deviance_of(experiments, truth);
  return known;
}

identify::Rig rig_of(const SmallRecord& plan) {
  identify::Rig rig = rig_with(law_case_of("coulomb"));
  if (plan.is_decay) {
    rig.known.oscillator.damping = 2.0;
    rig.known.excitation = {};
    return rig;
  }
  rig.known.oscillator = {.mass = 1.042, .stiffness = 1568.0, .damping = 8.0};
  rig.laws.front().values = {{"kinetic", 4.4}};
  return rig;
}

identify::Fit fit_of(const SmallRecord& plan, std::uint64_t seed) {
  constexpr double noise = 2e-5;
  constexpr double noise_phase = 3e-3;
  constexpr double release = 0.04;
  constexpr double frequency = 38.0;
  const identify::Rig rig = rig_of(plan);
  identify::Record record;
  if (plan.is_decay) {
    record = decay_of_rig(rig, release, plan.readings, noise, seed);
    if (!plan.has_second) record.decay->times.clear();
  } else {
    std::vector<std::pair<double, double>> levels;
    for (int i = 0; i < plan.readings; ++i)
      levels.emplace_back(4.8e-3 + 2.2e-3 * i / (plan.readings - 1), frequency);
    record = steady_states_of(rig, levels, noise, noise_phase, seed);
    if (!plan.has_second)
      for (identify::Pair& pair : record.pairs->pairs) pair.phase = identify::unknown;
  }
  return fit_of(rig, {"kinetic", "damping"}, experiments_of(record, RecordKind::pairs), false);
}

double truth_of(const identify::Rig& rig, const std::string& name) {
  std::string fault;
  const std::vector<identify::FitParameter> found = identify::named(identify::parameters_of(rig), name, fault);
  return found.size() == 1 ? found.front().stated : 0.0;
}

const identify::FittedParameter* find_fitted(const identify::Fit& fit, const std::string& name) {
  const auto found =
      std::ranges::find(fit.parameters, name, [](const auto& fitted) { return fitted.parameter.name; });
  return found == fit.parameters.end() ? nullptr : &*found;
}

const identify::FittedParameter& fitted(const identify::Fit& fit, const std::string& name) {
  const identify::FittedParameter* found = find_fitted(fit, name);
  if (found == nullptr) throw std::invalid_argument("there is no parameter " + name);
  return *found;
}

}  // namespace dualdamp::test
