#include "cli/identify_scenario.hpp"

#include <string>
#include <vector>

#include "cli/command_line/option_text.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

namespace {

/// Sets what options state of the data file.
void set_file_keys(const FileOptions& command, scenarios::LoadOptions& options) {
  if (!command.decimal.empty())
    options.set.push_back({"analysis.decimal=" + in_quotes(command.decimal), "--decimal"});
  if (command.no_header) options.set.push_back({"analysis.no_header=true", "--no-header"});
  set_keys({{"analysis.sample_rate", command.sample_rate, "--sample-rate"}}, options);
  for (const MapOption& map : map_options(command))
    for (const std::string& entry : map.entries) {
      const auto [name, value] = split_at_equals(entry);
      options.set.push_back({std::string("analysis.") + map.key + "." + name + "=" + in_quotes(value), map.option});
    }
}

/// Sets what `identify` and `next` state of a data file and its rig.
void set_measured_keys(const MeasuredOptions& command, scenarios::LoadOptions& options) {
  set_keys({{"system.mass", command.mass, "--mass"},
            {"system.stiffness", command.stiffness, "--stiffness"},
            {"excitation.frequency", command.frequency, "--frequency"},
            {"analysis.sigma_x", command.sigma_x, "--sigma-x"},
            {"analysis.sigma_Y", command.sigma_Y, "--sigma-Y"}},
           options);
  for (const std::string& gain : command.gain_uncertainties)
    options.set.push_back({"analysis.gain_uncertainty." + gain, "--gain-uncertainty"});
  set_file_keys(command, options);
}

/// A scenario about a data file and its rig.
scenarios::LoadOptions about_data(const MeasuredOptions& command) {
  scenarios::LoadOptions options;
  options.data_anywhere = true;
  options.words = option_of_setting;
  options.set = {{"analysis.data=" + in_quotes(command.data), "DATA"}};
  if (!command.frequency.empty()) options.set.push_back({"excitation.type=base_harmonic", "--frequency"});
  set_measured_keys(command, options);
  return options;
}

bool is_scenario(const std::string& file) { return file.ends_with(".yaml") || file.ends_with(".yml"); }

}  // namespace

scenarios::Scenario scenario_of(const IdentifyCommand& command) {
  scenarios::LoadOptions options = about_data(command);
  set_keys({{"system.gravity_stiffness", command.gravity_stiffness, "--gravity-stiffness"},
            {"system.coordinate", command.coordinate, "--coordinate"}},
           options);
  if (command.robust) options.set.push_back({"analysis.robust=true", "--robust"});
  if (!command.methods.empty()) {
    std::vector<std::string> names;
    for (const std::string& name : command.methods) names.push_back(in_quotes(name));
    options.set.push_back({"analysis.methods=[" + core::joined(names) + "]", "--method"});
  }
  return scenario_about(command.data, "identify", options);
}

scenarios::Scenario scenario_of(const NextCommand& command) {
  const auto set_limits = [&](scenarios::LoadOptions& options) {
    set_keys({{"analysis.most_level", command.most_level, "--most-level"},
              {"analysis.most_frequency", command.most_frequency, "--most-frequency"}},
             options);
  };
  scenarios::LoadOptions options;
  if (!is_scenario(command.data)) {
    options = about_data(command);
    set_limits(options);
    return scenario_about(command.data, "design", options);
  }
  options.words = key_or_option_of_setting;
  options.instead = "design";
  set_measured_keys(command, options);
  set_limits(options);
  return scenarios::load_scenario(command.data, options);
}

}  // namespace dualdamp::cli
