#include "scenarios/analyses/xy_branch.hpp"

#include <catch2/catch.hpp>

#include "sim/analytic/den_hartog.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("xy_branch: the points of the branch are those of the closed form", "[scenarios][xy_branch]") {
  const auto answer = answer_to("{type: xy_branch, amplitudes: {from: 0.1 m, to: 0.6 m}}");
  const auto& points = answer.at("points");
  REQUIRE(points.size() > 2);
  CHECK(points.front().at("Y") == 0.1);
  CHECK(points.back().at("Y").get<double>() == Approx(0.6).epsilon(1e-12));
  const auto functions = sim::analytic::den_hartog(0.2, 1.0);
  for (const auto& point : points)
    CHECK(point.at("x").get<double>() ==
          Approx(*sim::analytic::amplitude(functions, point.at("Y").get<double>(), 0.02)).epsilon(1e-9));
  CHECK(answer.at("changes").empty());
}
