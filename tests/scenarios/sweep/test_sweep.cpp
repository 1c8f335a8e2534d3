#include "scenarios/sweep/sweep.hpp"

#include <catch2/catch.hpp>

#include "bench/analyses.hpp"
#include "tests/scenarios/answers.hpp"
#include "tests/support/problems.hpp"

using namespace dualdamp;
using testing::answer_to;
using testing::document_of;
using testing::scenario_of;

namespace {

const std::string question = "{type: steady_state}";

/// The problems of a sweep of the usual system.
std::vector<core::Diagnostic> problems_of_sweep(const std::string& sweep, const std::string& analysis = question) {
  return test::problems_of([&] { return scenario_of(analysis, sweep); });
}

/// The problem of a sweep that has only one.
core::Diagnostic problem_of(const std::string& sweep, const std::string& analysis = question) {
  const std::vector<core::Diagnostic> problems = problems_of_sweep(sweep, analysis);
  REQUIRE(problems.size() == 1);
  return problems.front();
}

const scenarios::Table& file_table(const scenarios::RunResult& result, const std::string& name) {
  const auto found =
      std::ranges::find_if(result.tables, [&](const auto& t) { return t.name == name && t.is_file; });
  REQUIRE(found != result.tables.end());
  return *found;
}

}  // namespace

TEST_CASE("sweep: two keys, each point bit for bit that of the scenario with its values", "[scenarios][sweep]") {
  const scenarios::Scenario scenario = scenario_of(
      question,
      "sweep: {system.friction.kinetic: {from: 1 N, to: 3 N, count: 3}, system.damping: [4 N.s/m, 6 N.s/m]}");
  const scenarios::RunResult result = scenarios::run(scenario);
  CHECK(result.status == core::ExitStatus::done);
  const auto points = testing::result_of(result).at("sweep");
  REQUIRE(points.size() == 6);
  std::size_t index = 0;
  for (const char* friction : {"1 N", "2 N", "3 N"})
    for (const char* damping : {"4 N.s/m", "6 N.s/m"}) {
      scenarios::LoadOptions options;
      options.set = {{std::string("system.friction.kinetic=") + friction},
                     {std::string("system.damping=") + damping}};
      const auto alone = testing::result_of(scenarios::run(
          scenarios::parse_scenario("schema: dualdamp/1\n"
                                    "system: {mass: 1 kg, stiffness: 100 N/m, friction: {law: coulomb}}\n"
                                    "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 "
                                    "rad/s}\nanalysis: {type: steady_state}\n",
                                    "alone.yaml", options)));
      CHECK(points[index].at("result").dump() == alone.dump());
      ++index;
    }
  CHECK(points[5].at("values") == nlohmann::json({{"system.friction.kinetic", 3.0}, {"system.damping", 6.0}}));
}

TEST_CASE("sweep: the table has the units the user wrote, and the telling numbers first", "[scenarios][sweep]") {
  const scenarios::RunResult result =
      scenarios::run(scenario_of(question, "sweep: {excitation.frequency: {from: 1 Hz, to: 2 Hz, count: 3}}"));
  const scenarios::Table& rows = file_table(result, "sweep");
  REQUIRE(rows.size() == 3);
  CHECK(rows.columns[0].name == "excitation.frequency");
  CHECK(rows.columns[0].unit == "Hz");
  CHECK(rows.columns[0].numbers == std::vector{1.0, 1.5, 2.0});
  CHECK(rows.columns[1].name == "status");
  CHECK(rows.columns[2].name == "amplitude");
  CHECK(rows.columns[2].unit == "m");
  // In JSON all numbers are SI.
  CHECK(testing::result_of(result).at("sweep").at(1).at("values").at("excitation.frequency").get<double>() ==
        Approx(9.42477796076938));
}

