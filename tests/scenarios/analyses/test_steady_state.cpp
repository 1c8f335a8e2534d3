#include "scenarios/analyses/steady_state.hpp"

#include <catch2/catch.hpp>

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
