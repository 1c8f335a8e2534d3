#include "cli/command_line/option_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "scenarios/format/limits.hpp"

namespace dualdamp::cli {

namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

/// In double quotes, where a control character has an escape.
std::string in_double_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (is_control(c))
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result + "\"";
}

}  // namespace

std::string in_quotes(const std::string& text) {
  if (std::ranges::any_of(text, is_control)) return in_double_quotes(text);
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

std::string option_of_setting(core::Setting setting, std::string_view name, std::string_view value) {
  const std::string key(name);
  const std::string text(value);
  const auto quoted = [](const std::string& word) {
    const bool needs_quotes = word.find_first_of(" {}[]()$*") != std::string::npos && !word.starts_with('\'');
    return needs_quotes ? "'" + word + "'" : word;
  };
  const std::string pair = key + "=" + quoted(text);
  switch (setting) {
    case core::Setting::unit:
      return "--unit " + pair;
    case core::Setting::column:
      return "--column " + pair;
    case core::Setting::scale:
      return "--scale " + pair;
    case core::Setting::decimal:
      return "--decimal " + text;
    case core::Setting::no_header:
      return "--no-header";
    case core::Setting::sample_rate:
      return "--sample-rate " + quoted(text);
    case core::Setting::drive:
      return "--drive " + key;
    case core::Setting::loop:
      return "--loop";
    case core::Setting::frequency:
      return "--frequency";
    case core::Setting::value:
      return "--set " + pair;
    case core::Setting::plugin:
      return "with --plugin LIB";
    case core::Setting::noise:
      return key == "x" || key == "Y" ? "--sigma-" + key + " " + text : "";
  }
  return {};
}

std::string option_of_fit(core::Setting setting, std::string_view name, std::string_view value) {
  if (setting != core::Setting::noise) return option_of_setting(setting, name, value);
  constexpr std::array<std::string_view, 5> signals = {"x", "v", "a", "force", "phase"};
  if (std::ranges::find(signals, name) == signals.end()) return {};
  return "--sigma " + std::string(name) + "=" + std::string(value);
}

std::string key_or_option_of_setting(core::Setting setting, std::string_view name, std::string_view value) {
  return setting == core::Setting::plugin ? option_of_setting(setting, name, value)
                                          : core::key_of_setting(setting, name, value);
}

std::pair<std::string, std::string> split_at_equals(const std::string& text) {
  const std::size_t sign = std::min(text.find('='), text.size());
  return {text.substr(0, sign), sign < text.size() ? text.substr(sign + 1) : std::string()};
}

void set_keys(std::initializer_list<KeyOption> options, scenarios::LoadOptions& load) {
  for (const KeyOption& one : options)
    if (!one.text.empty()) load.set.push_back({std::string(one.key) + "=" + one.text, one.option});
}

scenarios::Scenario scenario_about(const std::string& about, const std::string& analysis,
                                   const scenarios::LoadOptions& options) {
  const std::string text =
      "schema: " + std::string(scenarios::schema_name) + "\nsystem: {}\nanalysis: {type: " + analysis + "}\n";
  scenarios::Scenario scenario = scenarios::parse_scenario(text, "command line", options);
  scenario.file = about;
  return scenario;
}

std::array<MapOption, 3> map_options(const FileOptions& file) {
  return {{{"units", file.column_units, "--unit"},
           {"columns", file.columns, "--column"},
           {"scale", file.scales, "--scale"}}};
}

}  // namespace dualdamp::cli
