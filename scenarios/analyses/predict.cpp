#include "scenarios/analyses/predict.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "friction_models/registry.hpp"
#include "identify/fit/assumed_drive.hpp"
#include "identify/fit/prediction.hpp"
#include "scenarios/analyses/shared/record_drive.hpp"
#include "scenarios/analyses/shared/record_holds.hpp"
#include "scenarios/analyses/shared/record_zeros.hpp"
#include "scenarios/analyses/shared/structural_damping.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/law_values.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/measured_data.hpp"
#include "scenarios/results/fits.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr std::size_t most_parameters = 100;
constexpr std::size_t most_marks = 100'000;

Section predict_keys() {
  return {
      {data_list("data", "data files that the rig has to predict").required(),
       name_list("free",
                 "names of the numbers that were fitted; they are fitted to the data to find the error that the "
                 "same laws can attain"),
       name_list(
           "zeros",
           "names of the sensors' zeros that the fit sought in its records, such as offset; those of the data "
           "are fitted to them"),
       quantities("covariance", {"1"},
                  "covariance of these numbers, row by row, SI; it gives the error that their uncertainty "
                  "explains")
           .items(1, most_parameters * most_parameters),
       quantities("undetermined", {"1"},
                  "changes of these numbers that the fit does not determine, one after the other, SI; their "
                  "size does not matter")
           .items(1, most_parameters * most_parameters),
       quantities("fitted_readings", {"1"},
                  "marks of the readings that were fitted, 'fitted_readings' of the fit: data with the same "
                  "readings are refused")
           .items(1, most_marks),
       boolean("drive_of_fit",
               "the drive is that of the fit, and nothing states that these records had it: the prediction is "
               "refused if they show that they had not")}};
}

std::vector<identify::FitParameter> fitted_parameters(const identify::Rig& rig, const Json& analysis,
                                                      std::vector<SetupFault>& faults) {
  const std::vector<identify::FitParameter> all = identify::parameters_of(rig);
  std::vector<identify::FitParameter> parameters;
  for (const std::string& name : sought_of(analysis, false).free) {
    std::string fault;
    std::vector<identify::FitParameter> found = identify::named(all, name, fault);
    if (!fault.empty()) faults.push_back({"free", fault});
    for (identify::FitParameter& parameter : found) parameters.push_back(std::move(parameter));
  }
  identify::arrange(rig, parameters);
  const std::size_t size = parameters.size();
  if (analysis.contains("covariance") && analysis.at("covariance").size() != size * size)
    faults.push_back({"covariance", "'analysis.covariance' has " +
                                        std::to_string(analysis.at("covariance").size()) + " numbers, and " +
                                        std::to_string(size) + " parameters need " + std::to_string(size * size)});
  if (analysis.contains("undetermined") && (size == 0 || analysis.at("undetermined").size() % size != 0))
    faults.push_back({"undetermined", "'analysis.undetermined' has " +
                                          std::to_string(analysis.at("undetermined").size()) +
                                          " numbers, and each change of " + std::to_string(size) +
                                          " parameters needs " + std::to_string(size)});
  return parameters;
}

/// The zeros that the fit sought in its records.
std::vector<identify::FitParameter> fitted_zeros(const Json& analysis, std::vector<SetupFault>& faults) {
  std::vector<identify::FitParameter> zeros;
  for (const Json& name : analysis.value("zeros", Json::array())) {
    const std::optional<identify::RecordParameter> found = identify::find_record_parameter(name.get<std::string>());
    if (!found || std::ranges::find(identify::sensor_zeros, *found, &identify::SensorZero::which) ==
                      identify::sensor_zeros.end())
      faults.push_back({"zeros", "'" + name.get<std::string>() +
                                     "' in 'analysis.zeros' is no zero: offset, offset_v, offset_a "
                                     "and offset_force are those of x, v, a and force"});
    else
      zeros.push_back(
          {.name = identify::name_of(*found), .owner = identify::Owner::record, .record_parameter = *found});
  }
  return zeros;
}

/// The numbers of a key as rows of `size`; empty without the key.
Eigen::MatrixXd rows_of(const Json& analysis, const std::string& key, std::size_t size) {
  if (!analysis.contains(key) || size == 0) return {};
  const Json& numbers = analysis.at(key);
  const std::size_t rows = numbers.size() / size;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(size));
  for (std::size_t i = 0; i < rows * size; ++i)
    matrix(static_cast<Eigen::Index>(i / size), static_cast<Eigen::Index>(i % size)) = number(numbers.at(i));
  return matrix;
}

