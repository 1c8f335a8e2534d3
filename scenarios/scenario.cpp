#include "scenarios/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "core/numbers.hpp"
#include "core/provenance.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/checks.hpp"
#include "scenarios/files.hpp"
#include "scenarios/format.hpp"
#include "scenarios/formulas.hpp"
#include "scenarios/law_values.hpp"
#include "scenarios/reader.hpp"
#include "sim/engine/engine.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::scenarios {

namespace {

/// A file for a newer program would drown in complaints about keys this one does not know.
void refuse_other_schema(const Document& document) {
  const Entry* entry = document.root().find("schema");
  if (entry == nullptr || entry->value.text == schema_name || !entry->value.text.starts_with("dualdamp/")) return;
  throw core::InputError(
      core::Diagnostic{document.locate(entry->value.place),
                       "this file needs a version of dualdamp that reads '" + entry->value.text + "'",
                       std::string(schema_name),
                       entry->value.text,
                       {}});
}

double number_or(const Json& section, const char* key, double fallback) {
  return section.contains(key) ? number(section.at(key)) : fallback;
}

/// The decimal number a person means: 0 to 0.6 in six steps passes 0.1, not 0.09999999999999999.
double plain(double value) {
  constexpr int digits = 14;
  return core::parse_number(core::format_number(value, digits)).value.value_or(value);
}

std::vector<double> grid_values(const Json& grid) {
  std::vector<double> values;
  if (grid.is_array()) {
    for (const Json& value : grid) values.push_back(number(value));
    return values;
  }
  const double from = number(grid.at("from"));
  const double to = number(grid.at("to"));
  const auto count = grid.at("count").get<std::size_t>();
  const bool is_log = grid.at("spacing") == "log";
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(is_log ? from * std::pow(to / from, share) : plain(from + share * (to - from)));
  }
  values.front() = from;
  values.back() = to;
  return values;
}

sim::Oscillator oscillator(const Json& system) {
  return {number_or(system, "mass", identify::unknown), number_or(system, "stiffness", identify::unknown),
          number_or(system, "damping", 0.0),
          system.at("damper_to") == "base" ? sim::DamperTo::base : sim::DamperTo::ground,
          number_or(system, "cubic_stiffness", 0.0)};
}

sim::Excitation excitation(const Json& section) {
  static const std::vector<std::pair<std::string, sim::ExcitationType>> types = {
      {"none", sim::ExcitationType::none},
      {"base_harmonic", sim::ExcitationType::base_harmonic},
      {"force_harmonic", sim::ExcitationType::force_harmonic},
      {"base_ramp", sim::ExcitationType::base_ramp},
      {"force_ramp", sim::ExcitationType::force_ramp},
      {"base_noise", sim::ExcitationType::base_noise},
      {"force_noise", sim::ExcitationType::force_noise}};
  sim::Excitation result;
  result.type =
      std::ranges::find(types, section.at("type").get<std::string>(), &decltype(types)::value_type::first)->second;
  result.amplitude = number_or(section, "amplitude", 0.0);
  result.frequency = number_or(section, "frequency", 0.0);
  result.phase = number_or(section, "phase", 0.0);
  result.offset = number_or(section, "offset", 0.0);
  result.slope = number_or(section, "velocity", number_or(section, "rate", 0.0));
  if (result.is_noise())
    result.noise = {number(section.at("intensity")), number(section.at("bandwidth")),
                    section.at("seed").get<std::uint64_t>()};
  if (section.contains("harmonics"))
    for (const Json& harmonic : section.at("harmonics"))
      result.harmonics.push_back(
          {harmonic.at("order").get<int>(), number(harmonic.at("amplitude")), number(harmonic.at("phase"))});
  return result;
}

std::vector<friction::Law> laws(const Json& section) {
  const friction::LawEntry* entry = friction::find_law(section.at("law").get<std::string>());
  return entry->make(law_values(entry->parameters, section));
}

/// One law, or a list of laws in parallel.
std::vector<friction::Law> friction_of(const Json& section) {
  if (!section.is_array()) return laws(section);
  std::vector<friction::Law> result;
  for (const Json& item : section) std::ranges::copy(laws(item), std::back_inserter(result));
  return result;
}

/// What the laws warn of.
std::vector<std::string> law_warnings(const Json& section) {
  std::vector<std::string> result;
  for (const Json& item : section.is_array() ? section : Json::array({section})) {
    const friction::LawEntry* entry = friction::find_law(item.at("law").get<std::string>());
    if (entry->warnings == nullptr) continue;
    for (const std::string& warning : entry->warnings(law_values(entry->parameters, item)))
      result.push_back(std::string(entry->name) + ": " + warning);
  }
  return result;
}

