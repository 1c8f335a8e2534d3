#include "scenarios/analyses/simulate.hpp"

#include <catch2/catch.hpp>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("simulate: the motion ends at the duration, whatever the pieces of the drive add up to",
          "[scenarios][simulate]") {
  const scenarios::Scenario scenario = scenarios::parse_scenario(
      "schema: dualdamp/1\n"
      "system: {mass: 1, stiffness: 100, damping: 1.5, friction: {law: coulomb, kinetic: 0.3}}\n"
      "excitation: {type: base_noise, intensity: 40 mm^2/Hz, bandwidth: 12 Hz, seed: 3}\n"
      "analysis: {type: simulate, duration: 5}\n",
      "test.yaml");
  CHECK(testing::result_of(scenarios::run(scenario)).at("final").at("t").get<double>() == 5.0);
}

TEST_CASE("simulate: a motion without a stated time lasts as long as its drive", "[scenarios][simulate]") {
  const auto text = [](const std::string& drive) {
    return "schema: dualdamp/1\n"
           "system: {mass: 1, stiffness: 100, damping: 1.5, friction: {law: coulomb, kinetic: 0.3}}\n"
           "excitation: " +
           drive + "\nanalysis: {type: simulate}\n";
  };
  for (const char* drive : {"{type: base_table, times: [0, 1, 2.5], values: [0 mm, 9 mm, 4 mm]}",
                            "{type: force_chirp, amplitude: 2 N, from: 1 Hz, to: 2 Hz, duration: 2.5}"}) {
    const scenarios::Scenario scenario = scenarios::parse_scenario(text(drive), "test.yaml");
    CHECK_THAT(scenario.resolved, Catch::Contains("\"type\":\"simulate\",\"duration\":2.5"));
    CHECK(testing::result_of(scenarios::run(scenario)).at("final").at("t").get<double>() == 2.5);
  }
  const std::string repeated = "{type: base_table, times: [0, 1, 2], values: [0 mm, 9 mm, 0 mm], repeat: true}";
  CHECK_THROWS_WITH(scenarios::parse_scenario(text(repeated), "test.yaml"),
                    Catch::Contains("4:1: error: 'analysis' needs one of duration, cycles"));
  const std::string without_end = "{type: force_chirp, amplitude: 2 N, from: 1 Hz, to: 2 Hz}";
  CHECK_THROWS_WITH(scenarios::parse_scenario(text(without_end), "test.yaml"),
                    Catch::Contains("'excitation.duration' is missing") && !Catch::Contains("needs one of"));
}

TEST_CASE("simulate: events alternate and the energy balance closes", "[scenarios][simulate]") {
  const auto answer = answer_to("{type: simulate, cycles: 20, sample_rate: 100 Hz}");
  const auto& events = answer.at("events");
  REQUIRE(events.size() == 40);  // two reversals a period
  for (std::size_t i = 1; i < events.size(); ++i) {
    CHECK(events[i].at("kind") == "reversal");
    CHECK(events[i].at("t") > events[i - 1].at("t"));
    CHECK(events[i].at("x").get<double>() * events[i - 1].at("x").get<double>() < 0.0);
  }
  // After twenty periods the motion is the steady one of Eq (3).
  CHECK(events[39].at("x").get<double>() == Approx(-0.1860780979567862).epsilon(1e-9));
  const auto& energy = answer.at("energy");
  CHECK(std::abs(energy.at("defect").get<double>()) < 1e-12 * energy.at("input").get<double>());
}
