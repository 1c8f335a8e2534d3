#include "scenarios/results/fitted_rig.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/coordinate.hpp"
#include "core/numbers.hpp"
#include "identify/experiments/drive_values.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/law_values.hpp"
#include "scenarios/format/limits.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::ExperimentKind;
using identify::RecordParameter;

bool is_plain(const std::string& text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  if (text == "true" || text == "false" || text == "null" || text == "yes" || text == "no") return false;
  return !text.empty() && text.find_first_not_of(letters) == std::string::npos;
}

std::string scalar(const Json& value) {
  if (value.is_number_float()) return core::format_number(value.get<double>());
  if (value.is_string() && is_plain(value.get<std::string>())) return value.get<std::string>();
  return value.dump();
}

/// Flow style on one line.
std::string flow(const Json& value) {
  if (!value.is_structured()) return scalar(value);
  std::string text;
  for (const auto& [key, item] : value.items())
    text += (text.empty() ? "" : ", ") + (value.is_array() ? "" : key + ": ") + flow(item);
  return value.is_array() ? "[" + text + "]" : "{" + text + "}";
}

std::string yaml(const Json& scenario) {
  std::string text;
  for (const auto& [key, value] : scenario.items()) {
    if (!value.is_object()) {
      text += key + ": " + (key == "schema" ? value.get<std::string>() : flow(value)) + "\n";
      continue;
    }
    text += key + ":\n";
    for (const auto& [inner, item] : value.items()) text += "  " + inner + ": " + flow(item) + "\n";
  }
  return text;
}

std::string in_rad_per_s(double omega) { return core::format_number(omega) + " rad/s"; }

/// What steady states were measured.
struct States {
  std::vector<double> amplitudes;   ///< of each state
  std::vector<double> frequencies;  ///< of each state
  std::size_t distinct = 0;         ///< number of states that differ
  std::set<double> levels;          ///< the distinct amplitudes
  std::set<double> places;          ///< the distinct frequencies

  explicit States(const identify::Experiment& experiment) {
    const std::vector<std::pair<double, double>> all = experiment.levels();
    for (const auto& [Y, omega] : all) {
      amplitudes.push_back(Y);
      frequencies.push_back(omega);
    }
    distinct = std::set(all.begin(), all.end()).size();
    levels = {amplitudes.begin(), amplitudes.end()};
    places = {frequencies.begin(), frequencies.end()};
  }
  /// Whether both vary, so that curves over one of them are swept over the other.
  [[nodiscard]] bool are_grid() const { return levels.size() > 1 && places.size() > 1; }
  /// Whether each amplitude was measured at so few of the frequencies that all combinations are too many.
  [[nodiscard]] bool are_scattered() const {
    constexpr std::size_t most = 10;
    return are_grid() && levels.size() * places.size() > most * amplitudes.size();
  }
};

template <typename Numbers>
Json in_rad_per_s_each(const Numbers& frequencies) {
  Json list = Json::array();
  for (const double omega : frequencies) list.push_back(in_rad_per_s(omega));
  return list;
}

void ask_for_states(const identify::Experiment& experiment, Json& scenario) {
  const States states(experiment);
  Json& drive = scenario["excitation"];
  if (!drive.is_object() || excitation_type(drive.value("type", "")) == sim::ExcitationType::none)
    drive = {{"type", "base_harmonic"}};
  drive.erase("amplitude");
  drive.erase("frequency");
  if (states.are_grid() && !states.are_scattered()) {
    if (states.levels.size() > states.places.size()) {
      scenario["analysis"] = {{"type", "xy_curve"}, {"amplitudes", states.levels}};
      scenario["sweep"] = {{"excitation.frequency", in_rad_per_s_each(states.places)}};
    } else {
      scenario["analysis"] = {{"type", "frequency_response"}, {"frequencies", in_rad_per_s_each(states.places)}};
      scenario["sweep"] = {{"excitation.amplitude", states.levels}};
    }
  } else if (states.levels.size() == 1 && states.places.size() > 1) {
    drive["amplitude"] = states.amplitudes.front();
    scenario["analysis"] = {{"type", "frequency_response"}, {"frequencies", in_rad_per_s_each(states.frequencies)}};
  } else {
    Json list = Json::array();
    for (std::size_t i = 0; i < states.amplitudes.size(); ++i)
      if (states.frequencies[i] == states.frequencies.front()) list.push_back(states.amplitudes[i]);
    drive["frequency"] = in_rad_per_s(states.frequencies.front());
    scenario["analysis"] = {{"type", "xy_curve"}, {"amplitudes", std::move(list)}};
  }
}

