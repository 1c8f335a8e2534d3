#include "scenarios/analyses/design.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/constants.hpp"
#include "identify/outliers/outliers.hpp"
#include "scenarios/analyses/shared/identify_options.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/measured_data.hpp"
#include "scenarios/measurements/measurement.hpp"
#include "scenarios/results/laws.hpp"
#include "scenarios/results/measurement_plan.hpp"
#include "scenarios/results/shown_units.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::MeasurementAdvice;

Section design_keys() {
  std::vector<Field> fields = data_fields();
  std::ranges::move(measurement_fields(), std::back_inserter(fields));
  for (Field& field : method_option_fields()) {
    const auto options = identify::any_law_method.options();
    if (std::ranges::any_of(options, [&](const identify::Option* option) { return option->name == field.name; }))
      fields.push_back(std::move(field));
  }
  fields.push_back(gain_uncertainty_field());
  fields.push_back(
      quantity("most_level", {"m"},
               "largest input amplitude that the drive reaches; a measurement beyond it is not advised")
          .above(0));
  fields.push_back(quantity("most_frequency", {"rad/s"},
                            "largest frequency that the drive reaches; a measurement beyond it is not advised")
                       .above(0));
  return {std::move(fields), {{{"data", "measurement"}, true}}};
}

std::vector<Needs> design_needs() {
  const std::string base = "the states are those of a mass that its base drives";
  return {{"xy_curve", {"base_harmonic"}, {}, true, base},
          {"frequency_response", {"base_harmonic"}, {"amplitude"}, true, base},
          {"data", {"base_harmonic", "none"}, {"frequency"}, false, base, idle_beside_data()}};
}

void check_design(CheckedFile& file) {
  check_measurement(file);
  warn_of_unknown_damper(file);
  read_data(file);
  if (const std::optional<identify::Record> record = outlined_record(file)) check_gains(file, *record);
  if (!file.data) return;
  if (!file.data->record.pairs)
    file.complain("analysis.data",
                  file.data->record.decay ? "these are a free vibration" : "these histories give no steady states",
                  "steady states: Y and x, or histories of x and y under a harmonic drive");
  check_frequency(file, file.data->record);
}

std::unique_ptr<const Question> ask_design(CheckedValues&& values) {
  auto options =
      identify::taken_from<identify::AnyLawOptions>(identify::any_law_method.own(method_options(values.analysis)));
  const identify::DriveLimits limits = {number_or(values.analysis, "most_level", core::infinity),
                                        number_or(values.analysis, "most_frequency", core::infinity)};
  return std::make_unique<DesignQuestion>(record_question(std::move(values)), std::move(options), limits);
}

Json shrinkage_json(const identify::Shrinkage& shrinkage) {
  return {{"zeta", finite_or_null(shrinkage.zeta)}, {"F0", finite_or_null(shrinkage.F0)}};
}

/// The least and the largest of the outcomes.
Json range_json(const MeasurementAdvice& advice, double identify::Shrinkage::* one) {
  const auto by_law = [one](const identify::LawOutcome& outcome) { return outcome.hull.*one; };
  const auto [least, most] = std::ranges::minmax(advice.outcomes, {}, by_law);
  return {finite_or_null(by_law(least)), finite_or_null(by_law(most))};
}

/// The advice in words: what it brings, and what to do.
std::string text_of(const MeasurementAdvice& advice, const std::string& instruction) {
  return advice.text + ". To do: " + instruction;
}

Json advice_json(const MeasurementAdvice& advice, const std::string& instruction, const PlannedRig& rig) {
  Json json = {{"measurement", advice.candidate.name},
               {"instruction", instruction},
               {"cost", advice.candidate.cost},
               {"hull_shrinks_to", shrinkage_json(advice.hull)},
               {"average_shrinks_to", shrinkage_json(advice.average)},
               {"hull_by_law",
                {{"zeta", range_json(advice, &identify::Shrinkage::zeta)},
                 {"F0", range_json(advice, &identify::Shrinkage::F0)}}},
               {"power", finite_or_null(advice.power)},
               {"text", text_of(advice, instruction)}};
  json.update(plan_json(advice.candidate, rig));
  return json;
}

