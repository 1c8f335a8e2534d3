#include "scenarios/analyses/formula.hpp"

#include <catch2/catch.hpp>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;

TEST_CASE("formula: a closed form by name with its unit", "[scenarios][formula]") {
  const auto scenario = scenarios::parse_scenario(
      "schema: dualdamp/1\n"
      "analysis: {type: formula, formula: {name: transition_velocity, frequency: 1 Hz, amplitude: 20 mm, "
      "kinetic: 1 N, contact_stiffness: 100 N/m}}\n",
      "formula.yaml");
  const auto answer = testing::result_of(scenarios::run(scenario));
  INFO(answer.dump());
  // The contact slips 2 F_0/k_t = 20 mm behind a turning point of 20 mm: at zero deflection, where the speed is w
  // A.
  CHECK(answer.begin().value().get<double>() == Approx(2.0 * 3.14159265358979 * 0.02).epsilon(1e-9));
}