/// What the scenario of a record gives less or more than the record; empty if it gives the same.
std::string difference_from(const identify::Experiment& experiment) {
  if (experiment.kind != ExperimentKind::steady_states) return {};
  const States states(experiment);
  if (states.are_scattered())
    return "it gives the states at " + in_rad_per_s(states.frequencies.front()) +
           " alone: each amplitude was measured at few of the " + std::to_string(states.places.size()) +
           " frequencies";
  if (states.are_grid() && states.distinct < states.levels.size() * states.places.size())
    return "it also gives states that were not measured: all amplitudes at all frequencies";
  return {};
}

/// The time of the scenario begins with the record.
void begin_at(const sim::Excitation& drive, double start, double duration, Json& section) {
  const sim::Excitation there = identify::drive_from(drive, start, duration);
  if (drive.is_harmonic() || drive.is_chirp()) section["phase"] = there.phase;
  if (section.contains("harmonics"))
    for (std::size_t i = 0; i < there.harmonics.size(); ++i)
      section["harmonics"][i]["phase"] = there.harmonics[i].phase;
  if (drive.is_chirp()) {
    section["from"] = in_rad_per_s(there.chirp.from);
    section["duration"] = there.chirp.duration;
  } else if (drive.is_ramp() && there.samples) {
    section = {{"type", drive.moves_base() ? "base_table" : "force_table"},
               {"times", there.samples->times()},
               {"values", there.samples->values()}};
  }
}

/// Contacts that were loaded at the first sample.
void state_load(const identify::RecordValues& of_record, Json& scenario) {
  const double travel = of_record[RecordParameter::travel];
  if (travel != 0.0) scenario["initial"]["travel"] = travel;
}

void ask_for_motion(const identify::Fit& fit, const identify::Experiment& experiment, std::size_t index,
                    Json& scenario) {
  const identify::RecordValues& of_record = fit.of_records[index];
  const std::vector<double>& t = experiment.signals.front().at;
  const double rate = static_cast<double>(t.size() - 1) / (t.back() - t.front());
  if (scenario.contains("excitation") && !experiment.drive)
    begin_at(fit.rig.known.excitation, t.front(), t.back() - t.front(), scenario["excitation"]);
  scenario["initial"] = {{"position", of_record[RecordParameter::position]},
                         {"velocity", of_record[RecordParameter::velocity]}};
  state_load(of_record, scenario);
  scenario["analysis"] = {{"type", "simulate"}, {"duration", t.back() - t.front()}, {"sample_rate", rate}};
}

/// Constants that the fit lacked are left out.
Json system_json(const identify::Rig& rig) {
  const sim::Oscillator& o = rig.known.oscillator;
  Json system = Json::object();
  if (o.coordinate == core::Coordinate::angle) system["coordinate"] = core::name_of(o.coordinate);
  for (const auto& [key, value] : {std::pair{"mass", o.mass}, {"stiffness", o.stiffness}, {"damping", o.damping}})
    if (!std::isnan(value)) system[key] = value;
  for (const auto& [key, value] : {std::pair{"cubic_stiffness", o.cubic_stiffness},
                                   {"gravity_stiffness", o.gravity_stiffness},
                                   {"loss_factor", o.loss_factor}})
    if (value != 0.0) system[key] = value;
  system["damper_to"] = o.damper_to == sim::DamperTo::base ? "base" : "ground";
  Json laws = Json::array();
  for (const identify::RigLaw& law : rig.laws) {
    Json section = {{"law", law.entry->name}};
    section.update(law_json(law.entry->parameters, law.values));
    laws.push_back(std::move(section));
  }
  if (laws.size() == 1)
    system["friction"] = std::move(laws.front());
  else if (!laws.empty())
    system["friction"] = std::move(laws);
  return system;
}

/// Title, system and drive, with the fitted numbers.
Json rig_json(const identify::Fit& fit, const RigText& text, const sim::Excitation& drive) {
  Json rig = {{"schema", schema_name}, {"title", text.title}, {"system", system_json(fit.rig)}};
  if (!text.excitation.is_object()) return rig;
  Json& excitation = rig["excitation"] = text.excitation;
  excitation.erase("frequency_uncertainty");
  if (drive.is_harmonic()) excitation["phase"] = drive.phase;
  if (drive.type == sim::ExcitationType::force_harmonic) excitation["offset"] = drive.offset;
  return rig;
}

/// A motion needs mass and spring. True if the rig lacks one of them.
bool fill_in_constants(Json& system) {
  const auto lacks = [&](const char* key) { return system.value(key, 0.0) == 0.0; };
  const bool is_friction_alone = lacks("mass") || lacks("stiffness");
  for (const char* key : {"mass", "stiffness"})
    if (lacks(key)) system[key] = 1.0;
  if (!system.contains("damping")) system["damping"] = 0.0;
  return is_friction_alone;
}

