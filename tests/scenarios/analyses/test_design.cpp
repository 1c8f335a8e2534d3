#include "scenarios/analyses/design.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;

namespace {

/// Six levels of a rig with a compliant contact, amplitudes alone.
constexpr const char* scenario = R"(
schema: dualdamp/1
system: {mass: 1.042 kg, stiffness: 1568 N/m, damping_ratio: 0.08, friction: {law: contact_compliance, kinetic: 3 N, contact_stiffness: 2000 N/m}}
excitation: {type: base_harmonic, frequency: natural}
analysis: {type: design, measurement: {type: xy_curve, amplitudes: {from: 4 mm, to: 7.5 mm, count: 6}}, sigma_x: 0.03 mm}
)";

}  // namespace

TEST_CASE("design: after amplitudes alone phases narrow the ranges more than repetition", "[scenarios][design]") {
  const auto answer = testing::result_of(scenarios::run(scenarios::parse_scenario(scenario, "test.yaml")));
  const auto& candidates = answer.at("candidates");
  REQUIRE(candidates.size() == 10);
  const auto named = [&](const std::string& words) {
    for (const auto& candidate : candidates)
      if (candidate.at("measurement").get<std::string>().find(words) == 0) return candidate;
    FAIL("no candidate " << words);
    return candidates[0];
  };
  const auto repeated = named("repeat the same states");
  const auto zeta_of = [](const auto& candidate) {
    return candidate.at("hull_shrinks_to").at("zeta").template get<double>();
  };
  for (const auto& candidate : candidates) {
    CHECK(zeta_of(candidate) > 0.0);
    CHECK(zeta_of(candidate) < 1.05);
    CHECK(candidate.at("power").get<double>() >= 0.0);
    CHECK(candidate.at("power").get<double>() <= 1.0);
  }
  const auto phases = named("the same levels at a frequency above, with their phases");
  CHECK(zeta_of(phases) < zeta_of(repeated));
  CHECK(phases.at("power").get<double>() > repeated.at("power").get<double>());
  // Best first, by both ranges together.
  double before = 0.0;
  for (const auto& candidate : candidates) {
    const double size = zeta_of(candidate) * candidate.at("hull_shrinks_to").at("F0").get<double>();
    CHECK(size >= before);
    before = size;
  }
}
