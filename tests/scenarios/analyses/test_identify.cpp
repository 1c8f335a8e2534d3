#include "scenarios/analyses/identify.hpp"

#include <catch2/catch.hpp>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("identify: an exact method finds the friction of the simulated system", "[scenarios][identify]") {
  const auto answer = answer_to(
      "{type: identify, measurement: {type: xy_curve, amplitudes: {from: 0.1 m, to: 0.6 m, count: 6}}, "
      "methods: [den_hartog_fit]}");
  const auto& estimate = answer.at("estimates").at(0);
  CHECK(estimate.at("c").get<double>() == Approx(4.0).epsilon(1e-9));
  CHECK(estimate.at("F0").get<double>() == Approx(2.0).epsilon(1e-9));
  CHECK(estimate.at("usable") == true);
}