TEST_CASE("sweep: curves stand below each other with their point and value", "[scenarios][sweep]") {
  const scenarios::RunResult result = scenarios::run(
      scenario_of("{type: xy_curve, amplitudes: [0.1 m, 0.6 m]}", "sweep: {system.friction.kinetic: [1 N, 2 N]}"));
  const scenarios::Table& rows = file_table(result, "sweep_points");
  REQUIRE(rows.size() == 4);
  CHECK(rows.columns[0].numbers == std::vector{0.0, 0.0, 1.0, 1.0});
  CHECK(rows.columns[1].numbers == std::vector{1.0, 1.0, 2.0, 2.0});
  CHECK(rows.columns[2].name == "Y");
  CHECK(rows.columns[3].name == "x");
  CHECK(rows.columns[3].numbers[3] == Approx(1.4361439607891242).epsilon(1e-14));
}

TEST_CASE("sweep: a key may be left out elsewhere, and what depends on it follows", "[scenarios][sweep]") {
  // `natural` is another frequency at each mass; the resolved scenario keeps the word and gives the same numbers.
  const std::string text =
      "schema: dualdamp/1\nsystem: {stiffness: 100 N/m, damping_ratio: 0.2, friction: {law: coulomb, kinetic: 2 "
      "N}}\n"
      "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: natural}\nanalysis: {type: steady_state}\n"
      "sweep: {system.mass: [1 kg, 4 kg]}\n";
  const scenarios::Scenario scenario = scenarios::parse_scenario(text, "text.yaml");
  const auto points = testing::result_of(scenarios::run(scenario)).at("sweep");
  CHECK(points[0].at("result").at("period").get<double>() == Approx(0.2 * 3.14159265358979));
  CHECK(points[1].at("result").at("period").get<double>() == Approx(0.4 * 3.14159265358979));
  const scenarios::Scenario again = scenarios::parse_scenario(scenario.resolved, "resolved.yaml");
  CHECK(again.resolved == scenario.resolved);
  CHECK(testing::result_of(scenarios::run(again)).at("sweep").dump() == points.dump());
}

TEST_CASE("sweep: a default that follows the swept key does so when the resolved scenario runs",
          "[scenarios][sweep]") {
  // If `static` is not stated, it equals `kinetic` at each point. The value of the first point would change the
  // numbers without a message for smaller `kinetic`, and be refused for larger. A stated `static` is kept.
  const auto [friction, values] = GENERATE(table<std::string, std::string>(
      {{"{law: coulomb, kinetic: 2 N}", "{system.friction.kinetic: {from: 3 N, to: 1 N, count: 3}}"},
       {"{law: coulomb, kinetic: 2 N}", "{system.friction.kinetic: [1 N, 3 N, 2 N]}"},
       {"[{law: coulomb, kinetic: 1 N}, {law: coulomb, kinetic: 2 N}]",
        "{\"system.friction[1].kinetic\": [2 N, 1 N]}"},
       {"{law: coulomb, kinetic: 2 N, static: 3 N}", "{system.friction.kinetic: [3 N, 1 N]}"}}));
  const scenarios::Scenario scenario = scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: " + friction +
          "}\nexcitation: {type: base_harmonic, amplitude: 0.1 m, frequency: natural}\n"
          "analysis: {type: steady_state}\nsweep: " +
          values + "\n",
      "text.yaml");
  const auto points = testing::result_of(scenarios::run(scenario)).at("sweep");
  const scenarios::Scenario again = scenarios::parse_scenario(scenario.resolved, "resolved.yaml");
  CHECK(again.resolved == scenario.resolved);
  CHECK(testing::result_of(scenarios::run(again)).at("sweep").dump() == points.dump());
  CHECK((scenario.resolved.find("\"static\":3.0") != std::string::npos) ==
        (friction.find("static") != std::string::npos));
}

