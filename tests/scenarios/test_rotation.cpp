// The coordinate is an angle: other units, the same numbers.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

#include "answers.hpp"
#include "files.hpp"
#include "scenarios/format/si_units.hpp"
#include "scenarios/results/shown_units.hpp"
#include "scenarios/scenario_format.hpp"
#include "tests/support/problems.hpp"

using namespace dualdamp;

namespace {

scenarios::Scenario scenario_from(const std::string& body) {
  return scenarios::parse_scenario("schema: dualdamp/1\n" + body, "test.yaml");
}

std::vector<core::Diagnostic> problems_of_body(const std::string& body) {
  return test::problems_of([&] { return scenario_from(body); });
}

const std::string system_of_angle =
    "system: {mass: 1 kg.m^2, stiffness: 100 N.m/rad, damping: 4 N.m.s/rad, friction: {law: coulomb, kinetic: 2 "
    "N.m}}\n";
const std::string turning_base = "excitation: {type: base_harmonic, amplitude: 0.1 rad, frequency: 10 rad/s}\n";

const scenarios::Table& table_of(const scenarios::RunResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.tables, name, &scenarios::Table::name);
  REQUIRE(found != result.tables.end());
  return *found;
}

std::string unit_of(const scenarios::Table& table, const std::string& column) {
  return std::ranges::find(table.columns, column, &scenarios::Column::name)->unit;
}

}  // namespace

TEST_CASE("rotation: the numbers are those of the twin in translation, to the bit", "[scenarios][rotation]") {
  for (const char* analysis : {"{type: steady_state}", "{type: xy_curve, amplitudes: [0.05, 0.1, 0.2]}",
                               "{type: frequency_response, frequencies: [5 rad/s, 9 rad/s, 14 rad/s]}",
                               "{type: simulate, duration: 3 s, sample_rate: 100 Hz}"}) {
    CAPTURE(analysis);
    const auto twin = scenarios::run(testing::scenario_of(analysis));
    const auto turned =
        scenarios::run(scenario_from(system_of_angle + turning_base + "analysis: " + analysis + "\n"));
    CHECK(testing::result_of(turned) == testing::result_of(twin));
  }
}

TEST_CASE("rotation: the SI unit of each number is that of its key", "[scenarios][rotation]") {
  const auto units_of = [](const scenarios::Scenario& scenario) {
    return scenarios::si_units(scenarios::Json::parse(scenario.resolved),
                               scenarios::scenario_format(scenarios::analyses()));
  };
  const std::string moment = "excitation: {type: force_harmonic, amplitude: 9 N.m, frequency: 10 rad/s}\n";
  auto units = units_of(
      scenario_from(system_of_angle + moment + "analysis: {type: xy_curve, amplitudes: [8 N.m, 9 N.m]}\n"));
  CHECK(units["system.mass"] == "kg.m^2");
  CHECK(units["system.stiffness"] == "N.m/rad");
  CHECK(units["system.friction.kinetic"] == "N.m");
  CHECK(units["excitation.amplitude"] == "N.m");
  CHECK(units["excitation.phase"] == "rad");
  CHECK(units["analysis.amplitudes"] == "N.m");
  CHECK_FALSE(units.contains("excitation.frequency"));
  units = units_of(testing::scenario_of("{type: xy_curve, amplitudes: [0.1, 0.2]}"));
  CHECK(units["system.mass"] == "kg");
  CHECK(units["excitation.amplitude"] == "m");
  CHECK(units["analysis.amplitudes"] == "m");
}

TEST_CASE("rotation: degrees are read, results are in rad and N.m", "[scenarios][rotation]") {
  const auto scenario = scenario_from(system_of_angle +
                                      "excitation: {type: force_harmonic, amplitude: 9 N.m, frequency: 10 rad/s}\n"
                                      "initial: {position: 90 deg, velocity: -180 deg/s}\n"
                                      "analysis: {type: simulate, duration: 1 s, sample_rate: 10 Hz}\n");
  CHECK(scenario.model.initial.position == std::numbers::pi / 2.0);
  CHECK(scenario.model.initial.velocity == Approx(-std::numbers::pi).epsilon(1e-15));
  const auto result = scenarios::run(scenario);
  const scenarios::Table& history = table_of(result, "history");
  CHECK(unit_of(history, "x") == "rad");
  CHECK(unit_of(history, "v") == "rad/s");
  CHECK(unit_of(history, "a") == "rad/s^2");
  CHECK(unit_of(history, "friction") == "N.m");
  CHECK(unit_of(table_of(result, "events"), "v") == "rad/s");
  const auto document = testing::document_of(scenario, result);
  CHECK(document.at("units").at("final.v") == "rad/s");
  CHECK(document.at("units").at("energy.input") == "J");
  std::ostringstream csv;
  scenarios::write_csv(csv, history, result.provenance);
  CHECK(csv.str().find("\nt [s],x [rad],v [rad/s],a [rad/s^2],friction [N.m],force [N.m]\n") != std::string::npos);
}

