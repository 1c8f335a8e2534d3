#include "identify/statistics/lasting_part.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace dualdamp::identify;

TEST_CASE("The lasting part is the mean product of neighbours, over several signals, and has a bound") {
  LastingPart part;
  part.add(std::vector<double>{1.0, 2.0, 3.0});  // products 2 and 6, squares 14
  part.add(std::vector<double>{});
  part.add(std::vector<double>{2.0, -1.0, 4.0});  // products -2 and -4, squares 21
  CHECK(part.mean_product() == Approx(2.0 / 4.0).epsilon(1e-12));
  CHECK(part.correlation() == Approx((2.0 / 4.0) / (35.0 / 6.0)).epsilon(1e-12));
  // The product of two values of white noise has the deviation s^2, and the mean of four the half of it.
  CHECK(part.at_most(2.0) == Approx(0.5 + 3.0 * 4.0 / 2.0).epsilon(1e-12));

  LastingPart alternating;
  alternating.add(std::vector<double>{1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0});
  CHECK(alternating.correlation() == Approx(-1.0).epsilon(1e-12));
  CHECK(alternating.at_most(1.0) == Approx(3.0 / std::sqrt(9.0)).epsilon(1e-12));  // no part is below zero
  LastingPart nothing;
  nothing.add(std::vector<double>{0.0, 0.0});
  CHECK(nothing.correlation() == 0.0);
}