TEST_CASE("sweep: items of lists, and data of identifications", "[scenarios][sweep]") {
  const auto laws = scenarios::run(
      scenarios::parse_scenario("schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, "
                                "friction: [{law: coulomb, kinetic: "
                                "1 N}, {law: coulomb, kinetic: 0 N}]}\nexcitation: {type: base_harmonic, "
                                "amplitude: 0.1 m, frequency: 10 rad/s}\n"
                                "analysis: {type: steady_state}\nsweep:\n  system.friction[1].kinetic: [1 N]\n",
                                "laws.yaml"));
  // Forces of parallel laws add: 2 N in all.
  CHECK(testing::result_of(laws).at("sweep").at(0).at("result").at("peak").get<double>() ==
        Approx(0.1860780979567862).epsilon(1e-13));
  const auto found = answer_to(
      "{type: identify, measurement: {type: xy_curve, amplitudes: [0.2 m, 0.3 m, 0.4 m, 0.5 m]}, methods: "
      "[resonance_least_squares]}",
      "sweep: {system.friction.kinetic: [1 N, 2 N, 3 N]}");
  for (int i = 0; i < 3; ++i)
    CHECK(found.at("sweep").at(i).at("result").at("estimates").at(0).at("F0").get<double>() ==
          Approx(i + 1).epsilon(1e-7));
}

TEST_CASE("sweep: failed points are rows with a reason", "[scenarios][sweep]") {
  // Without damping and friction there is no steady state at resonance.
  const std::string laws = "sweep: {system.damping: [0 N.s/m, 4 N.s/m], system.friction.kinetic: [0 N]}";
  const scenarios::RunResult some = scenarios::run(scenario_of(question, laws));
  CHECK(some.status == core::ExitStatus::some_cases_failed);
  CHECK(some.failure.find("1 of 2 points failed") != std::string::npos);
  const auto points = testing::result_of(some).at("sweep");
  CHECK(points[0].at("status") == 4);
  CHECK(points[0].at("result").is_null());
  CHECK_FALSE(points[0].at("reason").get<std::string>().empty());
  CHECK(points[1].at("status") == 0);
  CHECK(file_table(some, "sweep").columns.back().name == "reason");
  const scenarios::RunResult all =
      scenarios::run(scenario_of(question, "sweep: {system.damping: [0 N.s/m], system.friction.kinetic: [0 N]}"));
  CHECK(all.status == core::ExitStatus::numerical_failure);
  CHECK(testing::result_of(all).at("sweep").at(0).at("status") == 4);
}

TEST_CASE("sweep: the same document for any number of threads", "[scenarios][sweep]") {
  const scenarios::Scenario scenario =
      scenario_of(question, "sweep: {system.friction.kinetic: {from: 0.1 N, to: 5 N, count: 40}}");
  const std::string one = testing::result_of(scenarios::run(scenario, {.threads = 1})).dump();
  for (const int threads : {2, 3})
    CHECK(testing::result_of(scenarios::run(scenario, {.threads = threads})).dump() == one);
}

TEST_CASE("sweep: every value is checked before anything runs", "[scenarios][sweep]") {
  const auto negative = problem_of("sweep: {system.mass: [1 kg, -2 kg]}");
  CHECK(negative.place.line == 5);
  CHECK(negative.place.column == 29);
  CHECK(negative.message == "with system.mass = -2 kg: 'system.mass' is out of range");
  // A fault that the value causes at another place names the value too.
  try {
    (void)scenarios::parse_scenario(
        "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 100 N/m, friction: {law: coulomb, kinetic: 2 N}}\n"
        "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: damped}\nanalysis: {type: steady_state}\n"
        "sweep: {system.damping: {from: 10 N.s/m, to: 40 N.s/m, count: 4}}\n",
        "damped.yaml");
    FAIL("not refused");
  } catch (const core::InputError& error) {
    REQUIRE(error.diagnostics().size() == 1);
    CHECK(error.diagnostics().front().place.line == 3);
    CHECK(error.diagnostics().front().message ==
          "with system.damping = 20 N.s/m: there is no damped frequency: the damping ratio is not below 1 (so at 3 "
          "points)");
  }
}

