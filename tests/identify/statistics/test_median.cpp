#include "identify/statistics/median.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("The upper median is one of the values") {
  CHECK(upper_median({3.0}) == 3.0);
  CHECK(upper_median({4.0, 1.0}) == 4.0);
  CHECK(upper_median({5.0, 1.0, 2.0}) == 2.0);
}

TEST_CASE("A tenth of outliers hardly moves the standard deviation from the median") {
  // With a share s of outliers the median is the quantile 0.5/(1 - s) of the magnitudes: 1.142 times the deviation
  // for s = 0.1. Four standard errors of a median of 10,000 magnitudes are 4.7 %.
  constexpr double deviation = 0.3;
  Normal normal(7);
  std::vector<double> magnitudes(10'000);
  for (double& magnitude : magnitudes) magnitude = std::abs(deviation * normal());
  CHECK(median_deviation(magnitudes) == Approx(deviation).epsilon(0.047));
  std::ranges::fill_n(magnitudes.begin(), 1000, 100.0);
  CHECK(median_deviation(magnitudes) == Approx(1.142 * deviation).epsilon(0.047));
}
