#include "scenarios/analyses/fit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/random.hpp"
#include "tests/scenarios/answers.hpp"
#include "tests/support/source_tree.hpp"

using namespace dualdamp;
using scenarios::parse_scenario;
using testing::column_of;
using testing::File;

namespace {

constexpr const char* rig = "mass: 1 kg, stiffness: 1000 N/m";

nlohmann::json result_of_text(const std::string& text) {
  const scenarios::RunResult result = scenarios::run(parse_scenario(text, "test.yaml"));
  INFO(result.failure);
  REQUIRE(result.failure.empty());
  return testing::result_of(result);
}

std::string fit_scenario(const std::string& system, const std::string& analysis, const std::string& more = {}) {
  return "schema: dualdamp/1\nsystem: {" + system + "}\n" + more + "analysis: {type: fit, " + analysis + "}\n";
}

std::string fault_of(const std::string& text) {
  try {
    static_cast<void>(parse_scenario(text, "test.yaml"));
  } catch (const core::InputError& error) {
    std::string all;
    for (const core::Diagnostic& problem : error.diagnostics()) all += core::format(problem) + "\n";
    return all;
  }
  return "no fault";
}

/// A motion of the rig with friction, as a data file with noise.
std::string history_text(const std::string& system, const std::string& drive, double noise, std::uint64_t seed) {
  const scenarios::RunResult motion =
      scenarios::run(parse_scenario("schema: dualdamp/1\nsystem: {" + system + "}\n" + drive +
                                        "\nanalysis: {type: simulate, duration: 1 s, sample_rate: 400 1/s}\n",
                                    "motion.yaml"));
  const std::vector<double> t = column_of(motion, "history", "t");
  const std::vector<double> x = column_of(motion, "history", "x");
  std::ostringstream text;
  text << "t [s],x [m]\n";
  const core::RandomStream draws{seed, 950};
  for (std::size_t i = 0; i < t.size(); ++i)
    text << core::format_number(t[i]) << "," << core::format_number(x[i] + noise * draws.normal(i)) << "\n";
  return text.str();
}

const std::string with_coulomb = std::string(rig) + ", damping: 1 N.s/m, friction: {law: coulomb, kinetic: 1 N}";
const std::string released = "initial: {position: 30 mm}";

}  // namespace

TEST_CASE("fit: the scenario of a fit runs and gives the fitted curve", "[scenarios][fit]") {
  const File data("fit_history.csv", history_text(with_coulomb, released, 1e-5, 1));
  const scenarios::RunResult fit = scenarios::run(parse_scenario(
      fit_scenario(std::string(rig) + ", friction: {law: coulomb}", "data: fit_history.csv"), "test.yaml"));
  REQUIRE(fit.failure.empty());
  const nlohmann::json result = testing::result_of(fit);
  CHECK(result.at("parameters").at(0).at("name") == "damping");
  CHECK(result.at("parameters").at(1).at("value").get<double>() == Approx(1.0).epsilon(2e-3));
  CHECK(result.at("residual").at("noise_units").get<double>() == Approx(1.0).margin(0.15));
  const scenarios::RunResult again =
      scenarios::run(parse_scenario(result.at("scenario").get<std::string>(), "fitted.yaml"));
  REQUIRE(again.failure.empty());
  const std::vector<double> fitted = column_of(fit, "fit_0_x", "fitted");
  const std::vector<double> x = column_of(again, "history", "x");
  REQUIRE(x.size() == fitted.size());
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(x[i] == Approx(fitted[i]).margin(1e-12));
}

TEST_CASE("fit: the scenario of steady states gives their points", "[scenarios][fit]") {
  const nlohmann::json curve = testing::answer_to(
      "{type: frequency_response, frequencies: [8 rad/s, 9 rad/s, 10 rad/s, 11 rad/s, 12 rad/s, 14 rad/s]}");
  std::string text = "Y [m],x [m],omega [rad/s],phase [rad]\n";
  for (const auto& point : curve.at("points"))
    text += "0.1," + point.at("x").dump() + "," + point.at("omega").dump() + "," + point.at("phase").dump() + "\n";
  const File data("fit_response.csv", text);
  const nlohmann::json result =
      result_of_text(fit_scenario("mass: 1 kg, friction: {law: coulomb}", "data: fit_response.csv"));
  for (const auto& [i, truth] : {std::pair{0U, 100.0}, {1U, 4.0}, {2U, 2.0}})
    CHECK(result.at("parameters").at(i).at("value").get<double>() == Approx(truth).epsilon(1e-5));
  const nlohmann::json again =
      testing::result_of(scenarios::run(parse_scenario(result.at("scenario").get<std::string>(), "fitted.yaml")));
  REQUIRE(again.at("points").size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(again.at("points").at(i).at("x").get<double>() ==
          Approx(curve.at("points").at(i).at("x").get<double>()).epsilon(1e-6));
    CHECK(again.at("points").at(i).at("phase").get<double>() ==
          Approx(curve.at("points").at(i).at("phase").get<double>()).epsilon(1e-6));
  }
}