TEST_CASE("sweep: what cannot be swept", "[scenarios][sweep]") {
  CHECK(problem_of("sweep: {system.mas: [1 kg]}").message.find("unknown key 'mas'") != std::string::npos);
  CHECK(problem_of("sweep: {title: [1, 2]}").message == "'title' is no number of this scenario");
  CHECK(problem_of("sweep: {system: [1]}").message == "'system' is no number of this scenario");
  CHECK(problem_of("sweep: {system.friction: [1]}").message == "'system.friction' is no number of this scenario");
  CHECK(problem_of("sweep: {system.friction.law: [coulomb]}").message.find("takes numbers only") !=
        std::string::npos);
  CHECK(problem_of("sweep: {system.mass: [1 kg, 200 g]}").message.find("different units") != std::string::npos);
  // The first value is no number: it sets no unit for the second.
  CHECK(problem_of("sweep: {excitation.frequency: [natural, 10 rad/s]}").message.find("takes numbers only") !=
        std::string::npos);
  CHECK(problem_of("sweep: {system.mass: [1 kg +- 1 %]}").message.find("takes no uncertainty") !=
        std::string::npos);
  CHECK(problem_of("sweep: {system.mass: 1 kg}").message.find("has one value only") != std::string::npos);
  CHECK(problem_of("sweep: {system.mass: {from: 1 kg, to: 2 kg}}").message.find("'count' is missing") !=
        std::string::npos);
  CHECK(problem_of("sweep: {system.mass: {from: 0 kg, to: 2 kg, count: 3, spacing: log}}")
            .message.find("equal ratios") != std::string::npos);
  CHECK(problem_of("sweep: {a: [1], b: [1], c: [1]}").message.find("one or two keys") != std::string::npos);
  CHECK(
      problem_of(
          "sweep: {system.mass: {from: 1 kg, to: 2 kg, count: 101}, system.damping: {from: 1, to: 2, count: 100}}")
          .message == "the sweep has too many points");
  CHECK(problem_of("sweep: {system.mass: {from: 1 kg, to: 2 kg, count: 101}}",
                   "{type: xy_curve, amplitudes: {from: 1 mm, to: 2 mm, count: 10000}}")
            .message == "the results of the sweep are too long");
}

TEST_CASE("sweep: a campaign has a grid of its own", "[scenarios][sweep]") {
  try {
    (void)scenarios::parse_scenario(
        "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, "
        "kinetic: 2 N}}\nexcitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}\nanalysis: "
        "{type: stress_test, laws: [dahl], severities: [0.1], ranges: [{name: a, amplitudes: [0.3 m, 0.4 m, 0.5 "
        "m]}]}\nsweep: {system.mass: [1 kg]}\n",
        "campaign.yaml", {.analyses = bench::analyses()});
    FAIL("not refused");
  } catch (const core::InputError& error) {
    REQUIRE(error.diagnostics().size() == 1);
    CHECK(error.diagnostics().front().place.line == 5);
    CHECK(error.diagnostics().front().message.find("analysis 'stress_test' cannot be swept") != std::string::npos);
  }
}

TEST_CASE("sweep: expectations are of its own result", "[scenarios][sweep]") {
  const std::string sweep = "sweep: {system.friction.kinetic: [1 N, 2 N]}\n";
  const auto result = scenarios::run(scenario_of(
      question,
      sweep + "expect: [{value: \"sweep[1].result.peak\", equals: 0.1860780979567862, within: 1.0e-13}]"));
  REQUIRE(result.checks.size() == 1);
  CHECK(result.checks.front().ok);
  CHECK(problem_of(sweep + "expect: [{value: peak, equals: 1}]").message.find("has no number 'peak'") !=
        std::string::npos);
  CHECK(problem_of(sweep + "expect: [{value: peak, equals: 1}]").suggestion == "sweep[0].result.peak");
  CHECK(problem_of(sweep + "expect: []").message == "'expect' has the wrong number of items");
  CHECK(problem_of(sweep + "expect: [{value: \"sweep[2].result.peak\", equals: 1}]").message.find("no such item") !=
        std::string::npos);
}

