#include "core/setting.hpp"

namespace dualdamp::core {

std::string key_of_setting(Setting setting, std::string_view name, std::string_view value) {
  const std::string key(name);
  const std::string text(value);
  const std::string pair = "{" + key + ": " + text + "}";
  switch (setting) {
    case Setting::unit:
      return "units: " + pair;
    case Setting::column:
      return "columns: " + pair;
    case Setting::scale:
      return "scale: " + pair;
    case Setting::decimal:
      return "decimal: '" + text + "'";
    case Setting::no_header:
      return "no_header: true";
    case Setting::sample_rate:
      return "sample_rate: " + text;
    case Setting::drive:
      return "'drive: " + key + "' beside 'file'";
    case Setting::loop:
      return "'loop: true' beside 'file'";
    case Setting::frequency:
      return "excitation: {type: base_harmonic, frequency: ...}";
    case Setting::value:
      return key + ": " + text;
    case Setting::plugin:
      return "once it is loaded";
    case Setting::noise:  // of the others not every analysis has a key
      return key == "x" ? "sigma_x: " + text : "";
  }
  return {};
}

}  // namespace dualdamp::core
