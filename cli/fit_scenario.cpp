#include "cli/fit_scenario.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/command_line/option_text.hpp"
#include "core/diagnostics.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/json_text.hpp"
#include "scenarios/format/tree.hpp"
#include "scenarios/results/files.hpp"
#include "scenarios/results/prediction_keys.hpp"

namespace dualdamp::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Options such as `x=mm` as a YAML map.
std::string map_of(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& item : list) {
    const auto [name, value] = split_at_equals(item);
    text += (text.empty() ? "" : ", ") + name + ": " + in_quotes(value);
  }
  return "{" + text + "}";
}

/// The data files with the statements of the options about them.
std::string data_of(const std::vector<std::string>& files, const RecordOptions& command) {
  std::string list;
  for (const std::string& file : files) {
    std::string item = "file: " + in_quotes(file);
    for (const MapOption& map : map_options(command))
      if (!map.entries.empty()) item += std::string(", ") + map.key + ": " + map_of(map.entries);
    if (!command.decimal.empty()) item += ", decimal: " + in_quotes(command.decimal);
    if (command.no_header) item += ", no_header: true";
    if (!command.sample_rate.empty()) item += ", sample_rate: " + in_quotes(command.sample_rate);
    if (command.loop) item += ", loop: true";
    if (!command.drive.empty()) item += ", drive: " + command.drive;
    for (const std::string& sigma : command.sigmas) {
      const auto [name, value] = split_at_equals(sigma);
      item += ", sigma_" + name + ": " + value;
    }
    list += (list.empty() ? "{" : ", {") + item + "}";
  }
  return "[" + list + "]";
}

/// Whether --set states a part of the drive.
bool sets_drive(const RecordOptions& command) {
  return std::ranges::any_of(command.set, [](const std::string& one) { return one.starts_with("excitation"); });
}

/// `replaces`: the scenario has a drive of another type, whose keys do not apply.
void add_drive(const RecordOptions& command, bool replaces, scenarios::LoadOptions& options) {
  const auto say = [&](const std::string& assignment, const char* option) {
    options.set.push_back({"excitation" + assignment, option});
  };
  if (replaces && !command.frequency.empty()) {
    const std::string amplitude = command.amplitude.empty() ? "" : ", amplitude: " + in_quotes(command.amplitude);
    say("={type: base_harmonic, frequency: " + in_quotes(command.frequency) + amplitude + "}", "--frequency");
  } else {
    // An amplitude alone is one of the base too: the reader then asks for the frequency.
    const bool is_amplitude_alone = !replaces && !command.amplitude.empty() && !sets_drive(command);
    if (!command.frequency.empty() || is_amplitude_alone)
      say(".type=base_harmonic", command.frequency.empty() ? "--amplitude" : "--frequency");
    if (!command.frequency.empty()) say(".frequency=" + command.frequency, "--frequency");
    if (!command.amplitude.empty()) say(".amplitude=" + command.amplitude, "--amplitude");
  }
}

void add_settings(const std::vector<std::string>& settings, scenarios::LoadOptions& options) {
  for (const std::string& assignment : settings) options.set.push_back({assignment, "--set"});
}

/// Takes `--set LAW.NAME=VALUE` for one of the laws out of the settings. Of several laws, those of the friction
/// without a law too: `analysis.stated` finds the law that has such a parameter.
void add_stated(const std::string& laws, std::vector<std::string>& settings, scenarios::LoadOptions& options) {
  const bool are_several = laws.find(',') != std::string::npos;
  const std::string friction = "system.friction.";
  std::string stated;
  std::erase_if(settings, [&](std::string& setting) {
    const std::string law = setting.substr(0, setting.find('.'));
    const bool names_law = ("," + laws + ",").find("," + law + ",") != std::string::npos;
    if (names_law && !are_several) setting = friction + setting.substr(law.size() + 1);
    if (!are_several || !(names_law || setting.starts_with(friction))) return false;
    const auto [name, value] = split_at_equals(names_law ? setting : setting.substr(friction.size()));
    stated += (stated.empty() ? "" : ", ") + ("{name: " + in_quotes(name)) + ", value: " + in_quotes(value) + "}";
    return true;
  });
  if (!stated.empty()) options.set.push_back({"analysis.stated=[" + stated + "]", "--set"});
}

