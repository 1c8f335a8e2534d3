#include "scenarios/analyses/regime_map.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <utility>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("regime_map: the regimes count its points, and the boundary stands beside it",
          "[scenarios][regime_map]") {
  const auto map = answer_to(
      "{type: regime_map, frequencies: {from: 0.5 Hz, to: 2 Hz, count: 7}, amplitudes: {from: 1 mm, "
      "to: 0.4 m, count: 11}, sticking_boundary: true}");
  std::map<std::pair<int, int>, int> counted;
  for (const auto& point : map.at("points")) ++counted[{point.at("stops"), point.at("sticks")}];
  REQUIRE(map.at("regimes").size() == counted.size());
  CHECK(counted.size() >= 3);  // never moves, sticks, does not stick
  for (const auto& regime : map.at("regimes")) {
    CHECK(counted.at({regime.at("stops"), regime.at("sticks")}) == regime.at("points"));
    const bool moves = regime.at("stops") != 0 || regime.at("sticks") != 1;
    const bool rests = regime.at("sticks") != 0;
    CHECK(regime.at("regime") == (!moves ? "never moves" : rests ? "rests" : "slides through"));
  }
  REQUIRE(map.at("boundary").size() == 7);
  for (const auto& point : map.at("boundary")) {
    CHECK(point.at("Y").get<double>() == Approx(point.at("Y_closed_form").get<double>()).epsilon(1e-9));
    for (const auto& other : map.at("points"))
      if (other.at("omega") == point.at("omega"))
        CHECK((other.at("Y") > point.at("Y")) == (other.at("sticks") == 0));
  }
}

TEST_CASE("regime_map: where the mass sticks again above the boundary, columns and a warning say so",
          "[scenarios][regime_map]") {
  const scenarios::RunResult run = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\n"
      "system: {mass: 1 kg, stiffness: 100 N/m, damping_ratio: 0.02, friction: [{law: coulomb, kinetic: 0.5 N}, "
      "{law: gap_spring, stiffness: 300 N/m, gap: 20 mm}]}\n"
      "excitation: {type: base_harmonic}\n"
      "analysis: {type: regime_map, frequencies: [1.7176304102843905 rad/s], amplitudes: [60 mm, 120 mm, 212.5 mm], "
      "sticking_boundary: true}\n",
      "test.yaml"));
  const auto boundary = testing::result_of(run).at("boundary")[0];
  CHECK(boundary.at("Y").get<double>() == Approx(0.1155).epsilon(1e-3));
  CHECK(boundary.at("Y_sticks_again_from").get<double>() == Approx(0.125).epsilon(0.03));
  CHECK(boundary.at("Y_sticks_again_to") == 0.2125);  // an amplitude of the map, between two of the scan
  CHECK(std::ranges::any_of(run.warnings, [](const std::string& warning) {
    return warning.find("sticks again somewhere from") != std::string::npos;
  }));
}
