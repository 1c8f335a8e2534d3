#include "scenarios/run.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <stdexcept>

#include "core/numbers.hpp"
#include "friction_models/law_fault.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/answer.hpp"
#include "scenarios/expectations.hpp"
#include "scenarios/formulas.hpp"
#include "scenarios/result_fields.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/curves.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/orbits/sticking_boundary.hpp"

namespace dualdamp::scenarios {

namespace {

/// Puts each kind of question to the module that answers it.
class Runner {
 public:
  explicit Runner(const Scenario& scenario) : scenario_(scenario) { options_.tolerance = scenario.tolerance; }

  Answer operator()(const Simulate& question) const {
    sim::SimulateOptions options;
    options.duration = question.duration;
    options.sample_rate = question.sample_rate;
    constexpr long max_events = 1'000'000;  // each is an item of the result
    options.max_events = max_events;
    return answer(sim::simulate(scenario_.model, options), scenario_.model.excitation);
  }

  Answer operator()(const SteadyStateQuestion& /*question*/) const {
    constexpr int samples = 720;  // of one period, for plots
    const sim::Model& model = scenario_.model;
    const sim::SteadyState state = sim::steady_state(model, options_);
    const bool exists = state.outcome.ok();
    return answer(state, exists ? sim::one_period(model, state, samples) : std::vector<sim::Sample>(),
                  model.excitation);
  }

  Answer operator()(const XyCurve& question) const {
    return answer(sim::xy_curve(scenario_.model, question.amplitudes, options_), CurveOver::amplitude,
                  amplitude_unit());
  }

  Answer operator()(const FrequencyResponse& question) const {
    return answer(sim::frequency_response(scenario_.model, question.frequencies, options_), CurveOver::frequency,
                  amplitude_unit());
  }

  Answer operator()(const RegimeMap& question) const {
    const sim::Model& model = scenario_.model;
    Answer result =
        answer_map(sim::regime_map(model, question.frequencies, question.amplitudes, options_), amplitude_unit());
    if (question.sticking_boundary && !result.result.is_null())
      add_boundary(result, sim::sticking_boundary(model, question.frequencies), amplitude_unit());
    return result;
  }

  Answer operator()(const BranchQuestion& question) const {
    return answer(sim::follow_branch(scenario_.model, question.parameter, question.from, question.to),
                  question.parameter, amplitude_unit());
  }

  Answer operator()(const FreeDecayQuestion& question) const {
    return answer(sim::free_decay(scenario_.model, question.peaks));
  }

  Answer operator()(const Identify& question) const {
    std::vector<std::string> warnings = question.data_warnings;
    const identify::Record record = record_of(question, warnings);
    std::vector<identify::Estimate> estimates;
    for (const identify::MethodEntry* method : question.methods)
      estimates.push_back(method->run(record, question.constants, question.options));
    Answer result = answer(estimates, record);
    result.warnings.insert(result.warnings.begin(), warnings.begin(), warnings.end());
    return result;
  }

  /// A campaign writes as it goes: bench/campaign.hpp.
  Answer operator()(const StressTest& /*question*/) const {
    throw std::logic_error("a stress test is no single question");
  }

  /// bench/mechanism_study.hpp.
  Answer operator()(const MechanismStudy& /*question*/) const {
    throw std::logic_error("a study of mechanisms is no single question");
  }

  Answer operator()(const Formula& question) const {
    Answer result;
    result.result = find_formula(question.name)->evaluate(Json::parse(question.arguments));
    if (std::ranges::all_of(result.result, [](const Json& value) { return value.is_null(); })) {
      result.result = nullptr;
      result.failure = "the formula has no value for these arguments";
    }
    return result;
  }

 private:
  [[nodiscard]] std::string amplitude_unit() const {
    return scenario_.model.excitation.type == sim::ExcitationType::force_harmonic ? "N" : "m";
  }

  identify::Record record_of(const Identify& question, std::vector<std::string>& warnings) const {
    if (const auto* record = std::get_if<identify::Record>(&question.source)) return *record;
    const auto& measurement = std::get<Measurement>(question.source);
    MotionRecord motion = motion_of(scenario_.model, measurement, question.sensors, options_);
    std::ranges::move(motion.warnings, std::back_inserter(warnings));
    return reading(motion, question.sensors, question.sensor_seed, warnings);
  }

