#include "scenarios/analyses/xy_curve.hpp"

#include <catch2/catch.hpp>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("xy_curve: Table 1 by Eq (3), in the order of the amplitudes", "[scenarios][xy_curve]") {
  const auto answer = answer_to("{type: xy_curve, amplitudes: [0.6 m, 0.1 m]}");
  const auto& points = answer.at("points");
  REQUIRE(points.size() == 2);
  CHECK(points[0].at("Y") == 0.6);
  CHECK(points[0].at("x").get<double>() == Approx(1.4361439607891242).epsilon(1e-14));
  CHECK(points[1].at("x").get<double>() == Approx(0.1860780979567862).epsilon(1e-14));
}
