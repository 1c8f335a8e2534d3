#include "scenarios/analyses/design.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;

namespace {

/// Six levels of a rig with a compliant contact.
constexpr const char* scenario = R"(
schema: dualdamp/1
system: {mass: 1.042 kg, stiffness: 1568 N/m, damping_ratio: 0.08, friction: {law: contact_compliance, kinetic: 3 N, contact_stiffness: 2000 N/m}}
excitation: {type: base_harmonic, frequency: natural}
analysis: {type: design, measurement: {type: xy_curve, amplitudes: {from: 4 mm, to: 7.5 mm, count: 6}}, sigma_x: 0.03 mm}
)";

}  // namespace

TEST_CASE("design: candidates with their widths and power, the best first", "[scenarios][design]") {
  const auto answer = testing::result_of(scenarios::run(scenarios::parse_scenario(scenario, "test.yaml")));
  const auto& candidates = answer.at("candidates");
  // The simulated states have phases: recording them is no candidate.
  REQUIRE(candidates.size() == 7);
  double before = 0.0;
  for (const auto& candidate : candidates) {
    const double zeta = candidate.at("hull_shrinks_to").at("zeta").get<double>();
    const double size = zeta * candidate.at("hull_shrinks_to").at("F0").get<double>();
    CHECK(zeta > 0.0);
    CHECK(zeta < 1.05);
    CHECK(size >= before);
    CHECK(candidate.at("power").get<double>() > answer.at("power_now").get<double>());
    CHECK(candidate.at("power").get<double>() <= 1.0);
    CHECK(candidate.at("cost").get<double>() >= 1.0);
    before = size;
  }
  CHECK(answer.at("advice") == candidates[0].at("text"));
}