TEST_CASE("fit: laws are compared, and the right one predicts", "[scenarios][fit]") {
  const File data("fit_first.csv", history_text(with_coulomb, released, 1e-5, 2));
  const File other("fit_second.csv", history_text(with_coulomb, "initial: {position: 12 mm}", 1e-5, 3));
  const nlohmann::json result = result_of_text(fit_scenario(
      rig, "data: [{file: fit_first.csv}], validate: fit_second.csv, laws: [viscous_saturating, coulomb]"));
  CHECK(result.at("law") == "coulomb");
  // A force that saturates at low speed is Coulomb friction with one more parameter.
  CHECK(result.at("laws").at(0).at("weight").get<double>() > 0.5);
  const nlohmann::json& validation = result.at("validation");
  CHECK(validation.at("error").get<double>() < 1.1 * validation.at("attainable").get<double>());
  CHECK(validation.at("wrong") == false);
}

TEST_CASE("fit: the page's example gives the printed numbers", "[scenarios][fit]") {
  const nlohmann::json result =
      testing::result_of(scenarios::run(scenarios::load_scenario(testing::in_tree("scenarios/examples/fit.yaml"))));
  std::ifstream page(testing::in_tree("docs/fit.md"));
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    for (const auto& parameter : result.at("parameters")) {
      if (!line.starts_with("| " + parameter.at("name").get<std::string>() + " | ")) continue;
      std::istringstream cells(line);
      std::string bar;
      std::string name;
      double value = 0.0, std = 0.0, low = 0.0, high = 0.0;
      cells >> bar >> name >> bar >> value >> bar >> std >> bar >> low >> bar >> high;
      CHECK(parameter.at("value").get<double>() == Approx(value).margin(5.1e-5));
      CHECK(parameter.at("std").get<double>() == Approx(std).epsilon(0.02));
      CHECK(parameter.at("interval95").at(0).get<double>() == Approx(low).margin(5.1e-5));
      CHECK(parameter.at("interval95").at(1).get<double>() == Approx(high).margin(5.1e-5));
      ++rows;
    }
  }
  CHECK(rows == 2);
}

TEST_CASE("fit: a stated initial state is known", "[scenarios][fit]") {
  const File data("fit_known.csv", history_text(with_coulomb, released, 1e-5, 4));
  const nlohmann::json result = result_of_text(
      fit_scenario(std::string(rig) + ", friction: {law: coulomb}", "data: fit_known.csv", released + "\n"));
  CHECK(result.at("parameters").size() == 2);
}

TEST_CASE("fit: a stated tolerance counts, that of a simulation too", "[scenarios][fit]") {
  // A fit has a looser tolerance of its own where none is stated, and both give residuals that differ in late
  // digits.
  const std::string dahl = ", friction: {law: dahl, kinetic: 1 N, sigma0: 5000 N/m}";
  const File data("fit_tolerance.csv",
                  history_text(std::string(rig) + ", damping: 1 N.s/m" + dahl, released, 1e-5, 5));
  const auto rms_with = [&](const std::string& numerics) {
    return result_of_text(fit_scenario(rig + dahl, "data: fit_tolerance.csv, profile: false, starts: 1",
                                       released + "\n" + numerics))
        .at("residual")
        .at("rms")
        .get<double>();
  };
  const double usual = rms_with("");
  CHECK(rms_with("numerics: {tolerance: 1e-9}\n") == usual);
  CHECK(rms_with("numerics: {tolerance: 1e-11}\n") != usual);
}

