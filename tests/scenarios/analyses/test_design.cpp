#include "scenarios/analyses/design.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;

namespace {

/// Six levels of a rig with a compliant contact.
constexpr const char* compliant_rig = R"(
schema: dualdamp/1
system: {mass: 1.042 kg, stiffness: 1568 N/m, damping_ratio: 0.08, friction: {law: contact_compliance, kinetic: 3 N, contact_stiffness: 2000 N/m}}
excitation: {type: base_harmonic, frequency: natural}
analysis: {type: design, measurement: {type: xy_curve, amplitudes: {from: 4 mm, to: 7.5 mm, count: 6}}, sigma_x: 0.03 mm}
)";

/// What a scenario leaves out to ask about few laws: `contact_compliance`, `free_play`, `partial_play`, `stribeck`,
/// `viscous_power` and `viscous_saturating`. Each law takes time as a truth and as a rival of every truth.
const std::string all_but_few =
    "asymmetry, base_distortion, bouc_wen, cubic_spring, dahl, detuning, elasto_plastic, film_beside_damper, "
    "friction_lag, generalized_maxwell_slip, iwan, lugre, normal_vibration, position_slope, reset_integrator, "
    "static_friction, wide_stribeck";

/// The scenario of the compliant rig with few laws, and without these.
std::string with_few_laws(const std::string& without = "") {
  std::string text = compliant_rig;
  text.replace(text.find("sigma_x"), 0, "without: [" + all_but_few + without + "], ");
  return text;
}

nlohmann::json design_answer(const std::string& text) {
  return testing::result_of(scenarios::run(scenarios::parse_scenario(text, "test.yaml")));
}

/// The advice for the compliant rig with few laws, which several checks are about.
void check_candidates(const scenarios::RunResult& run) {
  const auto answer = testing::result_of(run);
  const auto& candidates = answer.at("candidates");
  // The simulated states have phases, so recording phases is not a candidate.
  REQUIRE(candidates.size() == 9);
  double before = 0.0;
  for (const auto& candidate : candidates) {
    const double zeta = candidate.at("hull_shrinks_to").at("zeta").get<double>();
    const double size = zeta * candidate.at("hull_shrinks_to").at("F0").get<double>();
    CHECK(zeta > 0.0);
    // Another frequency frees the spring under every law, which may widen a range: measured up to 1.4 times.
    CHECK(zeta < 1.5);
    CHECK(size >= before);
    CHECK(candidate.at("power").get<double>() >= 0.0);
    CHECK(candidate.at("hull_by_law").at("zeta")[0].get<double>() <= zeta);
    CHECK(candidate.at("hull_by_law").at("zeta")[1].get<double>() >= zeta);
    CHECK(candidate.at("power").get<double>() <= 1.0);
    CHECK(candidate.at("cost").get<double>() >= 1.0);
    before = size;
  }
  // The advice stands above the table of numbers, and not in it.
  CHECK(answer.at("advice") == candidates[0].at("text"));
  CHECK(answer.at("advice") == run.sentence);
  const std::vector<std::string>& names = run.summary.columns[0].texts;
  CHECK(std::ranges::find(names, "advice") == names.end());
}