TEST_CASE("rotation: a resolved scenario keeps its coordinate", "[scenarios][rotation]") {
  const auto scenario = scenario_from(system_of_angle + turning_base + "analysis: {type: steady_state}\n");
  const auto again = scenarios::parse_scenario(scenario.resolved, "resolved.yaml");
  CHECK(again.resolved == scenario.resolved);
  CHECK(again.model.oscillator.coordinate == core::Coordinate::angle);
  const auto plain = testing::scenario_of("{type: steady_state}");
  CHECK(plain.resolved.find("coordinate") == std::string::npos);
}

TEST_CASE("rotation: a unit of the other kind is refused where it stands", "[scenarios][rotation]") {
  const auto problems = problems_of_body(
      "system:\n  mass: 3 kg\n  stiffness: 12 N.m/rad\n  damping: 0.1 N.s/m\n"
      "initial: {position: 0.1 m}\nanalysis: {type: free_decay, peaks: 4}\n");
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].place.line == 4);
  CHECK(problems[0].message == "'system.stiffness': 'N.m/rad' is not a unit of a stiffness");
  CHECK(problems[0].allowed.find("the coordinate is a displacement: 'system.mass' in line 3 is 3 kg") !=
        std::string::npos);
  CHECK(problems[0].found == "12 N.m/rad");

  const auto stated = problems_of_body(
      "system: {coordinate: angle, mass: 0.3, stiffness: 12 N/m, damping: 0}\n"
      "initial: {position: 5 deg}\nanalysis: {type: free_decay, peaks: 4}\n");
  REQUIRE(stated.size() == 1);
  CHECK(stated[0].message == "'system.stiffness': 'N/m' is not a unit of a torsional stiffness");
  CHECK(stated[0].allowed.find("'system.coordinate' says so") != std::string::npos);
}

TEST_CASE("rotation: messages of laws and of ranges are in units of rotation", "[scenarios][rotation]") {
  const auto problems = problems_of_body(
      "system: {mass: 1 kg.m^2, stiffness: 0 N.m/rad, damping: 0, friction: {law: elasto_plastic, kinetic: 1 N.m, "
      "stribeck_velocity: 1 deg/s, sigma0: 100 N.m/rad, sigma1: 0, elastic_limit: 5 deg}}\nanalysis: {type: "
      "simulate, duration: 1 s}\n");
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].allowed == "> 0 N.m/rad");
  CHECK(problems[1].allowed == "> 0 rad and < 0.01 rad");
}

TEST_CASE("rotation: gravity's stiffness asks for a pendulum", "[scenarios][rotation]") {
  const std::string rest = "analysis: {type: simulate, duration: 1 s}\n";
  CHECK(problems_of_body("system: {mass: 1 kg, gravity_stiffness: 3 N.m, damping: 0}\n" + rest)[0].message.find(
            "the coordinate is no angle") != std::string::npos);
  CHECK(
      problems_of_body("system: {mass: 1 kg.m^2, gravity_stiffness: 3 N.m, damping: 0}\n" + turning_base + rest)[0]
          .message.find("does not work with a base in motion") != std::string::npos);
  CHECK(problems_of_body("system: {mass: 1 kg.m^2, gravity_stiffness: 3 N.m, stiffness: 2 N.m/rad, damping: 0}\n" +
                         rest)[0]
            .message.find("below its own part") != std::string::npos);
}

TEST_CASE("rotation: a pendulum keeps its energy and its elliptic period", "[scenarios][rotation]") {
  const auto result = testing::result_of(scenarios::run(scenario_from(
      "system: {mass: 0.05 kg.m^2, gravity_stiffness: 2.943 N.m, damping: 0}\ninitial: {position: 60 deg}\n"
      "analysis: {type: free_decay, peaks: 3}\n")));
  const double natural = 2.0 * std::numbers::pi * std::sqrt(0.05 / 2.943);
  const double period = natural * 2.0 / std::numbers::pi * std::comp_ellint_1(std::sin(std::numbers::pi / 6.0));
  CHECK(result.at("peaks").at(2).at("t").get<double>() == Approx(period).epsilon(1e-9));
  CHECK(result.at("peaks").at(2).at("x").get<double>() == Approx(std::numbers::pi / 3.0).epsilon(1e-9));
}

TEST_CASE("rotation: the decay of a pendulum from 60 deg gives its damping and its friction torque",
          "[scenarios][rotation]") {
  const auto result = testing::result_of(scenarios::run(scenario_from(
      "system: {mass: 0.05 kg.m^2, gravity_stiffness: 2.943 N.m, damping_ratio: 0.02, friction: {law: coulomb, "
      "kinetic: 0.02 N.m}}\ninitial: {position: 60 deg}\n"
      "analysis: {type: identify, measurement: {type: free_decay, peaks: 16}, methods: [free_decay]}\n")));
  CHECK(result.at("estimates").at(0).at("zeta").get<double>() == Approx(0.02).epsilon(0.012));
  CHECK(result.at("estimates").at(0).at("F0").get<double>() == Approx(0.02).epsilon(0.012));
}