TEST_CASE("fit: what cannot be fitted is refused with its place", "[scenarios][fit]") {
  const File data("fit_faults.csv", "t [s],x [m]\n0,0.03\n0.1,-0.02\n0.2,0.015\n0.3,-0.01\n0.4,0.006\n");
  const std::string known = std::string(rig) + ", friction: {law: coulomb}";
  using Catch::Contains;
  CHECK_THAT(fault_of(fit_scenario(known, "data: missing.csv")), Contains("cannot be opened"));
  CHECK_THAT(fault_of(fit_scenario(known, "data: fit_faults.csv, free: kinetik")),
             Contains("there is no number 'kinetik' to fit; there are mass, stiffness"));
  CHECK_THAT(fault_of(fit_scenario("friction: {law: coulomb}", "data: fit_faults.csv")),
             Contains("neither the mass nor the stiffness is known"));
  CHECK_THAT(fault_of(fit_scenario(known, "data: {file: fit_faults.csv, loop: true}")),
             Contains("a loop needs the columns"));
  CHECK_THAT(
      fault_of(fit_scenario(known, "data: {file: fit_faults.csv, sigma_v: 1 mm/s}")),
      Contains("fit_faults.csv: 'sigma_v' states the noise of v, and the file has no v") && !Contains("compares"));
  CHECK_THAT(fault_of(fit_scenario(known, "data: fit_faults.csv, laws: [dahl]")),
             Contains("stands beside 'system.friction'"));
  CHECK_THAT(fault_of(fit_scenario(known, "data: fit_faults.csv, bounds: [{name: kinetic, low: 3 kg}]")),
             Contains("the bound '3 kg' of kinetic"));
  CHECK_THAT(fault_of(fit_scenario(
                 known, "data: fit_faults.csv, free: static, bounds: [{name: static, low: 1 N, high: 1.3 N}]")),
             Contains("'static' has bounds, and is sought as its distance above kinetic"));
  CHECK_THAT(fault_of(fit_scenario(std::string(rig) + ", friction: {law: generalized_maxwell_slip}",
                                   "data: fit_faults.csv")),
             Contains("'elements' of generalized_maxwell_slip is missing"));
  CHECK_THAT(fault_of(fit_scenario(std::string(rig) + ", friction: {law: iwan}", "data: fit_faults.csv")),
             Contains("'count' of iwan is missing: state 'iwan.count'; a fit seeks numbers only"));
  CHECK_THAT(fault_of(fit_scenario(std::string(rig) + ", friction: {law: reset_integrator}",
                                   "data: fit_faults.csv, free: stiffness")),
             Contains("'stiffness' may be system.stiffness or friction.stiffness"));
}

TEST_CASE("fit: an angle has its own units in bounds and results", "[scenarios][fit]") {
  const std::string wheel = "mass: 0.3 kg.m^2, stiffness: 12 N.m/rad";
  std::string text = history_text(wheel + ", damping: 0.04 N.m.s/rad, friction: {law: coulomb, kinetic: 0.2 N.m}",
                                  "initial: {position: 0.4 rad}", 1e-4, 8);
  const std::size_t unit = text.find("x [m]");
  REQUIRE(unit != std::string::npos);
  const File data("fit_angle.csv", text.replace(unit, 5, "x [rad]"));
  const std::string system = wheel + ", friction: {law: coulomb}";
  const nlohmann::json result = result_of_text(fit_scenario(
      system, "data: fit_angle.csv, profile: false, bounds: [{name: kinetic, low: 10 mN.m, high: 0.5 N.m}]"));
  std::map<std::string, std::string> units;
  for (const nlohmann::json& parameter : result.at("parameters"))
    units[parameter.at("name").get<std::string>()] = parameter.at("unit").get<std::string>();
  CHECK(units.at("kinetic") == "N.m");
  CHECK(units.at("damping") == "N.m.s/rad");
  CHECK(units.at("position") == "rad");
  CHECK(units.at("velocity") == "rad/s");
  CHECK(result.at("residual").at("unit") == "rad");
  CHECK(result.at("signals").at(0).at("unit") == "rad");
  CHECK_THAT(fault_of(fit_scenario(system, "data: fit_angle.csv, bounds: [{name: kinetic, low: 1 N}]")),
             Catch::Contains("the bound '1 N' of kinetic"));
}

TEST_CASE("fit: a zero of the sensor that is far off is subtracted and told, its rest is sought",
          "[scenarios][fit]") {
  std::string text = history_text(with_coulomb, released, 1e-5, 7);
  std::istringstream lines(text);
  std::string shifted;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t cut = line.find(',');
    const bool is_header = shifted.empty();
    shifted +=
        is_header ? line : line.substr(0, cut + 1) + core::format_number(std::stod(line.substr(cut + 1)) + 0.1);
    shifted += '\n';
  }
  const File data("fit_zero.csv", shifted);
  const std::string known = std::string(rig) + ", friction: {law: coulomb}";
  const auto fit_with = [&](const std::string& more, const std::string& initial) {
    return scenarios::run(parse_scenario(fit_scenario(known, "data: fit_zero.csv" + more, initial), "test.yaml"));
  };
  const auto is_told = [](const scenarios::RunResult& result) {
    return std::ranges::any_of(result.warnings, [](const std::string& warning) {
      return warning.find("taken as the zero of the sensor and subtracted") != std::string::npos;
    });
  };
  for (const std::string& initial : {std::string(), released + "\n"}) {
    CAPTURE(initial);
    const scenarios::RunResult fit = fit_with("", initial);
    REQUIRE(fit.failure.empty());
    CHECK(is_told(fit));
    const nlohmann::json result = testing::result_of(fit);
    CHECK(result.at("parameters").back().at("name") == "offset");
    CHECK(result.at("parameters").at(1).at("value").get<double>() == Approx(1.0).epsilon(2e-3));
    CHECK(result.at("residual").at("noise_units").get<double>() == Approx(1.0).margin(0.15));
  }
  // If the offset is fitted, nothing is subtracted before.
  const scenarios::RunResult fit = fit_with(", free: offset", "");
  REQUIRE(fit.failure.empty());
  CHECK(!is_told(fit));
}

