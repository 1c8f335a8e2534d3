#pragma once
/// What a user may state, named in messages without the words of one way of asking. A message that advises a
/// setting says it in the words of whoever asks: keys of a scenario, or options of the command line.

#include <string>
#include <string_view>

namespace dualdamp::core {

/// The name and the value of a setting, where it has any, are behind it.
enum class Setting {
  unit,         ///< of a column of a data file; its unit
  column,       ///< of a record; its name or number in the data file
  scale,        ///< of a column; the factor of its numbers
  decimal,      ///< mark of a CSV file; the mark
  no_header,    ///< the first row of a CSV file holds numbers
  sample_rate,  ///< of a data file without times; the rate
  drive,        ///< column of a record that drives it
  loop,         ///< a record is a friction loop
  frequency,    ///< of the harmonic motion of the base
  value,        ///< path of any value of a scenario; the value
  plugin,       ///< library with laws
  noise,        ///< of a column; its standard deviation; empty where it is not stated
};

/// `units: {x: mm}`, `no_header: true`, ...: the keys of a scenario.
[[nodiscard]] std::string key_of_setting(Setting setting, std::string_view name, std::string_view value);

/// The words for settings of one way of asking.
class SettingWords {
 public:
  using Text = std::string (*)(Setting setting, std::string_view name, std::string_view value);

  explicit(false) constexpr SettingWords(Text text = key_of_setting) : text_(text) {}

  [[nodiscard]] std::string operator()(Setting setting, std::string_view name = {},
                                       std::string_view value = {}) const {
    return text_(setting, name, value);
  }

 private:
  Text text_;
};

}  // namespace dualdamp::core