Table candidate_table(const std::vector<MeasurementAdvice>& list, std::vector<std::string> instructions) {
  const auto real = [&](const std::string& name, auto get) { return column(name, "", list, get); };
  return {"candidates",
          {text_column("measurement", list, [](const MeasurementAdvice& advice) { return advice.candidate.name; }),
           real("cost", [](const MeasurementAdvice& advice) { return advice.candidate.cost; }),
           real("hull_zeta", [](const MeasurementAdvice& advice) { return advice.hull.zeta; }),
           real("hull_F0", [](const MeasurementAdvice& advice) { return advice.hull.F0; }),
           real("average_zeta", [](const MeasurementAdvice& advice) { return advice.average.zeta; }),
           real("average_F0", [](const MeasurementAdvice& advice) { return advice.average.F0; }),
           real("power", [](const MeasurementAdvice& advice) { return advice.power; }),
           {.name = "instruction", .texts = std::move(instructions), .kind = CellKind::text}}};
}

ResultFields design_fields() {
  return {
      {"candidates[].measurement", "", "what could be measured next, the best first"},
      {"candidates[].instruction", "",
       "what to do, in the units of the scenario: levels, frequencies, waiting, what is read"},
      {"candidates[].states[].Y", "m", "input amplitude of a steady state to be measured"},
      {"candidates[].states[].omega", "rad/s", "its frequency"},
      {"candidates[].states[].times", "1", "how often it is measured"},
      {"candidates[].settle", "s",
       "time to wait after each change of level or frequency, until viscous damping alone has reduced the transient to "
       "a thousandth"},
      {"candidates[].release", "m", "of a release: the position from which the mass is let go"},
      {"candidates[].extremes", "1", "number of extremes to be read"},
      {"candidates[].duration", "s", "time that they take"},
      {"candidates[].sample_rate", "1/s", "least sample rate: 100 samples in a period"},
      {"candidates[].cost", "1", "number of steady states to be measured, or of releases"},
      {"candidates[].hull_shrinks_to.zeta", "1", "expected width of the hull of zeta over its present width"},
      {"candidates[].hull_shrinks_to.F0", "1", "the same of the friction force"},
      {"candidates[].hull_by_law.zeta[]", "1", "the same under the true law for which it is least, and largest"},
      {"candidates[].hull_by_law.F0[]", "1", "the same of the friction force"},
      {"candidates[].average_shrinks_to.zeta", "1",
       "expected standard deviation of the average over laws over the present one"},
      {"candidates[].average_shrinks_to.F0", "1", "the same of the friction force"},
      {"candidates[].power", "1",
       "expected share of the wrong laws that are rejected, of those that the record allows"},
      {"candidates[].text", "", "the advice in words"},
      {"left_out[]", "", "measurements that the drive cannot do, by most_level and most_frequency"},
      {"hull95.zeta[]", "1", "ends of the present hull of zeta"},
      {"hull95.F0[]", "N", "ends of the present hull of the friction force"},
      {"inflation", "1",
       "factor by which the noise must be larger so that the best law is not rejected; above 3 no law of the library "
       "describes the record, and neither the hulls nor the candidates are to be used"},
      {"advice", "", "the best candidate in words, or that none helps"}};
}

std::string summary_of(const identify::Design& design, const std::string& instruction) {
  const MeasurementAdvice& best = design.advice.front();
  constexpr double little = 0.9;
  if (const std::string none = identify::no_law_fits(design.now); !none.empty())
    return none + ", so that the ranges and what would narrow them are not to be used";
  if (best.hull.zeta > little && best.hull.F0 > little) return "nothing on the list narrows the ranges by a tenth";
  return text_of(best, instruction);
}

std::string warning_of_limits(const std::vector<std::string>& left_out) {
  std::string text = "left out, because the drive cannot do them by 'most_level' and 'most_frequency': ";
  for (const std::string& name : left_out) text += (&name == &left_out.front() ? "" : "; ") + name;
  return text;
}