/// The reader asks for no number of a law, because the fit to the data themselves seeks those that were fitted, and
/// those whose default is the value of another one have to follow it there.
void check_laws(CheckedFile& file) {
  if (!file.has("system", "friction")) return;
  const Json& friction = file.values().at("system").at("friction");
  const Json list = friction.is_array() ? friction : Json::array({friction});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = "system.friction" + (friction.is_array() ? "[" + std::to_string(i) + "]" : "");
    if (!list[i].is_object() || !list[i].contains("law")) continue;  // reported
    const friction::LawEntry& law = *friction::find_law(list[i].at("law").get<std::string>());
    friction::ParameterValues values = law_values(law.parameters, list[i], file.coordinate());
    for (const friction::ParameterFault& fault : friction::complete(law, values))
      if (fault.is_missing)
        file.complain(path,
                      "'" + path + "." + fault.name + "' is missing: a prediction needs the friction's numbers",
                      fault.allowed);
  }
}

void check_predict(CheckedFile& file) {
  read_data_list(file, "data");
  if (file.has("analysis", "fitted_readings")) {
    std::vector<double> marks;
    for (const Json& mark : file.values().at("analysis").at("fitted_readings")) marks.push_back(number(mark));
    refuse_fitted(file, marks);
  }
  const bool assumes_drive = file.values().at("analysis").value("drive_of_fit", false);
  take_recorded_drives(file, assumes_drive || leaves_drive_open(file));
  check_laws(file);
  // A loop compares forces: a constant that the fit lacked has no part in them.
  if (std::ranges::all_of(items_of(file.values().at("analysis"), file.files, "data"), &DataItem::is_loop)) return;
  std::vector<std::string> lacking;
  for (const char* key : {"mass", "stiffness", "damping"})
    if (!file.has("system", key)) lacking.emplace_back(key);
  if (!lacking.empty())
    file.complain("system",
                  "the prediction of a motion needs the whole rig, and 'system' lacks " + core::joined(lacking),
                  "mass, stiffness, damping, such as " + file.words()(core::Setting::value, "system.mass", "2 kg"));
}

/// "base_harmonic, 0.004 m, 3.7 Hz"
std::string drive_text(const Json& section, const sim::Model& model) {
  const sim::Excitation& drive = model.excitation;
  if (drive.type == sim::ExcitationType::none) return "none";
  std::string text = section.at("type").get<std::string>();
  if (section.contains("file")) return text + ", file " + section.at("file").get<std::string>();
  if (drive.is_harmonic() || drive.is_chirp())
    text += ", " + core::format_number(drive.amplitude, 6) + " " + model.unit(drive.unit());
  if (drive.is_harmonic()) text += ", " + core::format_number(drive.frequency / core::two_pi, 6) + " Hz";
  return text;
}

/// The drive of the fit, if it is assumed for a history; empty if the records hold their drive, or need none.
std::string assumed_drive(const CheckedValues& values, const std::vector<DataItem>& items) {
  if (!values.analysis.value("drive_of_fit", false)) return {};
  const sim::Excitation& drive = values.model.excitation;
  const bool is_assumed = std::ranges::any_of(items, [&](const DataItem& item) {
    if (item.is_loop()) return false;
    const std::vector<identify::History>& histories = item.data.record.histories;
    for (std::size_t h = 0; h < histories.size(); ++h) {
      if (item.drive_of(h) != nullptr) continue;
      const bool is_none = drive.type == sim::ExcitationType::none;
      if (is_none || (drive.moves_base() ? histories[h].y : histories[h].force).empty()) return true;
    }
    return false;
  });
  return is_assumed ? drive_text(values.excitation, values.model) : std::string();
}

/// Why a record that the rig explains without the drive that was assumed is not judged; empty if there is none.
std::string undriven_text(const identify::Rig& rig, const identify::Fit& held, const identify::Experiments& data,
                          const std::string& drive, const core::SettingWords& words) {
  const std::optional<identify::UndrivenRecord> found = identify::undriven_record(rig, held, data);
  if (!found) return {};
  constexpr int digits = 3;
  return data[found->experiment]->label +
         ": nothing states the drive of this record. Under the drive of the fit (" + drive +
         ") the prediction misses by " + core::percent(found->with_drive, digits) + ", and without a drive by " +
         core::percent(found->without_drive, digits) + ": " +
         words(core::Setting::value, "excitation", "{type: none}") +
         ", or state its drive (beside other records 'drive: none')";
}

/// Why a record is not judged that moves on where the rig without a drive comes to rest; empty if there is none.
std::string driven_text(const identify::Fit& held, const identify::Experiments& data,
                        const core::SettingWords& words) {
  const std::optional<std::size_t> found = identify::record_with_unknown_drive(held, data);
  if (!found) return {};
  return data[*found]->label +
         ": neither the scenario nor the fit states a drive for this record. The rig without a drive comes to rest, "
         "and the record does not: a drive seems to be missing. State it by " +
         words(core::Setting::frequency) + " or " + words(core::Setting::value, "excitation", "{...}") +
         ", or '{type: none}' if there was none";
}

