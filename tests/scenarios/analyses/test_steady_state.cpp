#include "scenarios/analyses/steady_state.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("steady_state: one period of Eq (3) at resonance", "[scenarios][steady_state]") {
  const auto answer = answer_to("{type: steady_state}");
  CHECK(answer.at("amplitude").get<double>() == Approx(0.1860780979567862).epsilon(1e-14));
  CHECK(answer.at("stops_per_cycle") == 0);
  CHECK(answer.at("stable") == true);
  // The work of the base equals the work of friction and damper.
  const auto& energy = answer.at("energy");
  CHECK(energy.at("friction").get<double>() == Approx(4.0 * 2.0 * 0.1860780979567862).epsilon(1e-13));
  CHECK(energy.at("input").get<double>() ==
        Approx(energy.at("friction").get<double>() + energy.at("viscous").get<double>()).epsilon(1e-13));
}

TEST_CASE("steady_state, frequency_response: without a fundamental there is no phase but a reason, also verified",
          "[scenarios][steady_state]") {
  const struct {
    const char* drive;
    const char* kinetic;
    const char* reason;
  } cases[] = {
      {"0, harmonics: [{order: 2, amplitude: 3 cm}]", "0.5", "the excitation has no fundamental"},
      {"0, harmonics: [{order: 3, amplitude: 3 cm}]", "0.5", "the excitation has no fundamental"},
      {"1e-9, harmonics: [{order: 3, amplitude: 3 cm}]", "0.5", "x has no fundamental"},
      {"0.01", "1.5", "the mass never moves"},
      {"1e-3, harmonics: [{order: 3, amplitude: 3 cm}]", "0.5", ""},
  };
  for (const auto& [drive, kinetic, reason] : cases) {
    for (const bool curve : {false, true}) {
      CAPTURE(drive, kinetic, curve);
      const std::string analysis =
          curve ? "{type: frequency_response, frequencies: [5 rad/s]}" : "{type: steady_state}";
      const scenarios::RunResult run = scenarios::run(scenarios::parse_scenario(
          "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 100, damping: 2, friction: {law: coulomb, kinetic: " +
              std::string(kinetic) + "}}\nexcitation: {type: base_harmonic, frequency: 5 rad/s, amplitude: " +
              drive + "}\nanalysis: " + analysis + "\nnumerics: {verify: true}\n",
          "test.yaml"));
      REQUIRE(run.verification);
      CHECK(run.verification->agrees);
      const auto result = testing::result_of(run);
      const auto& state = curve ? result.at("points").at(0) : result;
      CHECK(state.at("phase").is_null() == !std::string(reason).empty());
      if (state.at("phase").is_null())
        CHECK_THAT(state.at("phase_reason").get<std::string>(), Catch::StartsWith(reason));
      else
        CHECK_FALSE(state.contains("phase_reason"));
    }
  }
}

TEST_CASE("steady_state: a creep that multiplies errors of steps is stated, though a later stick erases them",
          "[scenarios][steady_state]") {
  // Near x = 0.7 mm the mass creeps or stops, by errors of steps; the Floquet multipliers are below 1e-5.
  const auto warnings_at = [](const std::string& frequency) {
    return scenarios::run(scenarios::parse_scenario(
                              R"(
schema: dualdamp/1
system:
  mass: 2.2483347106656835
  stiffness: 36.29370609747048
  damping: 54.47156566278355
  damper_to: base
  friction:
    law: stribeck
    kinetic: 0.7127513475500846
    static: 1.081859944971499
    stribeck_velocity: 0.03908091252014891
    load_modulation: {ratio: 0.7139192233641408, order: 1, phase: 0.8765265070011707}
    warming: {power: 0.04434443751929292, time_constant: 0.013846270061682263}
analysis: {type: steady_state}
numerics: {tolerance: 1e-8}
excitation: {type: force_harmonic, phase: 4.0576355962064765, amplitude: 1.8290187766710142, frequency: )" +
                                  frequency + "}\n",
                              "test.yaml"))
        .warnings;
  };
  const auto states_error = [](const std::vector<std::string>& warnings) {
    return std::ranges::any_of(warnings, [](const std::string& one) {
      return one.find("with a tenth of 'numerics.tolerance' its period differs by that") != std::string::npos;
    });
  };
  CHECK(states_error(warnings_at("0.060068030022972285 rad/s")));
  CHECK_FALSE(states_error(warnings_at("3 rad/s")));
}
