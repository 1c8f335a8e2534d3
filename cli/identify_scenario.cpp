#include "cli/identify_scenario.hpp"

#include <string>
#include <tuple>

#include "cli/option_text.hpp"

namespace dualdamp::cli {

namespace {

/// Adds options such as `--unit x=mm` as a YAML map.
void add_maps(const FileOptions& command, scenarios::LoadOptions& options) {
  for (const auto& [option, key, list] : {std::tuple{"--unit", "units", &command.units},
                                          {"--column", "columns", &command.columns},
                                          {"--scale", "scale", &command.scales}})
    for (const std::string& text : *list) {
      const auto [name, value] = split_at_equals(text);
      options.set.push_back({std::string("analysis.") + key + "." + name + "=" + in_quotes(value), option});
    }
}

/// Adds the options about the data file.
void add_file_options(const FileOptions& command, scenarios::LoadOptions& options) {
  if (!command.decimal.empty())
    options.set.push_back({"analysis.decimal=" + in_quotes(command.decimal), "--decimal"});
  if (command.no_header) options.set.push_back({"analysis.no_header=true", "--no-header"});
  add_maps(command, options);
}

void add_gains(const std::vector<std::string>& gains, scenarios::LoadOptions& options) {
  for (const std::string& text : gains)
    options.set.push_back({"analysis.gain_uncertainty." + text, "--gain-uncertainty"});
}

bool is_scenario(const std::string& file) { return file.ends_with(".yaml") || file.ends_with(".yml"); }

}  // namespace

scenarios::Scenario scenario_of(const IdentifyCommand& command) {
  scenarios::LoadOptions options;
  options.data_anywhere = true;
  options.words = option_of_setting;
  options.set = {{"analysis.data=" + in_quotes(command.data), "DATA"}};
  if (!command.frequency.empty()) options.set.push_back({"excitation.type=base_harmonic", "--frequency"});
  for (const auto& [path, value, option] :
       {std::tuple{"system.mass", &command.mass, "--mass"},
        {"system.stiffness", &command.stiffness, "--stiffness"},
        {"system.gravity_stiffness", &command.gravity_stiffness, "--gravity-stiffness"},
        {"system.coordinate", &command.coordinate, "--coordinate"},
        {"excitation.frequency", &command.frequency, "--frequency"},
        {"analysis.sigma_x", &command.sigma_x, "--sigma-x"},
        {"analysis.sigma_Y", &command.sigma_Y, "--sigma-Y"}})
    if (!value->empty()) options.set.push_back({std::string(path) + "=" + *value, option});
  if (command.robust) options.set.push_back({"analysis.robust=true", "--robust"});
  add_gains(command.gain_uncertainties, options);
  add_file_options(command, options);
  if (!command.methods.empty()) {
    std::string names;
    for (const std::string& name : command.methods) names += (names.empty() ? "" : ", ") + in_quotes(name);
    options.set.push_back({"analysis.methods=[" + names + "]", "--method"});
  }
  scenarios::Scenario scenario = scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {}\nanalysis: {type: identify}\n", "command line", options);
  scenario.file = command.data;
  return scenario;
}

scenarios::Scenario scenario_of(const NextCommand& command) {
  scenarios::LoadOptions options;
  const bool from_scenario = is_scenario(command.data);
  options.data_anywhere = !from_scenario;
  options.words = from_scenario ? key_or_option_of_setting : option_of_setting;
  if (from_scenario) options.instead = "design";
  if (!from_scenario) options.set.push_back({"analysis.data=" + in_quotes(command.data), "DATA"});
  if (!from_scenario && !command.frequency.empty())
    options.set.push_back({"excitation.type=base_harmonic", "--frequency"});
  for (const auto& [path, value, option] : {std::tuple{"system.mass", &command.mass, "--mass"},
                                            {"system.stiffness", &command.stiffness, "--stiffness"},
                                            {"excitation.frequency", &command.frequency, "--frequency"},
                                            {"analysis.sigma_x", &command.sigma_x, "--sigma-x"},
                                            {"analysis.sigma_Y", &command.sigma_Y, "--sigma-Y"}})
    if (!value->empty()) options.set.push_back({std::string(path) + "=" + *value, option});
  add_gains(command.gain_uncertainties, options);
  add_file_options(command, options);
  if (from_scenario) return scenarios::load_scenario(command.data, options);
  scenarios::Scenario scenario = scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {}\nanalysis: {type: design}\n", "command line", options);
  scenario.file = command.data;
  return scenario;
}

}  // namespace dualdamp::cli
