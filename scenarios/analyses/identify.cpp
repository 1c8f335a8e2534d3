#include "scenarios/analyses/identify.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "identify/ledger/estimate/unstated_constants.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "identify/outliers/outliers.hpp"
#include "identify/records/pendulum.hpp"
#include "scenarios/analyses/shared/identify_options.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/measured_data.hpp"
#include "scenarios/measurements/measurement.hpp"
#include "scenarios/measurements/method_choice.hpp"
#include "scenarios/measurements/sensors.hpp"
#include "scenarios/results/estimates.hpp"
#include "scenarios/results/outliers.hpp"

namespace dualdamp::scenarios {

namespace {

/// Sensors that the methods read.
std::vector<std::string> signals_of(const identify::Record& record) {
  std::vector<std::string> signals;
  const auto holds = [&](auto signal) {
    return std::ranges::any_of(record.histories, [&](const identify::History& h) { return !(h.*signal).empty(); });
  };
  if (holds(&identify::History::y)) signals.emplace_back("y");
  if (record.pairs) signals.emplace_back("Y");
  if (record.pairs || record.decay || holds(&identify::History::x)) signals.emplace_back("x");
  if (holds(&identify::History::v)) signals.emplace_back("v");
  if (holds(&identify::History::a)) signals.emplace_back("a");
  if (holds(&identify::History::force)) signals.emplace_back("force");
  return signals;
}

}  // namespace

Field gain_uncertainty_field() {
  Section signals;
  for (const char* name : {"y", "Y", "x", "v", "a", "force"}) {
    signals.fields.push_back(
        quantity(name, {"1"}, std::string("relative standard uncertainty of the gain of ") + name).at_least(0));
    signals.fields.back().range.high = 1.0;
    signals.fields.back().range.high_open = true;
  }
  return section("gain_uncertainty", std::move(signals),
                 "relative standard uncertainties of the gains of the sensors: {x: 1 %}; y and Y have one "
                 "gain, by either name");
}

std::optional<identify::Record> outlined_record(const CheckedFile& file) {
  if (file.needs() == nullptr) return std::nullopt;
  if (file.needs()->source != "data") return outline(file);
  return file.data ? std::optional(file.data->record) : std::nullopt;
}

void check_gains(CheckedFile& file, const identify::Record& record) {
  if (!file.has("analysis", "gain_uncertainty")) return;
  const std::vector<std::string> signals = signals_of(record);
  const Json gains = file.values().at("analysis").at("gain_uncertainty");
  if (gains.contains("y") && gains.contains("Y"))
    file.complain("analysis.gain_uncertainty.Y",
                  "the uncertainty of the gain of y, which is that of Y, is stated twice", "one of the two",
                  "y and Y");
  const bool has_drive = std::ranges::any_of(signals, [](const std::string& s) { return s == "y" || s == "Y"; });
  for (const auto& [signal, gain] : gains.items()) {
    if (std::ranges::find(signals, signal) != signals.end()) continue;
    if (has_drive && (signal == "y" || signal == "Y")) continue;
    file.complain("analysis.gain_uncertainty." + signal,
                  "the gain of " + signal + " is uncertain, and the record has no " + signal,
                  "signals of the record: " + core::joined(signals), signal);
  }
}

std::vector<IdleKey> idle_beside_data() {
  const std::string fit = "analysis 'fit' takes it as stated";
  const std::string recorded = "the drive is that of the record";
  std::vector<IdleKey> keys = {
      {"system", "damping", "the damping is what the methods seek; " + fit, ""},
      {"system", "damping_ratio", "the damping is what the methods seek", ""},
      {"system", "friction", "friction is what the methods seek, as Coulomb + viscous, or over all laws; " + fit,
       ""},
      {"system", "damper_to",
       "the methods take the damper between mass and ground; with one between mass and base, zeta and F0 of these "
       "data would be wrong",
       "ground; " + fit},
      {"system", "cubic_stiffness", "the methods take a linear spring", "0; " + fit},
      {"excitation", "amplitude", recorded, ""},
      {"excitation", "phase", recorded, ""},
      {"excitation", "harmonics", recorded + ", and that of x-Y pairs has one frequency", fit}};
  std::ranges::move(idle_start("the motion is that of the record"), std::back_inserter(keys));
  return keys;
}

void warn_of_unknown_damper(CheckedFile& file) {
  const bool rides_on_base = file.measurement() != nullptr && file.text_at("system", "damper_to") == "base" &&
                             moves_base(file.text_at("excitation", "type"));
  if (rides_on_base && file.number_at("system", "damping").value_or(0.0) != 0.0)
    file.warnings.emplace_back(
        "'system.damper_to' is base, and the methods take the damper between mass and ground: zeta and F0 of this "
        "rig come out wrong, and no assumption that is tested names the reason");
}

namespace {

Section identify_keys() {
  std::vector<Field> fields = data_fields();
  std::ranges::move(measurement_fields(), std::back_inserter(fields));
  fields.push_back(methods_key("all that can read the data"));
  std::ranges::move(method_option_fields(), std::back_inserter(fields));
  fields.push_back(gain_uncertainty_field());
  fields.push_back(
      quantity("least_change", {"1"},
               "smallest relative change of zeta or F0, when an assumption is relaxed, for which a departure "
               "counts")
          .with_fallback(identify::LedgerOptions{}.least_change)
          .at_least(0));
  fields.push_back(
      boolean("robust",
              "limits the influence of readings that do not agree with the others (Huber), and replaces spikes in "
              "histories of a data file"));
  return {std::move(fields), {{{"data", "measurement"}, true}}};
}

std::vector<Needs> identify_needs() {
  const std::string base = "the methods need the amplitude of the base";
  return {{"xy_curve", {"base_harmonic"}, {}, true, base},
          {"frequency_response", {"base_harmonic"}, {"amplitude"}, true, base},
          {"simulate", excitations().names(), {"frequency"}, true, ""},
          needs_of_free_vibrations("free_decay"),
          {"data", {"base_harmonic", "none"}, {"frequency"}, false, base, idle_beside_data()}};
}

void check_identify(CheckedFile& file) {
  check_measurement(file);
  warn_of_unknown_damper(file);
  read_data(file);
  const std::optional<identify::Record> record = outlined_record(file);
  if (!record) return;
  check_gains(file, *record);
  resolve_methods(file, {*record}, SlowMethods::run);
  check_frequency(file, *record);
  check_method_options(file, record->pairs ? record->pairs->pairs.size() : 0);
}

identify::ConstantUncertainties uncertainties_of(const CheckedValues& values) {
  identify::ConstantUncertainties uncertainties;
  const Json gains = values.analysis.value("gain_uncertainty", Json::object());
  for (const identify::StatedNumber& number : identify::stated_numbers) {
    const bool is_of_drive = number.constant == &identify::KnownConstants::frequency;
    const Json& section = number.is_gain() ? gains : is_of_drive ? values.excitation : values.system;
    const bool is_of_Y = number.is_gain() && number.name == "y" && gains.contains("Y");
    const std::string key = is_of_Y            ? "Y"
                            : number.is_gain() ? std::string(number.name)
                                               : uncertainty_key(std::string(number.name));
    if (section.is_object()) uncertainties.*number.uncertainty = number_or(section, key, 0.0);
  }
  return uncertainties;
}

/// The estimate of a method from any record.
identify::Reader reader_of(const identify::MethodEntry& method, const identify::OptionValues& options) {
  return [&method, &options](const identify::Record& record, const identify::KnownConstants& constants) {
    return method.run(record, constants, method.own(options));
  };
}

/// The estimate of the ledger's joint model from any record.
identify::Reader reader_of_joint(const identify::LedgerOptions& options) {
  return [options](const identify::Record& record, const identify::KnownConstants& constants) {
    return identify::ledger_of(record, constants, options)
        .joint.value_or(
            identify::Estimate{.outcome = {core::OutcomeKind::not_identifiable, "there is no joint model"}});
  };
}

identify::KnownConstants constants_of(const sim::Model& model) {
  // A measurement at several frequencies does not need the frequency of the excitation, which is then zero.
  const bool has_frequency = model.excitation.is_harmonic() && model.excitation.frequency > 0.0;
  return {model.oscillator.mass, model.oscillator.stiffness,
          has_frequency ? model.excitation.frequency : identify::unknown, model.oscillator.coordinate};
}

std::unique_ptr<const IdentifyQuestion> question_of(CheckedValues&& values, IdentifyQuestion::Methods methods) {
  const Json& section = values.analysis;
  if (values.data) return std::make_unique<IdentifyQuestion>(std::move(*values.data), std::move(methods));
  IdentifyQuestion::Synthetic synthetic{.measurement = measurement_of(section.at("measurement"), values.model)};
  if (section.contains("sensors")) {
    synthetic.sensors = sensors_of(section.at("sensors"));
    synthetic.seed = section.at("sensors").at("seed").get<std::uint64_t>();
  }
  return std::make_unique<IdentifyQuestion>(std::move(synthetic), std::move(methods));
}

std::unique_ptr<const Question> ask_identify(CheckedValues&& values) {
  const Json& section = values.analysis;
  IdentifyQuestion::Methods methods = {methods_of(section.at("methods")),
                                       constants_of(values.model),
                                       uncertainties_of(values),
                                       method_options(section),
                                       {section.at("least_change").get<double>(), uncertainties_of(values),
                                        identify::taken_from<identify::KnownDeviations>(method_options(section))},
                                       section.value("robust", false)};
  return question_of(std::move(values), std::move(methods));
}

std::optional<std::size_t> identify_length_of(const CheckedFile& file, std::string_view list) {
  if (list != "estimates" || !file.has("analysis", "methods")) return std::nullopt;
  return file.values().at("analysis").at("methods").size();
}

}  // namespace

std::unique_ptr<const IdentifyQuestion> record_question(CheckedValues&& values) {
  IdentifyQuestion::Methods no_methods{.constants = constants_of(values.model),
                                       .uncertainties = uncertainties_of(values)};
  return question_of(std::move(values), std::move(no_methods));
}

const identify::Record* IdentifyQuestion::measured() const {
  const auto* data = std::get_if<identify::MeasuredRecord>(&source_);
  return data == nullptr ? nullptr : &data->record;
}

identify::Record IdentifyQuestion::record(const RunContext& context, std::vector<std::string>& warnings) const {
  const sim::Oscillator& oscillator = context.model.oscillator;
  if (const auto* data = std::get_if<identify::MeasuredRecord>(&source_)) {
    warnings = data->warnings;
    identify::Record record = data->record;
    identify::linearise_pendulum(record, oscillator.stiffness, oscillator.gravity_stiffness, warnings);
    return record;
  }
  const auto& [measurement, sensors, seed] = std::get<Synthetic>(source_);
  MotionRecord motion = motion_of(context.model, measurement, sensors, context.steady_states());
  warnings = std::move(motion.warnings);
  identify::Record record = reading(motion, sensors, seed, warnings);
  identify::linearise_pendulum(record, oscillator.stiffness, oscillator.gravity_stiffness, warnings);
  return record;
}

/// For a method that takes seconds. The effect of the constants' uncertainties is taken from the fit of plain
/// friction.
identify::Estimate IdentifyQuestion::slow_estimate(const identify::Reader& reader,
                                                   const identify::Record& record) const {
  identify::Estimate estimate = reader(record, methods_.constants);
  if (!estimate.outcome.ok() || !methods_.uncertainties.any()) return estimate;
  const auto options =
      identify::taken_from<identify::AnyLawOptions>(identify::any_law_method.own(methods_.options));
  const identify::Estimate moved =
      identify::moved_by_constants(record, methods_.constants, methods_.uncertainties, options);
  if (moved.std) {
    identify::widen(*moved.std, estimate);
  } else {
    estimate.std.reset();
    estimate.interval95.reset();
  }
  estimate.warnings.insert(estimate.warnings.end(), moved.warnings.begin(), moved.warnings.end());
  return estimate;
}

identify::Identification IdentifyQuestion::conclude(const identify::Record& data,
                                                    const identify::BoundedInfluence& bounded) const {
  const identify::Record& record = methods_.robust ? bounded.record : data;
  const double within = methods_.robust ? bounded.within : 1.0;
  const auto read = [&](const identify::Reader& reader) {
    return identify::with_uncertainties(reader, record, methods_.constants, methods_.uncertainties);
  };
  identify::Ledger ledger = identify::ledger_of(record, methods_.constants, methods_.ledger);
  if (bounded.gross && !methods_.robust) ledger.gross_error = identify::text_of(*bounded.gross);
  identify::reach_over_unstated(record, methods_.constants, methods_.ledger, ledger);
  std::vector<identify::Estimate> estimates;
  for (const identify::MethodEntry* method : methods_.list) {
    const identify::Reader reader = reader_of(*method, methods_.options);
    estimates.push_back(method->takes_seconds ? slow_estimate(reader, record) : read(reader));
  }
  if (ledger.joint && methods_.uncertainties.any() && !ledger.joint_knows_uncertainties)
    ledger.joint = read(reader_of_joint(methods_.ledger));
  for (identify::Estimate& estimate : estimates) identify::widen(estimate, within);
  if (ledger.joint) identify::widen(*ledger.joint, within);
  return identify::concluded(std::move(estimates), std::move(ledger));
}

std::vector<identify::Sensitivity> IdentifyQuestion::sensitivities(const identify::Identification& found,
                                                                   const identify::Record& record) const {
  if (!found.answer) return {};
  const identify::Estimate& best = found.estimates[*found.answer];
  const identify::MethodEntry* method = identify::find_method(best.method);
  if (method != nullptr && method->takes_seconds) return {};
  // With the same relaxations and no others: otherwise a changed constant would itself be relaxed, and the
  // sensitivity would be lost.
  const identify::Reader joint = [&](const identify::Record& moved, const identify::KnownConstants& constants) {
    return identify::joint_fit(moved, constants, found.ledger.relaxed, methods_.ledger);
  };
  const identify::Reader reader = method == nullptr ? joint : reader_of(*method, methods_.options);
  return identify::sensitivities(reader, best, record, methods_.constants, methods_.uncertainties);
}

Answer IdentifyQuestion::run(const RunContext& context) const {
  std::vector<std::string> warnings;
  const identify::Record data = record(context, warnings);
  std::ranges::move(unused_options(methods_.options, methods_.list), std::back_inserter(warnings));
  const identify::BoundedInfluence bounded = identify::bounded_influence(data, methods_.constants);
  const identify::Identification found = conclude(data, bounded);
  Answer answer = answer_of(found, data, methods_.constants);
  if (!answer.result.is_null()) {
    add_outliers(bounded.outliers, methods_.robust, answer);
    add_sensitivities(sensitivities(found, methods_.robust ? bounded.record : data), answer);
  }
  answer.warnings.insert(answer.warnings.begin(), warnings.begin(), warnings.end());
  return answer;
}

const Analysis& identify_analysis() {
  static const Analysis analysis = {
      .name = "identify",
      .summary = "estimates by the identification methods from measured or simulated data",
      .keys = identify_keys(),
      .needs = identify_needs(),
      .results = joined(estimate_fields(), outlier_fields()),
      .main = {"answer.zeta", "answer.F0", "answer.c"},
      .chart = {.table = "",
                .list = "fit.points",
                .x = "Y",
                .y = "x",
                .x_label = "input amplitude Y",
                .y_label = "output amplitude x",
                .further = "fitted",
                .kind = MainChart::Kind::points,
                .x_otherwise = "number",
                .is_by_x = true},
      .uses_uncertainties = true,
      .check = check_identify,
      .ask = ask_identify,
      .length_of = identify_length_of};
  return analysis;
}

}  // namespace dualdamp::scenarios
