#include "identify/methods/histories/extended_kalman.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/identify/histories.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

Estimate with_width(const Record& record, double width) {
  KalmanOptions options;
  options.sign_width = width;
  return extended_kalman(record, bearing_constants, options);
}

Record noisy_record() {
  Normal normal(3);
  return record_of(
      {displacement_only(sampled(driven_bearing(bearing_c, bearing_F0, 4e-3), 10.0, 1000.0), 1e-5, normal)});
}

}  // namespace

TEST_CASE("The filter comes near the friction, and its bias grows with the width of the sign") {
  const Record record = noisy_record();
  const Estimate fine = with_width(record, 0.0005);
  const Estimate coarse = with_width(record, 0.0015);
  REQUIRE(fine.outcome.ok());
  REQUIRE(coarse.outcome.ok());
  CHECK(fine.usable);
  CHECK(fine.value.F0 == Approx(bearing_F0).epsilon(0.02));
  CHECK(fine.value.c == Approx(bearing_c).epsilon(0.05));
  // F0 high, c low: tanh takes from the force at low speed what c gives back.
  CHECK(coarse.value.F0 > fine.value.F0);
  CHECK(coarse.value.c < fine.value.c);
  REQUIRE(fine.subsets.size() == 1);
}

TEST_CASE("A smooth sign shifts the estimate by many standard errors, and the interval allows for it") {
  const Estimate e = with_width(noisy_record(), 0.0015);
  REQUIRE(e.outcome.ok());
  CHECK(std::abs(e.value.F0 - bearing_F0) > 5.0 * e.std->F0);
  CHECK(e.interval95->F0[0] < bearing_F0);
  CHECK(bearing_F0 < e.interval95->F0[1]);
  REQUIRE_FALSE(e.warnings.empty());
  CHECK(e.warnings[0].find("the intervals allow for it") != std::string::npos);
}

TEST_CASE("Too wide a sign makes it diverge, which is refused") {
  const Estimate e = with_width(noisy_record(), 0.05);
  CHECK_FALSE(e.outcome.ok());
  CHECK(e.reason.find("diverged") != std::string::npos);
}

TEST_CASE("The default width is good for a usable estimate of exact data") {
  Normal normal(1);
  const Estimate e = extended_kalman(
      record_of(
          {displacement_only(sampled(driven_bearing(bearing_c, bearing_F0, 4e-3), 10.0, 1000.0), 0.0, normal)}),
      bearing_constants, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.value.F0 == Approx(bearing_F0).epsilon(0.02));
  CHECK(e.value.c == Approx(bearing_c).epsilon(0.05));
  CHECK(extended_kalman(record_of({}), bearing_constants, {}).reason == "the record holds no time histories");
}