sim::Solver solver(const Json& numerics) {
  static const std::map<std::string, sim::SolverKind> kinds = {{"automatic", sim::SolverKind::automatic},
                                                               {"explicit", sim::SolverKind::explicit_steps},
                                                               {"implicit", sim::SolverKind::implicit_steps}};
  return {kinds.at(numerics.at("solver").get<std::string>()),
          number_or(numerics, "tolerance", sim::Solver{}.tolerance)};
}

/// Closure of steady states: that of the engine's own accuracy.
double tolerance_of(const Json& values, const sim::Model& model) {
  const double usual = sim::is_exact(model) ? sim::SteadyStateOptions{}.tolerance : model.solver.tolerance;
  return values.contains("numerics") ? number_or(values.at("numerics"), "tolerance", usual) : usual;
}

sim::Model model(const Json& values) {
  sim::Model result;
  const Json& system = values.at("system");
  result.oscillator = oscillator(system);
  if (values.contains("excitation")) result.excitation = excitation(values.at("excitation"));
  if (system.contains("friction")) result.friction = friction_of(system.at("friction"));
  if (values.contains("initial"))
    result.initial = {number(values.at("initial").at("position")), number(values.at("initial").at("velocity"))};
  if (values.contains("numerics")) result.solver = solver(values.at("numerics"));
  return result;
}

Measurement measurement(const Json& section, const sim::Model& model) {
  Measurement result;
  const auto type = section.at("type").get<std::string>();
  if (type == "free_decay") {
    result.kind = MeasurementKind::free_decay;
    result.peaks = section.at("peaks").get<int>();
    return result;
  }
  if (section.contains("amplitudes")) result.amplitudes = grid_values(section.at("amplitudes"));
  if (section.contains("frequencies")) result.frequencies = grid_values(section.at("frequencies"));
  result.sweeps = section.at("sweeps").get<int>();
  if (section.contains("friction_drift")) {
    const Json& drift = section.at("friction_drift");
    result.drift = {number(drift.at("rate")), number(drift.at("walk")), drift.at("seed").get<std::uint64_t>()};
  }
  if (type != "simulate") return result;
  result.kind = MeasurementKind::histories;
  const double period = 2.0 * std::numbers::pi / model.excitation.frequency;
  result.duration =
      section.contains("cycles") ? number(section.at("cycles")) * period : number(section.at("duration"));
  result.settle = number(section.at("settle"));
  if (section.contains("signals")) {
    const Json& signals = section.at("signals");
    result.with_v = std::ranges::find(signals, "v") != signals.end();
    result.with_a = std::ranges::find(signals, "a") != signals.end();
  }
  return result;
}

identify::Sensors sensors(const Json& section) {
  identify::Sensors result;
  result.sample_rate = number_or(section, "sample_rate", 0.0);
  result.average_cycles = section.at("average_cycles").get<int>();
  const auto read = [&](const char* name, identify::Sensor& sensor) {
    if (!section.contains(name)) return;
    const Json& values = section.at(name);
    sensor = {.noise = number(values.at("noise")),
              .resolution = number(values.at("resolution")),
              .gain_error = number(values.at("gain_error")),
              .phase_lag = number_or(values, "phase_lag", 0.0),
              .delay = number_or(values, "delay", 0.0),
              .clipping = number_or(values, "clipping", sensor.clipping)};
  };
  read("y", result.y);
  read("x", result.x);
  read("v", result.v);
  read("a", result.a);
  read("force", result.force);
  return result;
}

Identify identify_question(const Json& section, const sim::Model& model,
                           std::optional<identify::MeasuredRecord> data) {
  Identify result;
  result.constants = {model.oscillator.mass, model.oscillator.stiffness,
                      model.excitation.is_harmonic() ? model.excitation.frequency : identify::unknown};
  for (const Json& name : section.at("methods"))
    result.methods.push_back(identify::find_method(name.get<std::string>()));
  result.options.approximate_G = section.at("approximate_G").get<bool>();
  result.options.zero_offset = section.at("zero_offset").get<bool>();
  result.options.sigma_x = number_or(section, "sigma_x", 0.0);
  result.options.sigma_Y = number_or(section, "sigma_Y", 0.0);
  result.options.profile = section.at("profile").get<bool>();
  result.options.free_natural_frequency = section.at("free_natural_frequency").get<bool>();
  result.options.least_speed = number_or(section, "least_speed", result.options.least_speed);
  result.options.forgetting = number_or(section, "forgetting", result.options.forgetting);
  result.options.sign_width = number_or(section, "sign_width", result.options.sign_width);
  if (section.contains("bootstrap")) result.options.bootstrap = section.at("bootstrap").get<int>();
  if (section.contains("cutoffs"))
    for (const Json& cutoff : section.at("cutoffs"))
      result.options.cutoffs.push_back(number(cutoff) / (2.0 * std::numbers::pi));
  if (section.contains("pairs")) {
    result.options.first_pair = section.at("pairs")[0].get<int>();
    result.options.second_pair = section.at("pairs")[1].get<int>();
  }
  if (data) {
    result.source = std::move(data->record);
    result.data_file = section.at("data").get<std::string>();
    result.data_sha256 = data->sha256;
    result.data_warnings = std::move(data->warnings);
    return result;
  }
  result.source = measurement(section.at("measurement"), model);
  if (section.contains("sensors")) {
    result.sensors = sensors(section.at("sensors"));
    result.sensor_seed = section.at("sensors").at("seed").get<std::uint64_t>();
  }
  return result;
}