/// What to do first with a record of too few states for ranges over laws; empty if it has enough of them, or the
/// drive can do no more.
std::string what_to_do_first(const identify::Record& record, const identify::KnownConstants& constants,
                             const identify::DriveLimits& limits, const ShownUnits& units) {
  constexpr std::size_t fewest = 4;
  if (!record.pairs || record.pairs->pairs.empty() || record.pairs->pairs.size() >= fewest) return {};
  const identify::CandidateMeasurement first = identify::first_levels(record.pairs->pairs, constants, limits);
  if (first.cost < 1.0) return {};
  const PlannedRig rig = {constants.natural_frequency(), identify::unknown, constants.coordinate};
  return "; measure first " + instruction_of(first, rig, units) +
         "; wait after each change until x is steady, and leave out levels at which the mass sticks";
}

/// Advice, present ranges and candidates.
void add_design(const identify::Design& design, const PlannedRig& rig, const ShownUnits& units, Answer& answer) {
  std::vector<std::string> instructions;
  for (const MeasurementAdvice& advice : design.advice)
    instructions.push_back(instruction_of(advice.candidate, rig, units));
  if (!design.left_out.empty()) answer.warnings.push_back(warning_of_limits(design.left_out));
  Json& result = answer.result;
  result["advice"] = summary_of(design, instructions.front());
  result["hull95"] = {{"zeta", design.now.zeta_hull}, {"F0", design.now.F0_hull}};
  result["inflation"] = finite_or_null(design.now.inflation);
  result["candidates"] = Json::array();
  for (std::size_t i = 0; i < design.advice.size(); ++i)
    result["candidates"].push_back(advice_json(design.advice[i], instructions[i], rig));
  result["left_out"] = design.left_out;
  answer.tables.push_back(candidate_table(design.advice, std::move(instructions)));
}

}  // namespace

Answer DesignQuestion::run(const RunContext& context) const {
  std::vector<std::string> warnings;
  const identify::Record record = record_->record(context, warnings);
  const IdentifyQuestion::Methods& methods = record_->methods();
  if (const auto gross = identify::bounded_influence(record, methods.constants).gross)
    return failed(identify::text_of(*gross) + ": correct this reading or remove it");
  identify::ParameterSet moved;
  if (methods.uncertainties.any()) {
    const identify::Estimate by =
        identify::moved_by_constants(record, methods.constants, methods.uncertainties, options_);
    if (by.std) moved = *by.std;
    warnings.insert(warnings.end(), by.warnings.begin(), by.warnings.end());
  }
  const auto found = identify::design_after(record, methods.constants, options_,
                                            identify::interval_options(options_), moved, limits_);
  const ShownUnits units = context.written_units == nullptr ? ShownUnits{} : shown_units(*context.written_units);
  if (const auto* why = std::get_if<std::string>(&found))
    return failed(*why + what_to_do_first(record, methods.constants, limits_, units));
  const auto& design = std::get<identify::Design>(found);
  std::ranges::move(identify::warnings_about(design.now, options_), std::back_inserter(warnings));
  if (const std::string misfit = identify::no_law_fits(design.now); !misfit.empty())
    warnings.push_back(misfit +
                       ": a stated noise that is too small, a wrong frequency or constant, or friction that "
                       "no law of the library has. The ranges and the advice are not to be used");
  Answer answer;
  answer.warnings = std::move(warnings);
  const PlannedRig rig = {methods.constants.natural_frequency(), design.now.mean.zeta,
                          methods.constants.coordinate};
  add_design(design, rig, units, answer);
  for (Table& table : law_tables(design.now, methods.constants)) answer.tables.push_back(std::move(table));
  return answer;
}

const Analysis& design_analysis() {
  static const Analysis analysis = {.name = "design",
                                    .summary =
                                        "what to measure next, so that the ranges over friction laws narrow; "
                                        "without a scenario the command next",
                                    .keys = design_keys(),
                                    .needs = design_needs(),
                                    .results = design_fields(),
                                    .uses_uncertainties = true,
                                    .check = check_design,
                                    .ask = ask_design};
  return analysis;
}

}  // namespace dualdamp::scenarios