  const Scenario& scenario_;
  sim::SteadyStateOptions options_;
};

/// The numbers of the result that are no part of a list of records, in the order of the tables of the format.
void summarise(const Scenario& scenario, const Json& result, Table& table) {
  const auto add = [&](const std::string& name, const Json& value, const std::string& unit) {
    if (value.is_structured() || name == "verdict") return;
    constexpr int digits = 9;
    table.columns[0].texts.push_back(name);
    table.columns[1].texts.push_back(value.is_number_float() ? core::format_number(value.get<double>(), digits)
                                     : value.is_string()     ? value.get<std::string>()
                                                             : value.dump());
    table.columns[2].texts.push_back(unit == "1" ? "" : unit);
  };
  const auto* formula = std::get_if<Formula>(&scenario.analysis);
  for (const ResultField& field : result_fields(scenario.analysis_name, formula == nullptr ? "" : formula->name)) {
    const std::string stem = field.path.substr(0, field.path.find("[]"));
    std::string pointer = "/" + stem;
    std::ranges::replace(pointer, '.', '/');
    const Json::json_pointer place(pointer);
    if (!result.contains(place)) continue;
    const Json& value = result.at(place);
    if (stem == field.path) add(stem, value, field.unit);
    if (field.path == stem + "[]")
      for (std::size_t i = 0; i < value.size(); ++i)
        add(stem + "[" + std::to_string(i) + "]", value.at(i), field.unit);
  }
}

Answer ask(const Scenario& scenario) {
  try {
    return std::visit(Runner(scenario), scenario.analysis);
  } catch (const friction::LawFault& fault) {
    Answer none;
    none.failure = fault.what();
    return none;
  }
}

}  // namespace

core::Provenance provenance_of(const Scenario& scenario) {
  core::Provenance provenance;
  provenance.source = scenario.file;
  provenance.source_sha256 = scenario.file_sha256;
  provenance.scenario = scenario.resolved;
  provenance.scenario_sha256 = core::sha256(scenario.resolved);
  if (const auto* identify = std::get_if<Identify>(&scenario.analysis))
    provenance.data_sha256 = identify->data_sha256;
  provenance.overrides = scenario.overrides;
  for (const friction::LawEntry& law : friction::laws())
    if (law.plugin) provenance.plugins.push_back(*law.plugin);
  provenance.tolerance = scenario.tolerance;
  provenance.started = core::utc_now();
  return provenance;
}

RunResult assemble(const Scenario& scenario, const std::string& json, std::vector<Table> tables,
                   core::Provenance provenance) {
  RunResult result;
  result.provenance = std::move(provenance);
  result.warnings = scenario.warnings;
  result.result = json;
  const Json answer = Json::parse(json);
  if (answer.contains("verdict")) result.verdict = answer.at("verdict").get<std::string>();
  summarise(scenario, answer, result.summary);
  result.tables = std::move(tables);
  result.checks = compare(scenario.expect, answer, result.tables);
  if (!std::ranges::all_of(result.checks, &Check::ok)) result.status = core::ExitStatus::check_failed;
  return result;
}

RunResult run(const Scenario& scenario) {
  core::Provenance provenance = provenance_of(scenario);
  const auto start = std::chrono::steady_clock::now();
  Answer answer = ask(scenario);
  provenance.duration = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!answer.result.is_null()) {
    RunResult result = assemble(scenario, answer.result.dump(), std::move(answer.tables), std::move(provenance));
    std::ranges::move(answer.warnings, std::back_inserter(result.warnings));
    return result;
  }
  RunResult result;
  result.provenance = std::move(provenance);
  result.warnings = scenario.warnings;
  std::ranges::move(answer.warnings, std::back_inserter(result.warnings));
  result.status = core::ExitStatus::numerical_failure;
  result.failure = std::move(answer.failure);
  return result;
}

}  // namespace dualdamp::scenarios
