#pragma once
/// Texts of options: NAME=VALUE, and texts that become keys and values of a scenario.

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command_line/arguments.hpp"
#include "core/setting.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::cli {

/// The text as a quoted YAML string: control characters, which a scenario refuses, as escapes.
[[nodiscard]] std::string in_quotes(const std::string& text);

/// `--unit x=mm`: the words of commands that take data files.
[[nodiscard]] std::string option_of_setting(core::Setting setting, std::string_view name, std::string_view value);

/// The words of `fit` and `predict`, which state the noise of any signal in one option.
[[nodiscard]] std::string option_of_fit(core::Setting setting, std::string_view name, std::string_view value);

/// The words of commands that take scenarios: the keys of their files, and what only an option states.
[[nodiscard]] std::string key_or_option_of_setting(core::Setting setting, std::string_view name,
                                                   std::string_view value);

/// Name and value of NAME=VALUE; the value is empty where there is no sign.
[[nodiscard]] std::pair<std::string, std::string> split_at_equals(const std::string& text);

/// An option that states one key. An empty text: the option is not given.
struct KeyOption {
  const char* key;
  const std::string& text;
  const char* option;
};

/// Sets the keys of those options that are given.
void set_keys(std::initializer_list<KeyOption> options, scenarios::LoadOptions& load);

/// A scenario whose keys are all stated by options. `about`: the file that it is named after.
/// Errors: `core::InputError`.
[[nodiscard]] scenarios::Scenario scenario_about(const std::string& about, const std::string& analysis,
                                                 const scenarios::LoadOptions& options);

/// An option such as `--unit x=mm`, which states one entry of a map each time that it is given.
struct MapOption {
  const char* key;
  const std::vector<std::string>& entries;
  const char* option;
};

/// Those of a data file.
[[nodiscard]] std::array<MapOption, 3> map_options(const FileOptions& file);

}  // namespace dualdamp::cli