TEST_CASE("sweep: a key that a list of the analysis replaces is refused, and may stand in the file",
          "[scenarios][sweep]") {
  const auto [analysis, key, values, list] = GENERATE(table<std::string, std::string, std::string, std::string>(
      {{"{type: xy_curve, amplitudes: [0.1 m, 0.2 m]}", "excitation.amplitude", "[0.3 m, 0.4 m]",
        "analysis.amplitudes"},
       {"{type: xy_branch, amplitudes: {from: 0.1 m, to: 0.2 m}}", "excitation.amplitude", "[0.3 m, 0.4 m]",
        "analysis.amplitudes"},
       {"{type: frequency_response, frequencies: [9 rad/s, 10 rad/s]}", "excitation.frequency",
        "[8 rad/s, 9 rad/s]", "analysis.frequencies"},
       {"{type: regime_map, frequencies: [9 rad/s, 10 rad/s], amplitudes: [0.1 m]}", "excitation.frequency",
        "[8 rad/s, 9 rad/s]", "analysis.frequencies"},
       {"{type: identify, measurement: {type: xy_curve, amplitudes: [0.2 m, 0.3 m, 0.4 m]}, methods: "
        "[resonance_least_squares]}",
        "excitation.amplitude", "[0.3 m, 0.4 m]", "analysis.measurement.amplitudes"},
       {"{type: identify, measurement: {type: frequency_response, frequencies: [9 rad/s, 10 rad/s, 11 rad/s]}}",
        "excitation.frequency", "[8 rad/s, 9 rad/s]", "analysis.measurement.frequencies"}}));
  CAPTURE(analysis, key);
  const core::Diagnostic problem = problem_of("sweep: {" + key + ": " + values + "}", analysis);
  CHECK(problem.message == "'" + key + "' has no effect: '" + list + "' replaces it");
  CHECK(problem.place.line == 5);
  CHECK(problem.place.column == 9);
  CHECK_NOTHROW(scenario_of(analysis));
  // The frequency of these curves has an effect.
  if (key == "excitation.amplitude")
    CHECK_NOTHROW(scenario_of(analysis, "sweep: {excitation.frequency: [8 rad/s, 9 rad/s]}"));
}

TEST_CASE("sweep: an input amplitude has the unit of its drive in the tables", "[scenarios][sweep]") {
  const auto unit_of = [](const scenarios::RunResult& result, const std::string& table, const std::string& column) {
    const scenarios::Table& rows = file_table(result, table);
    const auto found = std::ranges::find(rows.columns, column, &scenarios::Column::name);
    REQUIRE(found != rows.columns.end());
    return found->unit;
  };
  const auto swept = [](const std::string& system, const std::string& excitation, const std::string& analysis) {
    return scenarios::run(scenarios::parse_scenario(
        "schema: dualdamp/1\nsystem: {" + system + ", friction: {law: coulomb, kinetic: 2}}\nexcitation: " +
            excitation + "\nanalysis: " + analysis + "\nsweep: {system.damping: [4, 5]}\n",
        "units.yaml"));
  };
  const std::string line = "mass: 1 kg, stiffness: 100 N/m, damping: 4";
  const std::string turn = "mass: 1 kg.m^2, stiffness: 100 N.m/rad, damping: 4";
  const std::string base = "{type: base_harmonic, frequency: 10 rad/s}";
  const std::string force = "{type: force_harmonic, frequency: 10 rad/s}";
  const std::string curve = "{type: xy_curve, amplitudes: [8, 9]}";
  CHECK(unit_of(swept(line, base, curve), "sweep_points", "Y") == "m");
  CHECK(unit_of(swept(line, force, curve), "sweep_points", "Y") == "N");
  CHECK(unit_of(swept(turn, base, curve), "sweep_points", "Y") == "rad");
  CHECK(unit_of(swept(turn, force, curve), "sweep_points", "Y") == "N.m");
  CHECK(unit_of(swept(line, force, "{type: xy_branch, amplitudes: {from: 8, to: 9}}"), "sweep_points", "Y") == "N");
  const auto map =
      swept(line, force, "{type: regime_map, frequencies: [9 rad/s], amplitudes: [8, 9], sticking_boundary: true}");
  CHECK(unit_of(map, "sweep_points", "Y") == "N");
  CHECK(unit_of(map, "sweep_regimes", "Y_from") == "N");
  CHECK(unit_of(map, "sweep_regimes", "Y_to") == "N");
  CHECK(unit_of(map, "sweep_boundary", "Y") == "N");
}
