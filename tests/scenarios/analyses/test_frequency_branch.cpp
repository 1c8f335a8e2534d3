#include "scenarios/analyses/frequency_branch.hpp"

#include <catch2/catch.hpp>

#include "sim/analytic/den_hartog.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("frequency_branch: the points of the branch are those of the closed form",
          "[scenarios][frequency_branch]") {
  const auto answer = answer_to("{type: frequency_branch, frequencies: {from: 9 rad/s, to: 11 rad/s}}");
  const auto& points = answer.at("points");
  REQUIRE(points.size() > 2);
  CHECK(points.front().at("omega") == 9.0);
  CHECK(points.back().at("omega").get<double>() == Approx(11.0).epsilon(1e-12));
  for (const auto& point : points) {
    const auto functions = sim::analytic::den_hartog(0.2, point.at("omega").get<double>() / 10.0);
    CHECK(point.at("x").get<double>() == Approx(*sim::analytic::amplitude(functions, 0.1, 0.02)).epsilon(1e-9));
  }
}
