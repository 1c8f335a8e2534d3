#include "identify/methods/histories/random_decrement.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/identify/estimates.hpp"
#include "tests/identify/random_response.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("Without dry friction the mean of the stretches is a free decay") {
  const double c = 8.0;
  const double zeta = c / (2.0 * std::sqrt(1.042 * 1568.0));
  const Estimate e = random_decrement(record_of({random_response(c, 0.0, 0.7, 600.0, 1)}), bearing_constants);
  REQUIRE(e.outcome.ok());
  // Conditional mean of a Gaussian process. A hundred independent stretches a band leave 10 % of the amplitude.
  CHECK(further(e, "equivalent_damping_ratio").value == Approx(zeta).epsilon(0.2));
  CHECK_FALSE(e.usable);
}

TEST_CASE("With dry friction it reads an equivalent damping and does not separate the two: never usable") {
  const double c = 5.0;
  const double F0 = 2.0;
  const double zeta = c / (2.0 * std::sqrt(1.042 * 1568.0));
  const Estimate e = random_decrement(record_of({random_response(c, F0, 0.7, 600.0, 2)}), bearing_constants);
  REQUIRE(e.outcome.ok());
  CHECK_FALSE(e.usable);
  CHECK(e.reason.find("does not separate") != std::string::npos);
  CHECK(further(e, "equivalent_damping_ratio").value > 1.3 * zeta);
  CHECK(e.value.zeta > 1.3 * zeta);
  CHECK(e.value.F0 < 0.5 * F0);
  CHECK(e.curves.size() == 2);
  CHECK_FALSE(e.interval95);
  REQUIRE(e.warnings.size() == 1);
  CHECK(e.warnings[0].find("no interval is claimed") != std::string::npos);
}

TEST_CASE("A random decrement of few extremes is refused") {
  const Estimate e = random_decrement(record_of({random_response(5.0, 1.0, 0.7, 5.0, 2)}), bearing_constants);
  CHECK_FALSE(e.outcome.ok());
}
