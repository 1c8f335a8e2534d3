#include "scenarios/analyses/frequency_response.hpp"

#include <catch2/catch.hpp>

#include "sim/analytic/den_hartog.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("frequency_response: amplitude and phase of Den Hartog's closed form",
          "[scenarios][frequency_response]") {
  const auto answer = answer_to("{type: frequency_response, frequencies: {from: 5 rad/s, to: 20 rad/s, count: 7}}");
  REQUIRE(answer.at("points").size() == 7);
  for (const auto& point : answer.at("points")) {
    const double r = point.at("omega").get<double>() / 10.0;
    CAPTURE(r);
    const auto exact = sim::analytic::non_sticking_state(sim::analytic::den_hartog(0.2, r), 0.1, 0.02);
    REQUIRE(exact.has_value() == (point.at("stops") == 0));
    if (!exact) continue;
    CHECK(point.at("x").get<double>() == Approx(exact->amplitude).epsilon(1e-12));
    CHECK(point.at("phase").get<double>() == Approx(exact->phase).epsilon(1e-9));
  }
}
