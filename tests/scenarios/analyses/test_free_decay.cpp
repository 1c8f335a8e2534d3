#include "scenarios/analyses/free_decay.hpp"

#include <catch2/catch.hpp>

#include "sim/analytic/free_decay.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;

TEST_CASE("free_decay: the extremes are those of the closed form", "[scenarios][free_decay]") {
  const auto scenario = scenarios::parse_scenario(
      "schema: dualdamp/1\n"
      "system: {mass: 1 kg, stiffness: 100 N/m, damping_ratio: 0.05, friction: {law: coulomb, kinetic: 2 N}}\n"
      "initial: {position: 0.5 m}\n"
      "analysis: {type: free_decay, peaks: 30}\n",
      "decay.yaml");
  const auto answer = testing::result_of(scenarios::run(scenario));
  const auto exact = sim::analytic::free_decay_extremes(0.05, 0.02, 0.5, 30);
  REQUIRE(answer.at("peaks").size() == exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
    CHECK(answer.at("peaks")[i].at("x").get<double>() == Approx(exact[i]).margin(1e-14));
  CHECK(answer.at("came_to_rest") == true);
}
