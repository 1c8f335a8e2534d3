#include "scenarios/scenario.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

#include "core/numbers.hpp"
#include "core/provenance.hpp"
#include "friction_models/registry.hpp"
#include "identify/record.hpp"
#include "scenarios/checks.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/law_values.hpp"
#include "scenarios/format/reader.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/drives.hpp"
#include "scenarios/results/files.hpp"
#include "scenarios/results/motion.hpp"
#include "scenarios/scenario_format.hpp"
#include "scenarios/scenario_reading.hpp"
#include "scenarios/sweep/sweep.hpp"
#include "sim/engine/engine.hpp"
#include "sim/law_host/loaded_contacts.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/validate.hpp"

namespace dualdamp::scenarios {

namespace {

/// Checked first: a file for a newer program would otherwise give many messages about unknown keys.
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

/// Replaces the analysis of a document with a record (recognised by its measurement) by another one. Returns what
/// was left out, in words.
std::string ask_instead(Document& document, const LoadOptions& options) {
  const Entry* section = document.root().find("analysis");
  const Entry* type = section == nullptr ? nullptr : section->value.find("type");
  const Analysis* asked = type == nullptr ? nullptr : find_analysis(options.analyses, type->value.text);
  if (options.instead.empty() || asked == nullptr || asked->name == options.instead) return {};
  if (asked->keys.find("measurement") == nullptr)
    throw core::InputError(
        core::Diagnostic{document.locate(type->value.place),
                         "this scenario has no record to ask '" + std::string(options.instead) + "' of",
                         "a scenario of the analysis identify or " + std::string(options.instead),
                         std::string(asked->name),
                         {}});
  const Analysis& wanted = *find_analysis(options.analyses, options.instead);
  std::string left_out;
  for (const Field& field : asked->keys.fields)
    if (wanted.keys.find(field.name) == nullptr && document.take("analysis." + field.name))
      left_out += (left_out.empty() ? "analysis." : ", analysis.") + field.name;
  if (document.take("expect")) left_out += left_out.empty() ? "expect" : ", expect";
  document.take("analysis.type");
  document.set("analysis.type=" + std::string(options.instead), "analysis");
  return left_out;
}

core::Coordinate coordinate_of(const Json& system) {
  return system.value("coordinate", "") == core::name_of(core::Coordinate::angle) ? core::Coordinate::angle
                                                                                  : core::Coordinate::displacement;
}

sim::Oscillator oscillator(const Json& system) {
  return {number_or(system, "mass", identify::unknown),
          number_or(system, "stiffness", identify::unknown),
          number_or(system, "damping", 0.0),
          system.at("damper_to") == "base" ? sim::DamperTo::base : sim::DamperTo::ground,
          number_or(system, "cubic_stiffness", 0.0),
          number_or(system, "gravity_stiffness", 0.0),
          coordinate_of(system),
          number_or(system, "loss_factor", 0.0)};
}

sim::Excitation excitation(const Json& section) {
  sim::Excitation result = excitation_named(section.at("type").get<std::string>());
  result.amplitude = number_or(section, "amplitude", 0.0);
  result.frequency = number_or(section, "frequency", 0.0);
  result.phase = number_or(section, "phase", 0.0);
  result.offset = number_or(section, "offset", 0.0);
  result.slope = number_or(section, "velocity", number_or(section, "rate", 0.0));
  if (result.is_chirp()) result.chirp = chirp_of(section);
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

/// Laws whose elements become separate laws can be too many although the list of the file is not too long.
void refuse_many_laws(const sim::Model& model, const Document& document, const Reading& reading) {
  const std::size_t found = model.friction.size();
  if (found <= sim::max_laws) return;
  throw core::InputError(
      core::Diagnostic{document.locate(reading.places.at("system.friction")),
                       "'system.friction' has too many laws: under modifiers each element is a law of its own",
                       "1 to " + std::to_string(sim::max_laws) + " in all",
                       std::to_string(found),
                       {}});
}

/// A travel before t = 0 loads nothing but a law that remembers its path.
void refuse_idle_travel(const sim::Model& model, const Document& document, const Reading& reading) {
  if (model.initial.travel == 0.0 || std::ranges::any_of(model.friction, &friction::Law::remembers_path)) return;
  throw core::InputError(
      core::Diagnostic{document.locate(reading.places.at("initial.travel")),
                       "'initial.travel' has no effect: no law of this file depends on earlier motion of the mass",
                       "a law that does, such as contact_compliance, dahl or free_play",
                       {},
                       {}});
}

/// Warnings about structural damping.
std::vector<std::string> loss_factor_warnings(const sim::Model& model) {
  if (model.oscillator.loss_factor == 0.0) return {};
  std::vector<std::string> result = {
      "a constant loss factor is not causal: it describes steady vibrations, not motions in time"};
  if (!model.friction.empty() || !sim::is_linear(model.oscillator))
    result.emplace_back(
        "the loss factor acts as a viscous damper eta k/w: if the motion has a harmonic of order n, it is damped n "
        "times as much as by a complex stiffness");
  return result;
}

std::vector<std::string> law_warnings(const Json& section, core::Coordinate coordinate) {
  std::vector<std::string> result;
  for (const Json& item : section.is_array() ? section : Json::array({section})) {
    const friction::LawEntry* entry = friction::find_law(item.at("law").get<std::string>());
    if (entry->warnings == nullptr) continue;
    for (const std::string& warning : entry->warnings(law_values(entry->parameters, item, coordinate)))
      result.push_back(std::string(entry->name) + ": " + warning);
  }
  return result;
}

/// Above it amplitudes were off by more than 2e-4 in trials (docs/smooth-engine.md).
constexpr double loosest_quiet_tolerance = 1e-6;

sim::Solver solver(const Json& numerics) {
  static const std::map<std::string, sim::SolverKind> kinds = {{"automatic", sim::SolverKind::automatic},
                                                               {"explicit", sim::SolverKind::explicit_steps},
                                                               {"implicit", sim::SolverKind::implicit_steps}};
  return {kinds.at(numerics.at("solver").get<std::string>()),
          number_or(numerics, "tolerance", sim::Solver{}.tolerance)};
}

bool states_tolerance(const Json& values) {
  return values.contains("numerics") && values.at("numerics").contains("tolerance");
}

/// Closure error of steady states, from the accuracy of the engine.
double tolerance_of(const Json& values, const sim::Model& model) {
  if (states_tolerance(values)) return number(values.at("numerics").at("tolerance"));
  return sim::is_exact(model) ? sim::SteadyStateOptions{}.tolerance : model.solver.tolerance;
}

sim::Model model(const Json& values, bool with_laws) {
  sim::Model result;
  const Json& system = values.at("system");
  result.oscillator = oscillator(system);
  if (values.contains("excitation")) result.excitation = excitation(values.at("excitation"));
  if (with_laws && system.contains("friction")) result.friction = friction_of(system.at("friction"));
  if (values.contains("initial")) {
    const Json& initial = values.at("initial");
    result.initial = {number(initial.at("position")), number(initial.at("velocity"))};
    if (!sim::load_contacts(result, number(initial.at("travel"))))
      throw core::InputError({.message = "a law of 'system.friction' cannot be moved by 'initial.travel'"});
  }
  if (values.contains("numerics")) result.solver = solver(values.at("numerics"));
  return result;
}

}  // namespace

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
  std::ranges::stable_sort(problems, {}, [&](const core::Diagnostic& problem) {
    return std::tuple(problem.place.file != file, problem.place.file, problem.place.line, problem.place.column);
  });
  throw core::InputError(std::move(problems));
}

Scenario scenario_of(const Document& document, Reading reading, const std::string& name,
                     const LoadOptions& options) {
  const Section format = scenario_format(options.analyses);
  const std::string directory = std::filesystem::path(name).parent_path().string();
  Checked checked =
      check(document, reading, format, options.analyses, {directory, options.data_anywhere, options.data_texts});
  reading.problems.insert(reading.problems.end(), document.problems().begin(), document.problems().end());
  if (!reading.problems.empty()) throw_sorted(std::move(reading.problems), name);

  const Json& values = reading.values;
  const bool sought = checked.analysis->seeks_laws;
  Scenario scenario;
  scenario.file = name;
  scenario.data_sha256 = std::move(checked.sha256);
  scenario.resolved = values.dump();
  if (values.contains("title")) scenario.title = values.at("title").get<std::string>();
  if (values.contains("system")) scenario.model = model(values, !sought);
  scenario.model.excitation.samples = checked.drive;
  refuse_many_laws(scenario.model, document, reading);
  if (!sought) refuse_idle_travel(scenario.model, document, reading);
  if (!sought && values.contains("system") && values.at("system").contains("friction"))
    scenario.warnings = law_warnings(values.at("system").at("friction"), scenario.model.oscillator.coordinate);
  std::ranges::move(checked.warnings, std::back_inserter(scenario.warnings));
  std::ranges::move(loss_factor_warnings(scenario.model), std::back_inserter(scenario.warnings));
  scenario.tolerance = tolerance_of(values, scenario.model);
  if (scenario.model.solver.tolerance > loosest_quiet_tolerance)
    scenario.warnings.push_back(
        "'numerics.tolerance' = " + core::format_number(scenario.model.solver.tolerance) +
        " is loose: steady amplitudes under weak damping may be off by up to 20 %, and a slow "
        "approach may pass for a subharmonic motion; 1e-6 keeps amplitudes within 0.02 %");
  scenario.verify = values.contains("numerics") && values.at("numerics").value("verify", false);
  const Json& section = values.at("analysis");
  scenario.analysis_name = std::string(checked.analysis->name);
  scenario.result_rows = checked.result_rows;
  scenario.result_fields = result_fields(*checked.analysis, section);
  for (ResultField& field : scenario.result_fields) {
    if (field.unit == unit_of_drive) field.unit = amplitude_unit(scenario.model.excitation);
    field.unit = core::unit_for(scenario.model.oscillator.coordinate, field.unit);
  }
  scenario.question = checked.analysis->ask(
      {section, values.value("system", Json()), values.value("excitation", Json()), scenario.model,
       std::move(checked.data), std::move(checked.files), values.contains("initial"), states_tolerance(values),
       std::move(checked.compared), checked.drive_start, document.words()});
  scenario.expect = expectations(values, document, reading);
  scenario.written_units = std::move(reading.written_units);
  return scenario;
}

Scenario parse_scenario(const std::string& text, const std::string& name, const LoadOptions& options) {
  Document document(name, text, options.words);
  const std::string left_out = ask_instead(document, options);
  for (const Override& item : options.set) document.set(item.assignment, item.origin);
  refuse_other_schema(document);
  const bool is_sweep = document.root().find("sweep") != nullptr;
  Scenario scenario = is_sweep
                          ? swept_scenario(std::move(document), name, options)
                          : scenario_of(document, read(document, scenario_format(options.analyses)), name, options);
  scenario.file_sha256 = core::sha256(text);
  for (const Override& item : options.set) scenario.overrides.push_back(item.assignment);
  if (!left_out.empty())
    scenario.warnings.push_back("'" + std::string(options.instead) + "' does not use " + left_out + ": left out");
  return scenario;
}

Scenario load_scenario(const std::string& path, const LoadOptions& options) {
  return parse_scenario(read_file(path, max_bytes), path, options);
}

friction::ParameterValues law_parameters(const std::string& law, const std::vector<std::string>& set,
                                         const std::string& origin) {
  LoadOptions options;
  for (const std::string& assignment : set) options.set.push_back({"system.friction." + assignment, origin});
  const std::string text = "schema: " + std::string(schema_name) +
                           "\nsystem: {mass: 1, stiffness: 1, damping: 0, friction: {law: " + law +
                           "}}\nexcitation: {type: force_harmonic, amplitude: 1, frequency: 1 rad/s}\n"
                           "analysis: {type: simulate, duration: 1}\n";
  try {
    const Scenario around = parse_scenario(text, law, options);
    return law_values(friction::find_law(law)->parameters,
                      Json::parse(around.resolved).at("system").at("friction"));
  } catch (const core::InputError& error) {
    std::vector<core::Diagnostic> problems = error.diagnostics();
    for (core::Diagnostic& problem : problems)  // nobody has written the text around the values
      if (problem.place.file == law) problem.place = {law, 0, 0, {}};
    throw core::InputError(std::move(problems));
  }
}

}  // namespace dualdamp::scenarios