/// Whether the drive of a scenario is a file, or the samples of a record.
bool is_recorded(const identify::Experiment& experiment, const RigText& text) {
  if (experiment.kind != ExperimentKind::history) return false;
  if (experiment.drive) return experiment.drive->samples != nullptr;
  return text.excitation.is_object() && samples_of(text.excitation.value("type", "")) == SamplesIn::data_file;
}

/// Name of the table with the drive of an experiment.
std::string drive_name(std::size_t experiments, std::size_t index) {
  return "drive" + (experiments == 1 ? "" : "_" + std::to_string(index));
}

/// The samples of a drive. Their times begin at 0, as those of the scenario.
Table drive_table(const std::string& name, const sim::Excitation& drive, core::Coordinate coordinate) {
  const bool of_base = drive.moves_base();
  return {name,
          {{.name = "t", .unit = "s", .numbers = drive.samples->times()},
           {.name = of_base ? "y" : "force",
            .unit = core::unit_for(coordinate, of_base ? "m" : "N"),
            .numbers = drive.samples->values()}},
          true};
}

Json section_of(const std::string& file, const sim::Excitation& drive) {
  const bool is_cubic = drive.samples->interpolation() == sim::Interpolation::cubic;
  return {{"type", drive.moves_base() ? "measured_base" : "measured_force"},
          {"file", file},
          {"interpolation", is_cubic ? "cubic" : "linear"},
          {"repeat", drive.samples->repeats()}};
}

}  // namespace

std::string rig_text(const identify::Fit& fit, const RigText& text) {
  return yaml(rig_json(fit, text, fit.rig.known.excitation));
}

std::string scenario_text(const identify::Fit& fit, const identify::Experiments& experiments, std::size_t index,
                          const RigText& text) {
  const identify::Experiment& experiment = *experiments[index];
  Json scenario = rig_json(fit, text, drive_of(experiment, fit.rig));
  const bool is_friction_alone = fill_in_constants(scenario["system"]);
  const identify::RecordValues& of_record = fit.of_records[index];
  std::string remark;
  if (is_recorded(experiment, text) && !scenario["excitation"].contains("times") &&
      !scenario["excitation"].contains("file")) {
    const std::string file = drive_name(experiments.size(), index) + ".csv";
    scenario["excitation"]["file"] = file;
    remark =
        "# The drive has too many samples for a list: give the fit a directory (out), and run this text beside " +
        file + " there.\n";
  }
  switch (experiment.kind) {
    case ExperimentKind::steady_states:
      ask_for_states(experiment, scenario);
      break;
    case ExperimentKind::decay:
      scenario.erase("excitation");
      scenario["initial"] = {{"position", of_record[RecordParameter::position]}, {"velocity", 0.0}};
      state_load(of_record, scenario);
      scenario["analysis"] = {{"type", "free_decay"}, {"peaks", experiment.signals.front().measured.size()}};
      break;
    case ExperimentKind::history:
      ask_for_motion(fit, experiment, index, scenario);
      break;
    case ExperimentKind::loop:
      scenario.erase("excitation");
      scenario["initial"] = {{"position", 1.0}, {"velocity", 0.0}};
      scenario["analysis"] = {{"type", "free_decay"}, {"peaks", 10}};
      break;
  }
  if (const std::string difference = difference_from(experiment); !difference.empty())
    remark += "# Of the fitted states: " + difference + ".\n";
  return remark +
         (is_friction_alone
              ? "# A loop shows the friction alone: replace mass, stiffness and initial by those of your rig.\n"
              : "") +
         yaml(scenario);
}

void add_scenario_files(const identify::Fit& fit, const identify::Experiments& experiments,
                        const std::vector<RigText>& texts, Answer& answer) {
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const std::string number = experiments.size() == 1 ? "" : "_" + std::to_string(e);
    RigText text = texts[e];
    if (is_recorded(*experiments[e], text)) {
      const sim::Excitation& drive = drive_of(*experiments[e], fit.rig);
      const std::string name = drive_name(experiments.size(), e);
      answer.tables.push_back(drive_table(name, drive, fit.rig.known.oscillator.coordinate));
      text.excitation = section_of(name + ".csv", drive);
    }
    const std::string file = "fitted" + number + ".yaml";
    answer.files.push_back({file, scenario_text(fit, experiments, e, text)});
    if (experiments[e]->kind == ExperimentKind::steady_states && States(*experiments[e]).are_scattered())
      answer.warnings.push_back(file +
                                " does not give the whole fitted curve: " + difference_from(*experiments[e]));
  }
}

}  // namespace dualdamp::scenarios