/// `system`: its friction is the truth, one Coulomb law (checks.cpp).
StressTest stress_test(const Json& section, const Json& system, double frequency) {
  StressTest result;
  result.F0 = number(system.at("friction").at("kinetic"));
  for (const Json& name : section.at("laws")) result.laws.push_back(sim::find_departure(name.get<std::string>()));
  result.severities = grid_values(section.at("severities"));
  std::ranges::sort(result.severities);
  for (const Json& range : section.at("ranges"))
    result.ranges.push_back(
        {range.at("name").get<std::string>(), grid_values(range.at("amplitudes")),
         range.contains("frequencies") ? grid_values(range.at("frequencies")) : std::vector<double>{frequency}});
  if (section.contains("sensors"))
    for (const Json& set : section.at("sensors"))
      result.sensors.push_back({set.at("name").get<std::string>(), sensors(set)});
  else
    result.sensors.push_back({"perfect", {}});
  result.seeds = section.at("seeds").get<int>();
  if (section.contains("decay"))
    result.decay = {number(section.at("decay").at("displacement")), section.at("decay").at("peaks").get<int>()};
  for (const Json& name : section.at("methods"))
    result.methods.push_back(identify::find_method(name.get<std::string>()));
  return result;
}

/// `system`: its friction is what the rig is believed to have, one Coulomb law (checks.cpp).
MechanismStudy mechanism_study(const Json& section, const Json& system) {
  MechanismStudy result;
  result.friction = {number(system.at("friction").at("kinetic")), number(system.at("damping"))};
  for (const Json& item : section.at("estimates"))
    result.estimates.push_back({number(item.at("share")), number(item.at("zeta")), number(item.at("F0")),
                                number(item.at("zeta_std")), number(item.at("F0_std"))});
  std::ranges::sort(result.estimates, std::ranges::greater{}, &PartEstimate::share);
  if (section.contains("amplitudes")) result.amplitudes = grid_values(section.at("amplitudes"));
  std::ranges::sort(result.amplitudes);
  result.levels = section.contains("levels") ? section.at("levels").get<std::size_t>() : result.amplitudes.size();
  for (const Json& name : section.at("mechanisms"))
    result.mechanisms.push_back(sim::find_mechanism(name.get<std::string>()));
  for (const Json& item : section.at("plausible")) {
    const sim::Mechanism* mechanism = sim::find_mechanism(item.at("mechanism").get<std::string>());
    PlausibleRig rig{mechanism, item.at("case").get<std::string>(), {}, item.at("because").get<std::string>()};
    for (const sim::MechanismParameter& parameter : mechanism->parameters)
      rig.values.push_back(number(item.at(std::string(parameter.name))));
    result.plausible.push_back(std::move(rig));
  }
  if (!section.contains("decay")) return result;
  const Json& decay = section.at("decay");
  const auto segment = [&](const char* name) {
    return MeasuredDecay::Segment{number(decay.at(name).at("zeta")), number(decay.at(name).at("x_f"))};
  };
  result.decay = {number(decay.at("stiffness")), number(decay.at("displacement")), segment("high"), segment("low")};
  return result;
}

BranchQuestion branch(sim::BranchParameter parameter, const Json& range) {
  return {parameter, number(range.at("from")), number(range.at("to"))};
}