/// Reads result.json of a fit.
Json fitted_document(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;  // if the file cannot be examined, reading it gives the reason
  const fs::path file = fs::is_directory(path, error) ? fs::path(path) / "result.json" : fs::path(path);
  constexpr std::size_t largest = std::size_t{1} << 26U;
  Json document = scenarios::parse_json(scenarios::read_file(file.string(), largest));
  if (!document.is_object() || document.value("analysis", Json()) != "fit" || !document.contains("result"))
    core::refuse({.file = file.string()}, "this is not the result of a fit");
  if (!document.at("result").is_object()) core::refuse({.file = file.string()}, "the fit has no result");
  return document;
}

/// The override "analysis={...}" of a prediction with this fit.
std::string prediction_of(const Json& result, const PredictCommand& command) {
  const std::string keys = scenarios::prediction_keys(result).dump();
  const bool states_drive = !command.frequency.empty() || !command.amplitude.empty() || sets_drive(command);
  return keys.substr(0, keys.size() - 1) + ", data: " + data_of(command.data, command) +
         (states_drive ? "}" : ", drive_of_fit: true}");
}

/// Whether the base of the fitted rig moves harmonically.
bool has_harmonic_base(const std::string& rig, const std::string& name) {
  const scenarios::Document document(name, rig);
  const scenarios::Entry* section = document.root().find("excitation");
  const scenarios::Entry* type = section == nullptr ? nullptr : section->value.find("type");
  return type != nullptr && scenarios::excitation_type(type->value.text) == sim::ExcitationType::base_harmonic;
}

}  // namespace

scenarios::Scenario scenario_of(const FitCommand& command) {
  scenarios::LoadOptions options;
  options.data_anywhere = true;
  options.words = option_of_fit;
  options.set = {{"analysis.data=" + data_of(command.data, command), "DATA"}};
  if (command.law.find(',') == std::string::npos)
    options.set.push_back({"system.friction.law=" + command.law, "LAW"});
  else
    options.set.push_back({"analysis.laws=[" + command.law + "]", "LAW"});
  set_keys({{"system.mass", command.mass, "--mass"},
            {"system.stiffness", command.stiffness, "--stiffness"},
            {"system.damping", command.damping, "--damping"}},
           options);
  if (!command.free.empty()) options.set.push_back({"analysis.free=" + in_quotes(command.free), "--free"});
  if (!command.validate.empty())
    options.set.push_back({"analysis.validate=" + data_of(command.validate, command), "--validate"});
  if (command.starts > 0) options.set.push_back({"analysis.starts=" + std::to_string(command.starts), "--starts"});
  if (command.robust) options.set.push_back({"analysis.robust=true", "--robust"});
  if (command.no_profile) options.set.push_back({"analysis.profile=false", "--no-profile"});
  add_drive(command, false, options);
  std::vector<std::string> settings = command.set;
  add_stated(command.law, settings, options);
  add_settings(settings, options);
  return scenario_about(command.data.front(), "fit", options);
}

namespace {

scenarios::Scenario prediction_by(const Json& document, const PredictCommand& command) {
  const Json& result = document.at("result");
  scenarios::LoadOptions options;
  options.data_anywhere = true;
  options.words = option_of_fit;
  options.set = {{"analysis=" + prediction_of(result, command), "DATA"}};
  const auto rig = result.at("rig").get<std::string>();
  add_drive(command, !has_harmonic_base(rig, command.result), options);
  add_settings(command.set, options);
  scenarios::Scenario prediction = scenarios::parse_scenario(rig, command.result, options);
  prediction.file = command.data.front();
  return prediction;
}

}  // namespace

scenarios::Scenario scenario_of(const PredictCommand& command) {
  const Json document = fitted_document(command.result);
  try {
    return prediction_by(document, command);
  } catch (const Json::exception&) {
    core::refuse({.file = command.result}, "the result of the fit is damaged");
  }
}

}  // namespace dualdamp::cli