/// What to do, in numbers: in words as the user writes units, and in SI.
void check_instructions(const scenarios::RunResult& run) {
  const auto answer = testing::result_of(run);
  std::size_t states = 0;
  for (const auto& candidate : answer.at("candidates")) {
    const auto instruction = candidate.at("instruction").get<std::string>();
    INFO(instruction);
    CHECK(candidate.at("text").get<std::string>().ends_with(". To do: " + instruction));
    CHECK(instruction.find(" mm") != std::string::npos);
    if (candidate.contains("release")) {
      CHECK(instruction.find("let the mass go from x = ") != std::string::npos);
      CHECK(candidate.at("duration").get<double>() == Approx(8 * 3.14159265 / std::sqrt(1568 / 1.042)));
      CHECK(candidate.at("sample_rate").get<double>() > 600.0);
      continue;
    }
    CHECK(instruction.find(" Hz") != std::string::npos);
    double all = 0.0;
    for (const auto& state : candidate.at("states")) all += state.at("times").get<double>();
    CHECK(all == candidate.at("cost").get<double>());
    CHECK(candidate.at("settle").get<double>() > 0.5);
    ++states;
  }
  CHECK(states == answer.at("candidates").size() - 1);
  const auto named = [&](const std::string& name) {
    for (const auto& candidate : answer.at("candidates"))
      if (candidate.at("measurement") == name) return candidate.at("instruction").get<std::string>();
    return std::string();
  };
  CHECK(named("repeat the same states")
            .starts_with("6 states: Y = 4 mm, 4.7 mm, 5.4 mm, 6.1 mm, 6.8 mm, 7.5 mm at 6.174 Hz; wait "));
  CHECK(named("the lowest and the highest level, each taken several times")
            .starts_with("6 states: Y = 4 mm (3 times), 7.5 mm (3 times) at 6.174 Hz; wait "));
  CHECK(named("the resonance curve at the highest level, with phases")
            .starts_with("6 states: Y = 7.5 mm at 6 frequencies from "));
}

void check_limits_of_the_drive() {
  std::string text = with_few_laws();
  text.replace(text.find("type: design"), 12, "type: design, most_level: 8 mm, most_frequency: 6.2 Hz");
  const scenarios::RunResult run = scenarios::run(scenarios::parse_scenario(text, "test.yaml"));
  const auto answer = testing::result_of(run);
  for (const auto& candidate : answer.at("candidates"))
    for (const auto& state : candidate.value("states", nlohmann::json::array())) {
      CHECK(state.at("Y").get<double>() <= 0.008);
      CHECK(state.at("omega").get<double>() < 39.0);
    }
  CHECK(answer.at("left_out").size() >= 3);
  CHECK(std::ranges::any_of(run.warnings, [](const std::string& warning) {
    return warning.find(
               "left out, because the drive cannot do them by 'most_level' and 'most_frequency': the same "
               "states at levels twice as high, with phases; ") != std::string::npos;
  }));
}

void check_laws_left_out(const scenarios::RunResult& run) {
  const auto some = design_answer(with_few_laws(", free_play, partial_play"));
  CHECK(some.at("candidates")[0].at("power") != testing::result_of(run).at("candidates")[0].at("power"));
}

void check_uncertain_constants(const scenarios::RunResult& run) {
  const auto answer_with = [](const std::string& mass, const std::string& analysis) {
    std::string text = with_few_laws();
    text.replace(text.find("1.042 kg"), 8, mass);
    text.replace(text.find("type: design"), 12, analysis);
    return design_answer(text);
  };
  const auto width = [](const nlohmann::json& ends) { return ends[1].get<double>() - ends[0].get<double>(); };
  const auto exact = testing::result_of(run);
  const auto uncertain = answer_with("1.042 kg +- 15 %", "type: design");
  const auto identified = answer_with("1.042 kg +- 15 %", "type: identify, methods: [any_law]");
  for (const char* number : {"zeta", "F0"}) {
    CHECK(width(uncertain["hull95"][number]) > 1.05 * width(exact["hull95"][number]));
    CHECK(uncertain["hull95"][number] == identified["estimates"][0]["hull95"][number]);
  }
  // No measurement determines the mass again, so the best candidate helps less.
  CHECK(uncertain["candidates"][0]["hull_shrinks_to"]["F0"].get<double>() >
        exact["candidates"][0]["hull_shrinks_to"]["F0"].get<double>());
  const auto gains = answer_with("1.042 kg", "type: design, gain_uncertainty: {x: 10 %, y: 10 %}");
  CHECK(width(gains["hull95"]["F0"]) > width(exact["hull95"]["F0"]));
  CHECK_THROWS_AS(answer_with("1.042 kg", "type: design, gain_uncertainty: {force: 10 %}"), core::InputError);
}

}  // namespace

