#include "scenarios/run.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "identify/readers/record_reader.hpp"
#include "scenarios/output.hpp"
#include "tests/scenarios/answers.hpp"
#include "tests/scenarios/files.hpp"

using namespace dualdamp;
using nlohmann::json;
using scenarios::RunResult;
using scenarios::Scenario;
using testing::document_of;
using testing::result_of;
using testing::scenario_of;

namespace {

std::string csv(const scenarios::Table& table, const core::Provenance& provenance) {
  std::ostringstream text;
  scenarios::write_csv(text, table, provenance);
  return text.str();
}

/// Slow scenarios, which the tests of bench/ and of the program run.
bool answered_elsewhere(const Scenario& scenario) { return scenario.analysis_name == "mechanisms"; }

/// Scenarios of records without an answer, because friction is not Coulomb and viscous, or because a method
/// estimates the damping alone.
bool has_no_answer(const std::filesystem::path& path) {
  const std::set<std::string> names = {"open_question_two_frequencies", "section4_laws", "section4_subsets",
                                       "random_decrement"};
  return names.contains(path.stem().string());
}

/// As shipped, but advice among few laws, whose result has the same numbers: the Python package asks for that of
/// its page among all of them.
Scenario shipped(const std::filesystem::path& path) {
  Scenario scenario = testing::load(path);
  if (scenario.analysis_name != "design") return scenario;
  return scenarios::load_scenario(path.string(),
                                  {.set = {{"analysis.without=[bouc_wen, dahl, elasto_plastic, film_beside_damper, "
                                            "friction_lag, generalized_maxwell_slip, iwan, lugre, "
                                            "normal_vibration, position_slope, wide_stribeck]"}},
                                   .analyses = bench::analyses()});
}

/// No number of the document is infinite or NaN; JSON has null instead.
void check_finite(const json& value) {
  if (value.is_structured())
    for (const json& item : value) check_finite(item);
  if (value.is_number_float()) CHECK(std::isfinite(value.get<double>()));
}

/// Every number of the document is a declared field of the analysis.
void check_described(const json& value, const std::string& path, const Scenario& scenario) {
  if (value.is_object())
    for (const auto& [key, item] : value.items())
      check_described(item, path.empty() ? key : path + "." + key, scenario);
  if (value.is_array())
    for (const json& item : value) check_described(item, path + "[]", scenario);
  if (value.is_number()) {
    CAPTURE(path);
    CHECK(std::ranges::find(scenario.result_fields, path, &scenarios::ResultField::path) !=
          scenario.result_fields.end());
  }
}

}  // namespace

TEST_CASE("run: every shipped scenario gives what it expects, with all of its numbers in the tables",
          "[scenarios][run]") {
  for (const std::string folder : {"scenarios/paper", "scenarios/examples"})
    for (const auto& path : testing::yaml_files(folder)) {
      CAPTURE(path.string());
      const Scenario scenario = shipped(path);
      if (answered_elsewhere(scenario)) continue;
      const RunResult result = scenarios::run(scenario);
      CHECK(result.status == (has_no_answer(path) ? core::ExitStatus::numerical_failure : core::ExitStatus::done));
      for (const scenarios::Check& check : result.checks) {
        CAPTURE(check.path, check.expected, check.found);
        CHECK(check.ok);
      }
      const json document = result_of(result);
      check_finite(document);
      check_described(document, "", scenario);
    }
}

