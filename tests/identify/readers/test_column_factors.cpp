#include "identify/readers/column_factors.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "identify/readers/record_reader.hpp"
#include "tests/identify/readers/data_files.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify::testing;
using identify::parse_record;
using identify::ReadOptions;

TEST_CASE("A scale with an uncertainty is refused with one without it") {
  const auto refused = [](const std::string& scale) {
    return refusal([&] {
      (void)parse_record("t [s],x [V]\n0,1\n1,-2\n2,3\n",
                         ReadOptions{.scales = {{"x", scale}}, .name = "data.csv"});
    });
  };
  for (const char* scale : {"2.5 mm/V \xc2\xb1 1 %", "2.5 mm/V +- 0.1 mm/V", "(2.5 +- 0.1) mm/V"}) {
    const std::string said = refused(scale);
    CHECK(mentions(said, "the scale of column x states an uncertainty, which only 'identify' uses"));
    CHECK(mentions(said, "allowed: '2.5 mm/V'"));
  }
  CHECK(mentions(refused("+-2 mm/V"), "states an uncertainty"));
}

TEST_CASE("A scale in the column's own unit is refused with one that does") {
  const auto refused = [](const std::string& heading, const std::string& scale) {
    const std::string text = "Y [mm],x [mm],f [Hz]," + heading + "\n1,2,5,90\n2,3,6,80\n";
    return refusal(
        [&] { (void)parse_record(text, ReadOptions{.scales = {{"phase", scale}}, .name = "data.csv"}); });
  };
  const std::string said = refused("phase [deg]", "-1 deg");
  CHECK(mentions(said,
                 "the scale of column phase is for numbers without a unit, and those of the column are in deg"));
  CHECK(mentions(said, "allowed: '-1', which leaves the numbers in deg"));
  CHECK(refused("phase [deg]", "-1") == "accepted");
  CHECK(mentions(refused("phase [V]", "-1 deg"), "allowed: such as '-1 rad/V'"));
  CHECK(refused("phase [V]", "-1 rad/V") == "accepted");
  CHECK(mentions(refused("phase [V]", "-1 deg/mA"), "is for numbers in mA, and those of the column are in V"));
}

TEST_CASE("A mass as the scale of a force makes forces of accelerations") {
  const auto first_force = [](const std::string& heading, const std::string& scale, core::Coordinate coordinate) {
    const std::string x = coordinate == core::Coordinate::angle ? "x [rad]" : "x [m]";
    std::string text = "t [s],table [" + heading + "]," + x + "\n";
    for (int i = 0; i < 40; ++i)
      text += std::to_string(i) + (i % 2 == 0 ? ",2," : ",1,") + std::to_string(std::sin(0.3 * i)) + "\n";
    const auto file = parse_record(text, ReadOptions{.columns = {{"force", "table"}},
                                                     .scales = {{"force", scale}},
                                                     .coordinate = coordinate,
                                                     .name = "data.csv"});
    return file.record.histories.front().force.front();
  };
  CHECK(first_force("g", "-2.4 kg", core::Coordinate::displacement) == Approx(-2.4 * 2 * 9.80665));
  CHECK(first_force("mm/s2", "500 g", core::Coordinate::displacement) == Approx(0.5 * 2e-3));
  CHECK(first_force("deg/s2", "-3 kg.m2", core::Coordinate::angle) == Approx(-6 * std::numbers::pi / 180));
  CHECK(mentions(refusal([&] { (void)first_force("mm", "-2.4 kg", core::Coordinate::displacement); }),
                 "the scale of column force is for numbers in m/s^2, and those of the column are in mm"));
}

TEST_CASE("An acceleration in the place of the base's displacement is told what it is good for") {
  const auto refused = [](const char* unit) {
    return refusal([&] {
      (void)parse_record(std::string("t [s],x [mm],y [") + unit + "]\n0,1,2\n1,2,3\n2,1,4\n",
                         ReadOptions{.name = "data.csv"});
    });
  };
  CHECK(mentions(refused("g"), "its acceleration is the column 'force' with the scale -m"));
  CHECK_FALSE(mentions(refused("V"), "acceleration"));
}

TEST_CASE("An empty unit, scale or name of a column is refused") {
  const std::string text = "t [s],x [mm]\n0,1\n1,-2\n2,3\n";
  for (const char* blank : {"", " "}) {
    const auto refused = [&](ReadOptions options) {
      options.name = "data.csv";
      return refusal([&] { (void)parse_record(text, options); });
    };
    CHECK(mentions(refused({.units = {{"x", blank}}}), "the unit that is stated for column x is empty"));
    CHECK(mentions(refused({.columns = {{"x", blank}}}), "the column that is stated for column x is empty"));
    CHECK(mentions(refused({.scales = {{"x", blank}}}), "the scale that is stated for column x is empty"));
  }
}

TEST_CASE("What is stated about the text of a CSV file is refused for other files") {
  const std::string universal = uff58({.label = "x", .unit = "mm", .values = ramp(20)});
  const auto refused = [&](ReadOptions options) {
    options.name = "data.uff";
    return refusal([&] { (void)parse_record(universal, options); });
  };
  CHECK(refused({}) == "accepted");
  CHECK(mentions(refused({.decimal = ','}), "is stated, and the file is a universal file"));
  CHECK(mentions(refused({.no_header = true}), "is stated, and the file is a universal file"));
  const TemporaryFile file("statements.mat", mat4("dt", {0.01}) + mat4("x", ramp(20)));
  CHECK(mentions(refusal([&] { (void)identify::read_record(file.path(), {.decimal = ','}); }),
                 "is stated, and the file is a MATLAB file"));
}
