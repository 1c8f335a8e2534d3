#include "scenarios/analyses/fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "friction_models/registry.hpp"
#include "identify/fit/comparison.hpp"
#include "scenarios/analyses/shared/compared_laws.hpp"
#include "scenarios/analyses/shared/record_drive.hpp"
#include "scenarios/analyses/shared/record_holds.hpp"
#include "scenarios/analyses/shared/record_zeros.hpp"
#include "scenarios/analyses/shared/structural_damping.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/measured_data.hpp"
#include "scenarios/results/fits.hpp"
#include "scenarios/results/fitted_rig.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

Field law_list() {
  std::vector<std::string> names;
  for (const friction::LawEntry& law : friction::laws()) names.emplace_back(law.name);
  return word_list("laws", std::move(names), "laws to compare, each by itself, in place of system.friction")
      .items(1, 32);
}

Section fit_keys() {
  return {
      {data_list("data", "data files of the rig: pairs, responses, decays, histories, loops").required(),
       data_list("validate", "further data files, which the fitted rig has to predict"), law_list(),
       name_list("free",
                 "names of numbers to fit in addition to those that the system leaves out: [kinetic, mass]; "
                 "the search begins at the values that the system states"),
       section_list("bounds",
                    {{text("name", "name of a fitted number").required(), text("low", "its smallest value"),
                      text("high", "its largest value")}},
                    "limits of fitted numbers")
           .items(1, 100),
       section_list(
           "stated",
           {{text("name", "name of a number of one of the laws: iwan.count, or count if one law has it").required(),
             text("value", "its value").required()}},
           "numbers of laws that are compared; the others are sought")
           .items(1, 100),
       boolean("robust", "limits the influence of readings that do not agree with the others (Huber)"),
       boolean("profile", "also compute intervals by the profile of the likelihood").with_fallback(true),
       integer("starts", "number of starts of the search; default: 40, or 8 if every number is stated")
           .at_least(1)
           .at_most(10'000)}};
}

/// Faults are added to `faults`. The caller knows the options, the drive of the scenario, the marks and the
/// warnings about files.
FitQuestion::Setup setup_of(const Json& analysis, const Json& system, const Json& excitation,
                            const sim::Model& model, bool initial_is_known, const std::vector<DataFile>& files,
                            std::vector<SetupFault>& faults) {
  FitQuestion::Setup setup;
  const Sought sought = sought_of(analysis, initial_is_known);
  std::vector<DataItem> data = items_of(analysis, files, "data");
  std::vector<DataItem> validation = items_of(analysis, files, "validate");
  std::vector<DataItem> all = data;
  all.insert(all.end(), validation.begin(), validation.end());
  refuse_idle_drive(all, model, faults);
  if (initial_is_known && !data.empty()) refuse_idle_initial(data, faults);
  setup.warnings = undriven_warnings(data, model);
  for (auto* items : {&data, &validation})
    std::ranges::move(leave_out_holds(*items, model, initial_is_known && items == &data),
                      std::back_inserter(setup.warnings));
  std::ranges::move(remove_zeros(data, model, sought), std::back_inserter(setup.warnings));
  std::ranges::move(remove_zeros(validation, model, {}), std::back_inserter(setup.warnings));
  setup.data = experiments_from(data, "data", model, sought, faults);
  for (const auto& experiment : setup.data)
    setup.excitations.push_back(excitation_of(*experiment, data, excitation));
  setup.validation = experiments_from(validation, "validate", model, {sought.free, sought.bounds}, faults);
  if (setup.data.empty()) return setup;
  std::vector<std::string> laws = {""};
  if (analysis.contains("laws")) laws = analysis.at("laws").get<std::vector<std::string>>();
  std::vector<identify::Rig> rigs;
  for (const std::string& law : laws) rigs.push_back(rig_of(system, model, law));
  state_values(analysis, rigs, faults);
  for (std::size_t i = 0; i < laws.size(); ++i) {
    std::vector<identify::FitParameter> parameters =
        parameters_for(rigs[i], setup.data, sought_of_law(sought, laws, laws[i]), faults);
    if (i == 0) {
      check_structural_damping(rigs[i], parameters, setup.data, "data", faults);
      check_structural_damping(rigs[i], parameters, setup.validation, "validate", faults);
    }
    setup.candidates.push_back({std::move(rigs[i]), std::move(parameters)});
  }
  const auto is_loaded = [](const FitQuestion::Candidate& candidate) {
    return identify::remembers_path(candidate.rig, candidate.parameters);
  };
  if (model.initial.travel != 0.0 && std::ranges::none_of(setup.candidates, is_loaded))
    faults.push_back(
        {"data", "'initial.travel' has no effect: no law of this fit depends on earlier motion of the mass"});
  return setup;
}

/// The part of the drive that the names of parameters depend on.
sim::Model outlined_model(const CheckedFile& file) {
  sim::Model model;
  model.oscillator.mass = file.number_at("system", "mass").value_or(identify::unknown);
  model.oscillator.stiffness = file.number_at("system", "stiffness").value_or(identify::unknown);
  model.oscillator.coordinate = file.coordinate();
  model.excitation = excitation_named(file.text_at("excitation", "type"));
  if (!model.excitation.is_harmonic() && model.excitation.type != sim::ExcitationType::none)
    model.excitation.type =
        model.excitation.moves_base() ? sim::ExcitationType::base_samples : sim::ExcitationType::force_samples;
  model.excitation.amplitude = file.number_at("excitation", "amplitude").value_or(0.0);
  if (file.text_at("excitation", "frequency").ends_with("rad/s"))
    model.excitation.frequency = *file.number_at("excitation", "frequency");
  return model;
}

void check_fit(CheckedFile& file) {
  read_data_list(file, "data");
  read_data_list(file, "validate");
  take_recorded_drives(file, leaves_drive_open(file));
  const bool laws = file.has("analysis", "laws");
  if (laws && file.stands_in_file("system", "friction")) {
    file.withdraw("system.friction");
    file.complain(
        "analysis.laws",
        "'analysis.laws' stands beside 'system.friction', which it replaces: a parameter of laws that are compared "
        "is sought, unless 'analysis.stated' states it",
        "one of the two");
  }
  if (file.has("system", "damping_ratio"))
    file.complain("system.damping_ratio", "a damping ratio needs the mass and the stiffness",
                  "damping, or both constants");
  const bool faulty = file.files.empty() || (laws && file.stands_in_file("system", "friction")) ||
                      (file.stands_in_file("system", "friction") && !file.has("system", "friction"));
  if (faulty) return;
  if (file.has("system", "friction")) {
    const Json& friction = file.values().at("system").at("friction");
    for (const Json& law : friction.is_array() ? friction : Json::array({friction}))
      if (!law.is_object() || !law.contains("law")) return;
  }
  std::vector<SetupFault> faults;
  const Json& values = file.values();
  static_cast<void>(setup_of(values.at("analysis"), values.value("system", Json::object()),
                             values.value("excitation", Json()), outlined_model(file), values.contains("initial"),
                             file.files, faults));
  for (SetupFault& fault : faults) file.complain("analysis." + fault.path, std::move(fault.message));
}

std::unique_ptr<const Question> ask_fit(CheckedValues&& values) {
  std::vector<SetupFault> faults;
  FitQuestion::Setup setup = setup_of(values.analysis, values.system, values.excitation, model_for_fit(values),
                                      values.initial_is_stated, values.files, faults);
  std::vector<DataItem> all;
  for (const std::string key : {"data", "validate"}) {
    std::vector<DataItem> items = items_of(values.analysis, values.files, key);
    refuse_other_drives(items, key, values.model, values.drive_start, sought_of(values.analysis, false).free,
                        faults);
    std::ranges::move(items, std::back_inserter(all));
  }
  throw_if_any(faults);
  std::vector<std::string> warnings = drive_warnings(all, values.model);
  for (const DataFile& file : values.files)
    for (const std::string& warning : file.data.warnings) warnings.push_back(file.name + ": " + warning);
  std::ranges::move(setup.warnings, std::back_inserter(warnings));
  setup.warnings = std::move(warnings);
  setup.options = {.robust = values.analysis.value("robust", false),
                   .profile = values.analysis.value("profile", true),
                   .starts = values.analysis.value("starts", 0)};
  setup.excitation = values.excitation;
  setup.marks = marks_of_files(values.analysis, values.files);
  return std::make_unique<FitQuestion>(std::move(setup));
}

/// `unit`: of the rms.
Table law_table(const std::vector<identify::Fit>& fits, const std::vector<std::size_t>& order,
                const std::string& unit) {
  Table table{.name = "laws", .key = "laws"};
  Column law{.name = "law", .kind = CellKind::text};
  Column count{.name = "parameters", .kind = CellKind::count};
  Column criterion{.name = "AICc"};
  Column weight{.name = "weight"};
  Column rms{.name = "rms"};
  Column units{.name = "noise_units"};
  Column reason{.name = "reason", .kind = CellKind::text};
  double sum = 0.0;
  const auto weight_of = [&](const identify::Fit& fit) {
    return std::isnan(fit.AICc) ? 0.0 : std::exp(-0.5 * (fit.AICc - fits[order.front()].AICc));
  };
  for (const identify::Fit& fit : fits) sum += weight_of(fit);
  for (const std::size_t i : order) {
    const identify::Fit& fit = fits[i];
    law.texts.push_back(laws_text(fit.rig));
    count.numbers.push_back(static_cast<double>(fit.parameters.size()));
    criterion.numbers.push_back(fit.AICc);
    weight.numbers.push_back(std::isnan(fit.AICc) ? none : weight_of(fit) / sum);
    rms.numbers.push_back(fit.outcome.ok() ? fit.signals.front().rms : none);
    rms.row_units.push_back(unit);
    units.numbers.push_back(fit.noise_units);
    reason.texts.push_back(fit.outcome.reason);
  }
  table.columns = {law, count, criterion, weight, rms, units, reason};
  return table;
}

/// Best first, by AICc; then laws without AICc, then those without a fit.
std::vector<std::size_t> ranked(const std::vector<identify::Fit>& fits) {
  std::vector<std::size_t> order(fits.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    return std::tuple(!fits[i].outcome.ok(), std::isnan(fits[i].AICc),
                      std::isnan(fits[i].AICc) ? 0.0 : fits[i].AICc);
  });
  return order;
}

}  // namespace

Answer FitQuestion::run(const RunContext& /*context*/) const {
  const identify::Experiments& data = setup_.data;
  std::vector<identify::Fit> fits = identify::fit_rigs(setup_.candidates, data, setup_.options);
  identify::compare_fits(fits, setup_.options.robust);
  const std::vector<std::size_t> order = ranked(fits);
  const identify::Fit& best = fits[order.front()];
  if (!best.outcome.ok()) return failed(best.outcome.reason);
  Answer answer;
  answer.warnings = setup_.warnings;
  if (std::string weights = identify::warning_of_weights(fits); !weights.empty())
    answer.warnings.push_back(std::move(weights));
  answer.result["law"] = laws_text(best.rig);
  add_fit(best, data, answer);
  answer.result["laws"] = nullptr;
  answer.tables.push_back(law_table(fits, order, residual_unit(best, data)));
  add_curves(best, data, "fit", answer);
  if (!setup_.validation.empty()) {
    const identify::Prediction prediction =
        identify::predict_records(best.rig, setup_.candidates[order.front()].parameters, shared_uncertainty(best),
                                  setup_.validation, setup_.options);
    answer.result["validation"] = validation_json(prediction);
    std::ranges::copy(prediction.warnings, std::back_inserter(answer.warnings));
    if (prediction.outcome.ok()) add_curves(prediction.fit, setup_.validation, "prediction", answer);
    answer.result["verdict"] = prediction.text;
  }
  answer.result["fitted_readings"] = setup_.marks;
  answer.result["rig"] =
      rig_text(best, {laws_text(best.rig) + " fitted to " + data.front()->label, setup_.excitation});
  std::vector<RigText> texts;
  answer.result["scenarios"] = Json::array();
  for (std::size_t e = 0; e < data.size(); ++e) {
    texts.push_back({laws_text(best.rig) + " fitted to " + data[e]->label, setup_.excitations[e]});
    answer.result["scenarios"].push_back(scenario_text(best, data, e, texts.back()));
  }
  answer.result["scenario"] = answer.result["scenarios"].front();
  add_scenario_files(best, data, texts, answer);
  return answer;
}

const Analysis& fit_analysis() {
  static const Analysis analysis = {
      .name = "fit",
      .summary = "laws and constants of the rig fitted to measured records, and what they predict",
      .keys = fit_keys(),
      .needs = {{"", excitations().names(), {}, false, ""}},
      .results = joined(joined(fit_fields(), validation_fields("validation.")),
                        {{"verdict", "", "verdict of the validation"}}),
      .chart = {.overlay = "fit"},
      .seeks_laws = true,
      .steady_vibrations = true,
      .check = check_fit,
      .ask = ask_fit};
  return analysis;
}

}  // namespace dualdamp::scenarios