TEST_CASE("design: candidates, laws that are left out, and uncertain constants", "[scenarios][design]") {
  static const scenarios::RunResult run = scenarios::run(scenarios::parse_scenario(with_few_laws(), "test.yaml"));
  SECTION("candidates have their widths and power, the best first") { check_candidates(run); }
  SECTION("each says in numbers what to do") { check_instructions(run); }
  SECTION("what the drive cannot do is left out and named") { check_limits_of_the_drive(); }
  SECTION("laws that are left out take no part") { check_laws_left_out(run); }
  SECTION("uncertain constants are in the ranges now and after, as in those of identify") {
    check_uncertain_constants(run);
  }
}

TEST_CASE("design: of the record that another scenario identifies", "[scenarios][design]") {
  const std::string all = compliant_rig;
  const std::string head = all.substr(0, all.find("analysis:"));
  const std::string record =
      "measurement: {type: xy_curve, amplitudes: {from: 4 mm, to: 7.5 mm, count: 6}}, sigma_x: 0.03 mm";
  const scenarios::LoadOptions options{.instead = "design"};
  const scenarios::Scenario asked =
      scenarios::parse_scenario(head + "analysis: {type: identify, methods: [any_law], bootstrap: 100, " + record +
                                    "}\nexpect: [{value: \"estimates[0].usable\", equals: true}]\n",
                                "test.yaml", options);
  CHECK(asked.analysis_name == "design");
  REQUIRE(asked.warnings.size() == 1);
  CHECK(asked.warnings[0] == "'design' does not use analysis.methods, analysis.bootstrap, expect: left out");
  CHECK(scenarios::parse_scenario(compliant_rig, "test.yaml", options).warnings.empty());
  CHECK(asked.resolved == scenarios::parse_scenario(all, "test.yaml").resolved);
  CHECK_THROWS_WITH(scenarios::parse_scenario(head + "analysis: {type: steady_state}\n", "test.yaml", options),
                    Catch::Contains("no record to ask 'design' of"));
}

TEST_CASE("design: where no law fits the ranges are not to be used, as in identify", "[scenarios][design]") {
  // Errors of 0.1 mm where 5 um are stated.
  std::ofstream("misfit_data.csv")
      << "Y [mm],x [mm]\n4,27.1\n4.5,32.3\n5,37.1\n5.5,42.3\n6,47.1\n6.5,52.3\n7,57.1\n";
  const auto run = [](const std::string& type, const std::string& sigma_x) {
    return scenarios::run(
        scenarios::parse_scenario("schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m}\n"
                                  "excitation: {type: base_harmonic, frequency: natural}\nanalysis: {type: " +
                                      type + ", data: misfit_data.csv, sigma_x: " + sigma_x +
                                      ", without: [contact_compliance, " + all_but_few + "]}\n",
                                  "test.yaml"));
  };
  const auto tells = [](const std::vector<std::string>& warnings, const std::string& words) {
    return std::ranges::any_of(warnings,
                               [&](const std::string& one) { return one.find(words) != std::string::npos; });
  };
  const scenarios::RunResult next = run("design", "5 um");
  const scenarios::RunResult identified = run("identify, methods: [any_law]", "5 um");
  const auto answer = testing::result_of(next);
  CHECK(answer.at("inflation").get<double>() > 3.0);
  CHECK(answer.at("inflation") == testing::result_of(identified).at("estimates")[0].at("inflation"));
  for (const std::string words : {"no law of the library fits: the noise was raised by a factor of ",
                                  "no law of the library fits: the best one misses the readings by "}) {
    CHECK(tells(next.warnings, words));
    CHECK(tells(identified.warnings, words));
  }
  CHECK(next.sentence.find("not to be used") != std::string::npos);
  // With the noise that the record has, some law fits.
  const scenarios::RunResult right = run("design", "0.1 mm");
  CHECK(testing::result_of(right).at("inflation") == 1.0);
  CHECK_FALSE(tells(right.warnings, "no law of the library fits"));
  CHECK(right.sentence.find("not to be used") == std::string::npos);
  std::remove("misfit_data.csv");
}

