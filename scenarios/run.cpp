#include "scenarios/run.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "friction_models/law_fault.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/expectations.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/results/completeness.hpp"
#include "scenarios/results/shown_table.hpp"
#include "scenarios/results/shown_units.hpp"

namespace dualdamp::scenarios {

namespace {

/// The results that state the meaning of the others in a sentence.
constexpr std::array<const char*, 2> sentences = {"verdict", "advice"};

/// Text of several lines, which does not fit in a table.
bool is_document(const Json& value) {
  return value.is_string() && value.get_ref<const std::string&>().find('\n') != std::string::npos;
}

/// The unit that stands beside a number, under the key `unit`; empty: none does.
std::string unit_beside(const ResultField& field, const Json& result) {
  const std::size_t dot = field.path.find_last_of('.');
  if (!field.unit.empty() || dot == std::string::npos || field.path.find("[]") != std::string::npos) return {};
  const Json* unit = find_value(result, field.path.substr(0, dot) + ".unit");
  return unit != nullptr && unit->is_string() ? unit->get<std::string>() : "";
}

/// The numbers of the result that are not in a list of records, in the order of the tables of the format.
void summarise(const Scenario& scenario, const Json& result, Table& table) {
  const ShownUnits units = shown_units(scenario.written_units);
  const auto add = [&](const std::string& name, const Json& value, const std::string& unit) {
    // Sentences are printed separately from numbers. The answer is in the verdict and in the table of estimates.
    if (value.is_structured() || is_document(value) || std::ranges::find(sentences, name) != sentences.end() ||
        name.ends_with(".text") || name.ends_with(".unit") || name.starts_with("answer"))
      return;
    constexpr int digits = 9;
    table.columns[0].texts.push_back(name);
    const double number = value.is_number_float() ? value.get<double>() : 0.0;
    const ShownUnit shown = shown_unit(units, kind_of(unit, name), std::abs(number)).value_or(ShownUnit{unit});
    table.columns[1].texts.push_back(value.is_number_float() ? core::format_number(number * shown.factor, digits)
                                     : value.is_string()     ? value.get<std::string>()
                                                             : value.dump());
    table.columns[2].texts.push_back(unit == "1" ? "" : shown.unit);
  };
  for (const ResultField& field : scenario.result_fields) {
    if (field.is_for_programs) continue;
    const std::string stem = field.path.substr(0, field.path.find("[]"));
    const Json* value = find_value(result, stem);
    if (value == nullptr) continue;
    if (stem == field.path) {
      const std::string beside = value->is_number_float() ? unit_beside(field, result) : "";
      add(stem, *value, beside.empty() ? field.unit : beside);
    }
    if (field.path == stem + "[]")
      for (std::size_t i = 0; i < value->size(); ++i)
        add(stem + "[" + std::to_string(i) + "]", value->at(i), field.unit);
  }
}

Answer answer_of(const Scenario& scenario, const RunOptions& options) {
  try {
    return scenario.question->run(context_of(scenario, options));
  } catch (const friction::LawFault& fault) {
    return failed(fault.what());
  }
}

/// Warning about requested units of no quantity of the result; empty if there are none.
std::string unit_warning(const Scenario& scenario, const std::vector<Table>& tables) {
  std::set<std::string> kinds;
  for (const ResultField& field : scenario.result_fields) kinds.insert(kind_of(field.unit, field.path));
  for (const Table& table : tables) kinds.merge(kinds_of(table));
  const std::vector<std::string> unused = unused_units(scenario.written_units, kinds);
  std::vector<std::string> there;
  for (const std::string& kind : kinds)
    if (!kind.empty() && kind != "1") there.push_back(core::unit_for(scenario.model.oscillator.coordinate, kind));
  return warning_of_units(unused, scenario.written_units, there);
}

/// The result of an answer: its summary and its comparison with the expected values.
RunResult result_of(const Scenario& scenario, Answer answer) {
  RunResult result;
  result.warnings = scenario.warnings;
  result.status = answer.status;
  result.failure = std::move(answer.failure);
  if (answer.result.is_null()) {
    result.status = core::ExitStatus::numerical_failure;
  } else {
    result.result = answer.result.dump();
    for (const char* sentence : sentences)
      if (answer.result.contains(sentence)) result.sentence = answer.result.at(sentence).get<std::string>();
    summarise(scenario, answer.result, result.summary);
    result.tables = std::move(answer.tables);
    result.files = std::move(answer.files);
    for (Table& table : result.tables)
      for (Column& column : table.columns)
        column.unit = core::unit_for(scenario.model.oscillator.coordinate, column.unit);
    if (std::string idle = unit_warning(scenario, result.tables); !idle.empty())
      result.warnings.push_back(std::move(idle));
    result.checks = compare(scenario.expect, answer.result, result.tables);
    if (!std::ranges::all_of(result.checks, &Check::ok)) result.status = core::ExitStatus::check_failed;
  }
  std::ranges::move(answer.warnings, std::back_inserter(result.warnings));
  return result;
}

}  // namespace

core::Provenance provenance_of(const Scenario& scenario) {
  core::Provenance provenance;
  provenance.source = scenario.file;
  provenance.source_sha256 = scenario.file_sha256;
  provenance.scenario = scenario.resolved;
  provenance.scenario_sha256 = core::sha256(scenario.resolved);
  provenance.data_sha256 = scenario.data_sha256;
  provenance.overrides = scenario.overrides;
  for (const friction::LawEntry& law : friction::laws())
    if (law.plugin) provenance.plugins.push_back(*law.plugin);
  provenance.tolerance = scenario.tolerance;
  provenance.started = core::utc_now();
  return provenance;
}

RunContext context_of(const Scenario& scenario, const RunOptions& options) {
  return {scenario.model, scenario.tolerance, scenario.resolved, options, nullptr, &scenario.written_units};
}

RunResult run(const Scenario& scenario, const RunOptions& options) {
  const bool is_first = options.processes->rank() == 0;
  if (!is_first && dynamic_cast<const Campaign*>(scenario.question.get()) == nullptr) return {};
  core::Provenance provenance = provenance_of(scenario);
  const auto start = std::chrono::steady_clock::now();
  Answer answer = answer_of(scenario, options);
  if (const std::string missing = missing_number(answer); !missing.empty())
    answer = failed(missing + " left the range of double precision");
  if (!is_first) return {};
  provenance.duration = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::optional<Verification> verification = std::move(answer.verification);
  if (scenario.verify && !answer.result.is_null()) verification = verify(scenario, options, answer);
  RunResult result = result_of(scenario, std::move(answer));
  if (verification && !verification->agrees) result.status = core::ExitStatus::check_failed;
  result.verification = std::move(verification);
  result.provenance = std::move(provenance);
  return result;
}

}  // namespace dualdamp::scenarios
