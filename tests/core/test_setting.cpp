#include "core/setting.hpp"

#include <catch2/catch.hpp>

using namespace dualdamp::core;

TEST_CASE("Messages name a setting by the keys of a scenario, or in the words of whoever asks") {
  const SettingWords keys;
  CHECK(keys(Setting::unit, "x", "mm") == "units: {x: mm}");
  CHECK(keys(Setting::column, "x", "'data(:,2)'") == "columns: {x: 'data(:,2)'}");
  CHECK(keys(Setting::decimal, {}, ",") == "decimal: ','");
  CHECK(keys(Setting::no_header) == "no_header: true");
  CHECK(keys(Setting::sample_rate, {}, "500 Hz") == "sample_rate: 500 Hz");
  CHECK(keys(Setting::noise, "x", "2 um") == "sigma_x: 2 um");
  CHECK(keys(Setting::value, "system.mass", "2 kg") == "system.mass: 2 kg");
  const SettingWords others(+[](Setting, std::string_view name, std::string_view value) {
    return std::string(name) + " := " + std::string(value);
  });
  CHECK(others(Setting::unit, "x", "mm") == "x := mm");
}