TEST_CASE("fit: a copy of a record is refused whatever its name and its last digits", "[scenarios][fit]") {
  const std::string text = history_text(with_coulomb, released, 1e-5, 8);
  const File data("fit_once.csv", text);
  const File copy("fit_twice.csv", "# a copy\n" + text);
  CHECK_THAT(fault_of(fit_scenario(std::string(rig) + ", friction: {law: coulomb}",
                                   "data: [fit_once.csv, fit_twice.csv]")),
             Catch::Contains("holds the same data as fit_once.csv"));
}

TEST_CASE("fit: a mass that nobody stated is found from afar", "[scenarios][fit]") {
  // With too few steps at the beginning of the motion the fit of the shipped record ends at 20 times the noise.
  std::ifstream in(testing::in_tree("scenarios/examples/free_run.csv"));
  std::stringstream text;
  text << in.rdbuf();
  const File data("fit_mass.csv", text.str());
  const nlohmann::json result = result_of_text(fit_scenario("stiffness: 1000 N/m, friction: {law: coulomb}",
                                                            "data: fit_mass.csv, free: mass, profile: false"));
  CHECK(result.at("residual").at("noise_units").get<double>() == Approx(1.0).margin(0.05));
  CHECK(result.at("parameters").at(0).at("value").get<double>() == Approx(1.0).epsilon(1e-4));
}

TEST_CASE("fit: empty items of a list state how many elements are sought", "[scenarios][fit]") {
  // Springs of 3000 and 500 N/m that slip at 1 and 1.5 N, each followed on its own.
  std::ostringstream loop;
  loop << "t [s],x [m],force [N]\n";
  double soft = 0.0;
  double stiff = 0.0;
  double before = 0.0;
  const core::RandomStream draws{7, 951};
  for (int i = 0; i <= 800; ++i) {
    const double t = i / 400.0;
    const double x = 5e-3 * (std::sin(12.0 * t) + 0.4 * std::sin(31.0 * t));
    stiff = std::clamp(stiff + 3000.0 * (x - before), -1.0, 1.0);
    soft = std::clamp(soft + 500.0 * (x - before), -1.5, 1.5);
    before = x;
    const double noise = 0.01 * draws.normal(static_cast<std::uint64_t>(i));
    loop << core::format_number(t) << "," << core::format_number(x) << ","
         << core::format_number(stiff + soft + noise) << "\n";
  }
  const File data("fit_elements.csv", loop.str());
  const std::string analysis = "data: [{file: fit_elements.csv, loop: true}], profile: false";
  const auto value_of = [](const nlohmann::json& result, const std::string& name) {
    for (const nlohmann::json& parameter : result.at("parameters"))
      if (parameter.at("name") == name) return parameter.at("value").get<double>();
    FAIL(name);
    return 0.0;
  };
  const nlohmann::json iwan = result_of_text(fit_scenario("friction: {law: iwan, elements: [{}, {}]}", analysis));
  CHECK(value_of(iwan, "elements[0].stiffness") == Approx(3000.0).epsilon(0.05));
  CHECK(value_of(iwan, "elements[0].limit") == Approx(1.0).epsilon(0.05));
  CHECK(value_of(iwan, "elements[1].stiffness") == Approx(500.0).epsilon(0.05));
  CHECK(value_of(iwan, "elements[1].limit") == Approx(1.5).epsilon(0.05));
  // What is stated of an item is known.
  const nlohmann::json partly = result_of_text(
      fit_scenario("friction: {law: iwan, elements: [{stiffness: 3000 N/m}, {limit: 1.5 N}]}", analysis));
  CHECK(partly.at("parameters").size() == 2);
  CHECK(value_of(partly, "elements[0].limit") == Approx(1.0).epsilon(0.05));
  CHECK(value_of(partly, "elements[1].stiffness") == Approx(500.0).epsilon(0.05));
  CHECK_THAT(fault_of("schema: dualdamp/1\nsystem: {" + std::string(rig) +
                      ", friction: {law: iwan, elements: [{}, {}]}}\ninitial: {position: 1 mm}\n"
                      "analysis: {type: simulate, duration: 1 s}\n"),
             Catch::Contains("'system.friction.elements[0].stiffness' is missing"));
  CHECK_THAT(fault_of(fit_scenario("friction: {law: generalized_maxwell_slip}", analysis)),
             Catch::Contains("state the list, such as [{}, {}]"));
}