TEST_CASE("run: the keys of the results are those of the contract", "[scenarios][run]") {
  const auto keys = [](const json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  const json state = result_of(scenarios::run(scenario_of("{type: steady_state}")));
  for (const char* key : {"peak", "trough", "amplitude", "phase", "period", "max_speed", "stops_per_cycle",
                          "sticks", "multipliers", "energy"})
    CHECK(state.contains(key));
  const json curve = result_of(scenarios::run(scenario_of("{type: xy_curve, amplitudes: [0.1]}")));
  CHECK(keys(curve.at("points").at(0)) == std::vector<std::string>{"Y", "stable", "sticks", "stops", "x"});
  const json response = result_of(scenarios::run(scenario_of("{type: frequency_response, frequencies: [1 Hz]}")));
  CHECK(keys(response.at("points").at(0)) ==
        std::vector<std::string>{"omega", "phase", "stable", "sticks", "stops", "x"});
  const json map = result_of(
      scenarios::run(scenario_of("{type: regime_map, frequencies: [10 rad/s, 2 Hz], amplitudes: [0.05, 0.1]}")));
  CHECK(map.at("points").size() == 4);
  CHECK(keys(map.at("points").at(0)) == std::vector<std::string>{"Y", "omega", "regime", "sticks", "stops", "x"});
  const json branch =
      result_of(scenarios::run(scenario_of("{type: xy_branch, amplitudes: {from: 0.1 m, to: 0.03 m}}")));
  CHECK(keys(branch.at("points").at(0)) ==
        std::vector<std::string>{"Y", "peak", "stable", "sticks", "stops", "trough", "x"});
  CHECK(branch.at("points").back().at("Y") == 0.03);
  CHECK(branch.at("changes").at(0).at("kind") == "sticking");
  CHECK(branch.at("certificate").at("searches") > 0);
  const json history = result_of(scenarios::run(scenario_of("{type: simulate, cycles: 2}")));
  for (const char* key : {"events", "final", "energy"}) CHECK(history.contains(key));
  CHECK(keys(history.at("events").at(0)) == std::vector<std::string>{"kind", "t", "v", "x"});
  const json estimates = result_of(
      scenarios::run(scenario_of("{type: identify, measurement: {type: xy_curve, amplitudes: [0.1, 0.2, 0.3]}}")));
  for (const char* key : {"method", "zeta", "c", "x_f", "F0", "std", "interval95", "diagnostics", "usable"})
    CHECK(estimates.at("estimates").at(0).contains(key));
  CHECK(estimates.contains("fit"));
}

TEST_CASE("run: what is said of many points is said once, with their number and the first place",
          "[scenarios][run]") {
  const std::string never = "the mass never moves: any rest position that friction can hold is steady too";
  CHECK(scenarios::run(scenario_of("{type: xy_curve, amplitudes: [0.1, 0.01, 0.015]}")).warnings ==
        std::vector<std::string>{never + " (2 points; first points[1], Y = 0.01 m)"});
  CHECK(scenarios::run(scenario_of("{type: xy_curve, amplitudes: [0.01, 0.1]}")).warnings ==
        std::vector<std::string>{never + " (points[0], Y = 0.01 m)"});
  CHECK(scenarios::run(scenario_of("{type: regime_map, frequencies: [2 rad/s, 5 rad/s], amplitudes: [0.1, 0.01]}"))
            .warnings ==
        std::vector<std::string>{never + " (2 points; first points[1], omega = 2 rad/s, Y = 0.01 m)"});
}

TEST_CASE("run: an expected value that is off ends with status 1 and says by how much", "[scenarios][run]") {
  const RunResult result = scenarios::run(scenario_of(
      "{type: steady_state}", "expect:\n  - {value: peak, equals: 0.186, within: 1.0e-6, source: nowhere}\n"));
  CHECK(result.status == core::ExitStatus::check_failed);
  REQUIRE(result.checks.size() == 1);
  CHECK_FALSE(result.checks[0].ok);
  CHECK(result.checks[0].difference == Approx(7.81e-5).epsilon(1e-3));
  CHECK(result_of(result).at("peak").get<double>() == Approx(0.186078).epsilon(1e-6));
}

TEST_CASE("run: bounds of expected values", "[scenarios][run]") {
  const auto ok = [](const std::string& expectation) {
    const RunResult result = scenarios::run(scenario_of("{type: steady_state}", "expect: [" + expectation + "]\n"));
    return result.checks.at(0).ok;
  };
  CHECK(ok("{value: stops_per_cycle, equals: 0}"));
  CHECK(ok("{value: stable, equals: true}"));
  CHECK_FALSE(ok("{value: stable, equals: false}"));
  CHECK_FALSE(ok("{value: peak, equals: 0.186078}"));
  CHECK(ok("{value: peak, equals: 0.186, within: 1.0e-3}"));
  CHECK(ok("{value: trough, equals: -0.186, within_relative: 1.0e-3}"));
  CHECK_FALSE(ok("{value: trough, equals: -0.186, within_relative: 1.0e-4}"));
  CHECK_FALSE(ok("{value: peak, equals: high}"));
}

TEST_CASE("run: a path that is not in the result is the scenario's fault", "[scenarios][run]") {
  const Scenario scenario =
      scenario_of("{type: simulate, cycles: 1}", "expect:\n  - {value: \"events[999].t\", equals: 1}\n");
  try {
    (void)scenarios::run(scenario);
    FAIL("accepted");
  } catch (const core::InputError& error) {
    REQUIRE(error.diagnostics().size() == 1);
    CHECK(error.diagnostics()[0].place.line == 6);
    CHECK(error.diagnostics()[0].place.column == 13);
  }
}

TEST_CASE("run: no steady state is a numerical failure without a result", "[scenarios][run]") {
  // Negative damping adds more energy than Coulomb friction dissipates: the motion grows without bound.
  const Scenario scenario = scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 100, damping: -4}\n"
      "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: natural}\nanalysis: {type: steady_state}\n",
      "growing.yaml");
  const RunResult result = scenarios::run(scenario);
  CHECK(result.status == core::ExitStatus::numerical_failure);
  CHECK(result.result == "null");
  CHECK_FALSE(result.failure.empty());
  const json document = document_of(scenario, result);
  CHECK(document.at("status") == 4);
  CHECK(document.at("result").is_null());
  CHECK(document.at("errors").at(0).at("message") == result.failure);
}

