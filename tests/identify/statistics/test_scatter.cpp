#include "identify/statistics/scatter.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace dualdamp::identify;

TEST_CASE("A scatter that is too large or too small has twice the p-value of its side") {
  // A chi-square with two degrees of freedom is beyond x with the probability exp(-x/2).
  CHECK(stated_noise_p_value(3.0, 2.0) == Approx(2.0 * std::exp(-3.0)).epsilon(1e-12));
  CHECK(stated_noise_p_value(0.1, 2.0) == Approx(2.0 * (1.0 - std::exp(-0.1))).epsilon(1e-12));
  CHECK(stated_noise_p_value(std::log(2.0), 2.0) == Approx(1.0).epsilon(1e-12));  // the median
}

TEST_CASE("Readings contradict their stated noise where neither chance nor rounding of the statement explains it") {
  CHECK(scatter_beside_stated(1.5, stated_noise_p_value(1.5 * 1.5, 200.0)) == ScatterBesideStated::more);
  CHECK(scatter_beside_stated(0.6, stated_noise_p_value(0.6 * 0.6, 200.0)) == ScatterBesideStated::less);
  CHECK(scatter_beside_stated(1.5, stated_noise_p_value(1.5 * 1.5, 5.0)) ==
        ScatterBesideStated::as_stated);  // chance
  CHECK(scatter_beside_stated(1.2, stated_noise_p_value(1.2 * 1.2, 10000.0)) ==
        ScatterBesideStated::as_stated);  // near enough
  CHECK(scatter_beside_stated(0.8, stated_noise_p_value(0.8 * 0.8, 10000.0)) == ScatterBesideStated::as_stated);
}
