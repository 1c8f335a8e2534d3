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