TEST_CASE("design: data that state their own frequencies, and data without steady states", "[scenarios][design]") {
  const auto write = [](const char* text) { std::ofstream("design_data.csv") << text; };
  const auto read = [](const std::string& excitation) {
    return scenarios::parse_scenario("schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m}\n" +
                                         excitation + "analysis: {type: design, data: design_data.csv}\n",
                                     "test.yaml");
  };
  write("frequency [Hz],Y [mm],x [mm]\n5.0,4,27.1\n5.0,5,37.3\n5.0,6,47.2\n5.0,7,57.3\n");
  CHECK_NOTHROW(read(""));
  // Stated twice with different values: one would be ignored.
  CHECK_THROWS_AS(read("excitation: {type: base_harmonic, frequency: 5.5 Hz}\n"), core::InputError);
  CHECK_NOTHROW(read("excitation: {type: base_harmonic, frequency: 5.01 Hz}\n"));
  write("Y [mm],x [mm]\n4,27.1\n5,37.3\n6,47.2\n7,57.3\n");
  CHECK_THROWS_AS(read(""), core::InputError);
  write("x [mm]\n30\n-28\n26\n-24\n22\n");
  CHECK_THROWS_AS(read(""), core::InputError);
  std::remove("design_data.csv");
}

TEST_CASE("design: beside a gross error there is no advice", "[scenarios][design]") {
  std::ofstream("gross_data.csv") << "Y [mm],x [mm]\n4,27.1\n5,37.3\n6,4720\n7,57.3\n8,67.2\n";
  const scenarios::RunResult run = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m}\n"
      "excitation: {type: base_harmonic, frequency: natural}\nanalysis: {type: design, data: gross_data.csv}\n",
      "test.yaml"));
  CHECK(run.status == core::ExitStatus::numerical_failure);
  CHECK(run.failure.find("x of pair 3 is 1e+02 times what all other readings expect") != std::string::npos);
  std::remove("gross_data.csv");
}

TEST_CASE("design: two or three states are told what to measure first", "[scenarios][design]") {
  const auto said = [](const std::string& rows, const std::string& limit) {
    std::ofstream("few_states.csv") << "Y [mm],x [mm]\n" << rows;
    const auto run = scenarios::run(
        scenarios::parse_scenario("schema: dualdamp/1\nsystem: {mass: 35 kg, stiffness: 3993.3 N/m}\n"
                                  "excitation: {type: base_harmonic, frequency: 1.7 Hz}\n"
                                  "analysis: {type: design, data: few_states.csv" +
                                      limit + "}\n",
                                  "few_states.yaml"));
    std::remove("few_states.csv");
    CHECK(run.status == core::ExitStatus::numerical_failure);
    return run.failure;
  };
  CHECK_THAT(
      said("2,3.1\n6,30\n", ""),
      Catch::Contains("measure first 6 states: Y = 2.571 mm, 3.143 mm, 3.714 mm, 4.286 mm, 4.857 mm, 5.429 mm "
                      "at 1.7 Hz; read x and its phase to y"));
  CHECK_THAT(said("2,3.1\n2.02,3.2\n6,30\n", ""), Catch::Contains("measure first 6 states: Y = 2.571 mm"));
  CHECK_THAT(said("4,3.1\n4.1,3.3\n", ""), Catch::Contains("10.86 mm, 12 mm at 1.7 Hz"));
  CHECK_THAT(said("4,3.1\n4.1,3.3\n", ", most_level: 8 mm"), Catch::Contains("8 mm at 1.7 Hz"));
}