TEST_CASE("run: a document opens with program and provenance and repeats the scenario", "[scenarios][run]") {
  const Scenario scenario = scenario_of("{type: steady_state}");
  const RunResult result = scenarios::run(scenario);
  const auto document = document_of(scenario, result);
  std::vector<std::string> keys;
  for (const auto& [key, value] : document.items()) keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"program", "provenance", "scenario", "analysis", "status", "result",
                                         "warnings", "checks", "errors"});
  CHECK(document.at("program").at("name") == "dualdamp");
  CHECK(document.at("analysis") == "steady_state");
  CHECK(document.at("scenario").at("system").at("friction").at("static") == 2.0);
  CHECK(document.at("provenance").at("scenario_sha256").get<std::string>().size() == 64);
}

TEST_CASE("run: a table opens with comments and reads back to the same bits", "[scenarios][run]") {
  scenarios::Table table{"curve",
                         {{"Y", "m", {0.1, 1.0 / 3.0, 1e-5}, {}},
                          {"x", "m", {1.0, std::numeric_limits<double>::quiet_NaN(), 2.0}, {}},
                          {"reason", "", {}, {"", "a, \"b\"", "# c"}, scenarios::CellKind::text}}};
  core::Provenance provenance;
  provenance.source = "two\nlines.yaml";
  std::istringstream lines(csv(table, provenance));
  std::string line;
  while (std::getline(lines, line) && line.starts_with("# ")) CHECK(line.find(": ") != std::string::npos);
  CHECK(line == "Y [m],x [m],reason");
  std::getline(lines, line);
  CHECK(line == "0.1,1,");
  std::getline(lines, line);
  CHECK(line == "0.3333333333333333,,\"a, \"\"b\"\"\"");
  std::getline(lines, line);
  CHECK(line == "1.0e-05,2,\"# c\"");
}

TEST_CASE("run: a curve of the program is data for the program", "[scenarios][run]") {
  const Scenario scenario = scenario_of("{type: xy_curve, amplitudes: [0.1, 0.2, 0.5, 0.6]}");
  const RunResult result = scenarios::run(scenario);
  REQUIRE(result.tables.size() == 1);
  const auto record = identify::parse_record(csv(result.tables[0], result.provenance), "curve.csv");
  REQUIRE(record.record.pairs);
  CHECK(record.record.pairs->pairs.size() == 4);
  CHECK(record.record.pairs->pairs[3].x == result.tables[0].columns[1].numbers[3]);
}

TEST_CASE("run: an option that some of the chosen methods do not use is named in a warning", "[scenarios][run]") {
  const RunResult result = scenarios::run(
      scenario_of("{type: identify, measurement: {type: xy_curve, amplitudes: [0.3 m, 0.4 m, 0.5 m]}, "
                  "methods: [resonance_two_point, resonance_least_squares], bootstrap: 20}"));
  CHECK(std::ranges::find(result.warnings, "the option 'bootstrap' is not used by resonance_two_point") !=
        result.warnings.end());
}