/// The records as they are if the assumed drive did not drive them; empty if none is assumed. Faults are told of
/// the records under the drive.
identify::Experiments undriven_data(std::vector<DataItem> items, const CheckedValues& values) {
  if (!values.analysis.value("drive_of_fit", false)) return {};
  sim::Model model = values.model;
  model.excitation = {};
  std::vector<SetupFault> faults;
  static_cast<void>(leave_out_holds(items, model, false));
  static_cast<void>(remove_zeros(items, model, {}));
  return experiments_from(items, "data", model, {}, faults);
}

std::unique_ptr<const Question> ask_predict(CheckedValues&& values) {
  std::vector<SetupFault> faults;
  identify::Rig rig = rig_of(values.system, model_for_fit(values));
  std::vector<identify::FitParameter> parameters = fitted_parameters(rig, values.analysis, faults);
  const std::vector<identify::FitParameter> zeros = fitted_zeros(values.analysis, faults);
  std::vector<DataItem> items = items_of(values.analysis, values.files, "data");
  // The drive of the fit stands in the scenario for the records that need it, and so may a measured one.
  if (!values.analysis.value("drive_of_fit", false) && values.model.excitation.is_harmonic())
    refuse_idle_drive(items, values.model, faults);
  identify::Experiments undriven = undriven_data(items, values);
  std::vector<std::string> warnings = leave_out_holds(items, values.model, false);
  std::ranges::move(remove_zeros(items, values.model, {}), std::back_inserter(warnings));
  identify::Experiments data = experiments_from(items, "data", values.model, {}, faults);
  check_structural_damping(rig, {}, data, "data", faults);
  // The drive of the fit is not assumed for a record that seems to hold another.
  const bool assumes_base = values.analysis.value("drive_of_fit", false) && values.model.excitation.moves_base();
  for (const DataItem& item : items)
    if (assumes_base && std::ranges::all_of(item.data.record.histories, [](const auto& h) { return h.y.empty(); }))
      if (std::string idle = idle_drive(item, {}); !idle.empty()) faults.push_back({"data", std::move(idle)});
  refuse_other_drives(items, "data", values.model, values.drive_start, {}, faults);
  throw_if_any(faults);
  std::ranges::move(drive_warnings(items, values.model), std::back_inserter(warnings));
  for (const DataFile& file : values.files)
    for (const std::string& warning : file.data.warnings) warnings.push_back(file.name + ": " + warning);
  identify::SharedUncertainty uncertainty = {
      rows_of(values.analysis, "covariance", parameters.size()),
      rows_of(values.analysis, "undetermined", parameters.size()).transpose()};
  std::ranges::copy(zeros, std::back_inserter(parameters));
  return std::make_unique<PredictQuestion>(PredictQuestion::Setup{.rig = std::move(rig),
                                                                  .parameters = std::move(parameters),
                                                                  .uncertainty = std::move(uncertainty),
                                                                  .data = std::move(data),
                                                                  .undriven_data = std::move(undriven),
                                                                  .warnings = std::move(warnings),
                                                                  .assumed_drive = assumed_drive(values, items),
                                                                  .words = values.words});
}

}  // namespace

Answer PredictQuestion::run(const RunContext& /*context*/) const {
  const auto& [rig, parameters, uncertainty, data, undriven_data, warnings, assumed_drive, words] = setup_;
  const bool is_driven = rig.known.excitation.type != sim::ExcitationType::none;
  const identify::Experiments& undriven = undriven_data.size() == data.size() ? undriven_data : data;
  const auto refuses = [&](const identify::Fit& held) {
    if (assumed_drive.empty()) return std::string();
    return is_driven ? undriven_text(rig, held, undriven, assumed_drive, words) : driven_text(held, data, words);
  };
  identify::Prediction prediction = identify::predict_records(rig, parameters, uncertainty, data, {}, refuses);
  if (!prediction.outcome.ok()) return failed(prediction.outcome.reason);
  if (!assumed_drive.empty() && !std::isnan(prediction.error) && (is_driven || prediction.is_wrong))
    prediction.text += "; this holds if the record had the drive of the fit, which was assumed: " + assumed_drive;
  Answer answer;
  answer.warnings = warnings;
  std::ranges::move(prediction.warnings, std::back_inserter(answer.warnings));
  answer.result["validation"] = validation_json(prediction);
  answer.result["verdict"] = prediction.text;
  add_curves(prediction.fit, data, "prediction", answer);
  return answer;
}

const Analysis& predict_analysis() {
  static const Analysis analysis = {
      .name = "predict",
      .summary = "a fitted rig against records that were not fitted",
      .keys = predict_keys(),
      .needs = {{"",
                 excitations().names(),
                 {},
                 false,
                 "",
                 idle_start("the state at the first sample of a record is fitted to the record")}},
      .results = joined(validation_fields("validation."), {{"verdict", "", "what that means"}}),
      .chart = {.overlay = "prediction"},
      .seeks_laws = true,
      .steady_vibrations = true,
      .check = check_predict,
      .ask = ask_predict};
  return analysis;
}

}  // namespace dualdamp::scenarios