Analysis analysis(const Json& section, const Json& system, const sim::Model& model,
                  std::optional<identify::MeasuredRecord> data) {
  const auto type = section.at("type").get<std::string>();
  if (type == "simulate") {
    const double period = 2.0 * std::numbers::pi / model.excitation.frequency;
    const double duration =
        section.contains("cycles") ? number(section.at("cycles")) * period : number(section.at("duration"));
    return Simulate{duration, number_or(section, "sample_rate", 0.0)};
  }
  if (type == "steady_state") return SteadyStateQuestion{};
  if (type == "xy_curve") return XyCurve{grid_values(section.at("amplitudes"))};
  if (type == "frequency_response") return FrequencyResponse{grid_values(section.at("frequencies"))};
  if (type == "regime_map")
    return RegimeMap{grid_values(section.at("frequencies")), grid_values(section.at("amplitudes")),
                     section.at("sticking_boundary").get<bool>()};
  if (type == "xy_branch") return branch(sim::BranchParameter::amplitude, section.at("amplitudes"));
  if (type == "frequency_branch") return branch(sim::BranchParameter::frequency, section.at("frequencies"));
  if (type == "free_decay") return FreeDecayQuestion{section.at("peaks").get<int>()};
  if (type == "stress_test") return stress_test(section, system, model.excitation.frequency);
  if (type == "mechanisms") return mechanism_study(section, system);
  if (type == "identify") return identify_question(section, model, std::move(data));
  const Json& formula = section.at("formula");
  return Formula{formula.at("name").get<std::string>(), formula.dump()};
}

std::vector<Expectation> expectations(const Json& values, const Document& document, const Reading& reading) {
  std::vector<Expectation> result;
  if (!values.contains("expect")) return result;
  for (std::size_t i = 0; i < values.at("expect").size(); ++i) {
    const Json& item = values.at("expect").at(i);
    Expectation expectation;
    expectation.path = item.at("value").get<std::string>();
    const Json& equals = item.at("equals");
    if (equals.is_boolean())
      expectation.equals = equals.get<bool>();
    else if (equals.is_string())
      expectation.equals = equals.get<std::string>();
    else
      expectation.equals = equals.get<double>();
    if (item.contains("within")) expectation.within = number(item.at("within"));
    if (item.contains("within_relative")) expectation.within_relative = number(item.at("within_relative"));
    if (item.contains("source")) expectation.source = item.at("source").get<std::string>();
    expectation.place = document.locate(reading.places.at("expect[" + std::to_string(i) + "].value"));
    result.push_back(std::move(expectation));
  }
  return result;
}

void throw_sorted(std::vector<core::Diagnostic> problems, const std::string& file) {
  // In order of the file; what comes from elsewhere (--set, data) after it.
  std::ranges::stable_sort(problems, {}, [&](const core::Diagnostic& problem) {
    return std::tuple(problem.place.file != file, problem.place.file, problem.place.line, problem.place.column);
  });
  throw core::InputError(std::move(problems));
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& name, const LoadOptions& options) {
  Document document(name, text);
  for (const Override& item : options.set) document.set(item.assignment, item.origin);
  refuse_other_schema(document);

  Reading reading = read(document, scenario_format());
  const std::string directory = std::filesystem::path(name).parent_path().string();
  std::optional<identify::MeasuredRecord> data = check(document, reading, {directory, options.data_anywhere});
  reading.problems.insert(reading.problems.end(), document.problems().begin(), document.problems().end());
  if (!reading.problems.empty()) throw_sorted(std::move(reading.problems), name);

  const Json& values = reading.values;
  Scenario scenario;
  scenario.file = name;
  scenario.file_sha256 = core::sha256(text);
  scenario.resolved = values.dump();
  for (const Override& item : options.set) scenario.overrides.push_back(item.assignment);
  if (values.contains("title")) scenario.title = values.at("title").get<std::string>();
  if (values.contains("system")) scenario.model = model(values);
  if (values.contains("system") && values.at("system").contains("friction"))
    scenario.warnings = law_warnings(values.at("system").at("friction"));
  scenario.tolerance = tolerance_of(values, scenario.model);
  scenario.analysis_name = values.at("analysis").at("type").get<std::string>();
  scenario.analysis =
      analysis(values.at("analysis"), values.value("system", Json()), scenario.model, std::move(data));
  scenario.expect = expectations(values, document, reading);
  return scenario;
}

Scenario load_scenario(const std::string& path, const LoadOptions& options) {
  return parse_scenario(read_file(path, max_bytes), path, options);
}

friction::ParameterValues law_parameters(const std::string& law, const std::vector<std::string>& set) {
  LoadOptions options;
  for (const std::string& assignment : set) options.set.push_back({"system.friction." + assignment});
  const Scenario around =
      parse_scenario("schema: dualdamp/1\nsystem: {mass: 1, stiffness: 1, damping: 0, friction: {law: " + law +
                         "}}\nanalysis: {type: simulate, duration: 1}\n",
                     "command line", options);
  return law_values(friction::find_law(law)->parameters, Json::parse(around.resolved).at("system").at("friction"));
}

}  // namespace dualdamp::scenarios