TEST_CASE("rotation: identification from columns in degrees and N.m", "[scenarios][rotation]") {
  const auto directory = std::filesystem::temp_directory_path() / "dualdamp_rotation";
  std::filesystem::create_directories(directory);
  const auto identified = [&](const std::string& heading, double factor, const std::string& system) {
    // Extremes of m = 0.3, k = 12, F0 = 0.2, zeta = 0.03.
    std::ofstream file(directory / "decay.csv");
    file.precision(17);
    file << heading << "\n";
    const double R = std::exp(-std::numbers::pi * 0.03 / std::sqrt(1.0 - 0.03 * 0.03));
    double X = 0.5;
    for (int i = 0; i < 10; ++i) {
      file << (i % 2 == 0 ? X : -X) * factor << "\n";
      X = R * X - 0.2 / 12.0 * (1.0 + R);
    }
    file.close();
    const auto scenario = scenarios::parse_scenario(
        "schema: dualdamp/1\nsystem: " + system + "\nanalysis: {type: identify, data: decay.csv}\n",
        (directory / "rig.yaml").string());
    return testing::document_of(scenario, scenarios::run(scenario));
  };
  const auto turned = identified("x [deg]", 180.0 / std::numbers::pi, "{mass: 0.3 kg.m^2, stiffness: 12 N.m/rad}");
  const auto& answer = turned.at("result").at("estimates").at(1);  // free_decay: any_law is the first
  CHECK(answer.at("zeta").get<double>() == Approx(0.03).epsilon(1e-9));
  CHECK(answer.at("F0").get<double>() == Approx(0.2).epsilon(1e-9));
  CHECK(turned.at("units").at("estimates[].F0") == "N.m");
  CHECK(turned.at("result").at("verdict").get<std::string>().find(" N.m") != std::string::npos);
  const auto twin = identified("x [m]", 1.0, "{mass: 0.3 kg, stiffness: 12 N/m}");
  const auto same = identified("x [rad]", 1.0, "{mass: 0.3 kg.m^2, stiffness: 12 N.m/rad}");
  CHECK(same.at("result").at("estimates").at(0).at("zeta") == twin.at("result").at("estimates").at(0).at("zeta"));
  CHECK(same.at("result").at("estimates").at(0).at("F0") == twin.at("result").at("estimates").at(0).at("F0"));
  // The units of the columns determine the coordinate if the constants have no units.
  CHECK(identified("x [deg]", 180.0 / std::numbers::pi, "{mass: 0.3, stiffness: 12}").contains("units"));
  CHECK_THROWS_AS(identified("x [deg]", 1.0, "{mass: 0.3 kg, stiffness: 12 N/m}"), core::InputError);
  CHECK_THROWS_AS(identified("x", 1.0, "{mass: 0.3 kg.m^2, stiffness: 12 N.m/rad}"), core::InputError);
  std::filesystem::remove_all(directory);
}

TEST_CASE("rotation: a velocity is not shown in the unit of a frequency", "[scenarios][rotation]") {
  const std::string drive = "excitation: {type: base_harmonic, amplitude: 10 deg, frequency: 1 Hz}\n";
  const auto result = scenarios::run(scenario_from(system_of_angle + drive + "analysis: {type: steady_state}\n"));
  const auto& names = result.summary.columns.at(0).texts;
  const auto row = static_cast<std::size_t>(std::ranges::find(names, "max_speed") - names.begin());
  REQUIRE(row < names.size());
  CHECK(result.summary.columns.at(2).texts.at(row) == "rad/s");
  const double speed = testing::result_of(result).at("max_speed").get<double>();
  CHECK(std::stod(result.summary.columns.at(1).texts.at(row)) == Approx(speed).epsilon(1e-8));

  using scenarios::kind_of;
  const auto shown = [](const scenarios::ShownUnits& units, const char* name) {
    const auto unit = scenarios::shown_unit(units, kind_of("rad/s", name), 1.0);
    return unit ? unit->unit : "rad/s";
  };
  const auto stated = scenarios::shown_units({{"excitation.frequency", "Hz"}, {"initial.velocity", "deg/s"}});
  CHECK(shown(stated, "omega") == "Hz");
  CHECK(shown(stated, "final.v") == "deg/s");
  for (const char* parameter : {"velocity", "velocity[1]", "stribeck_velocity"})
    CHECK(shown(stated, parameter) == "deg/s");
  const auto asked = [](const std::string& list) {
    std::map<std::string, std::string> written;
    CHECK(scenarios::ask_for_units(list, written).empty());
    return scenarios::shown_units(written);
  };
  CHECK(shown(asked("Hz"), "omega") == "Hz");
  CHECK(shown(asked("Hz"), "v") == "rad/s");
  CHECK(shown(asked("rpm, deg/s"), "omega") == "rpm");
  CHECK(shown(asked("rpm, deg/s"), "max_speed") == "deg/s");
  // A velocity of a law that is stated in rpm is the unit of velocities, not of frequencies.
  const auto of_law = scenarios::shown_units({{"system.friction[0].stribeck_velocity", "rpm"}});
  CHECK(shown(of_law, "v") == "rpm");
  CHECK(shown(of_law, "omega") == "rad/s");
}
