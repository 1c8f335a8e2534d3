#include "identify/statistics/distributions.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace dualdamp::identify;

TEST_CASE("Half widths of 95 % intervals are those of the tables") {
  CHECK(quantile95(1.0) == Approx(12.7062).epsilon(1e-5));
  CHECK(quantile95(2.0) == Approx(4.30265).epsilon(1e-5));
  CHECK(quantile95(10.0) == Approx(2.22814).epsilon(1e-5));
  CHECK(quantile95(std::numeric_limits<double>::infinity()) == Approx(1.959964).epsilon(1e-6));
  CHECK(normal95() == quantile95(std::numeric_limits<double>::infinity()));
}

TEST_CASE("The p-values of F tests are those of the tables") {
  CHECK(f_test_p_value(4.10282, 2.0, 10.0) == Approx(0.05).epsilon(1e-5));
  CHECK(f_test_p_value(10.0443, 1.0, 10.0) == Approx(0.01).epsilon(1e-5));
}

TEST_CASE("The scores of normal tests are those of the tables") {
  CHECK(normal_score(0.05) == Approx(1.959964).epsilon(1e-6));
  CHECK(normal_score(0.0026997960632601866) == Approx(3.0).epsilon(1e-9));
  CHECK(normal_score(1.0) == Approx(0.0).margin(1e-12));
  CHECK(normal_score(0.0) > 37.0);
}

TEST_CASE("The p-values of chi-square tests are those of the tables") {
  CHECK(chi_square_p_value(18.307, 10.0) == Approx(0.05).epsilon(1e-4));
  CHECK(chi_square_p_value(6.6349, 1.0) == Approx(0.01).epsilon(1e-4));
}

TEST_CASE("The p-values of small statistics are those of closed forms, and those of negative ones are 1") {
  CHECK(chi_square_p_value(0.2, 2.0) == Approx(std::exp(-0.1)).epsilon(1e-12));
  CHECK(f_test_p_value(0.2, 2.0, 10.0) == Approx(std::pow(1.0 + 2.0 * 0.2 / 10.0, -5.0)).epsilon(1e-12));
  CHECK(chi_square_p_value(-0.2, 2.0) == 1.0);
  CHECK(f_test_p_value(-0.2, 2.0, 10.0) == 1.0);
}

TEST_CASE("A statistic that is no number has no p-value, and an infinite one has zero") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(f_test_p_value(none, 1.0, 10.0)));
  CHECK(std::isnan(f_test_p_value(1.0, 1.0, 0.0)));
  CHECK(std::isnan(f_test_p_value(1.0, none, 10.0)));
  CHECK(f_test_p_value(infinity, 1.0, 10.0) == 0.0);
  CHECK(std::isnan(chi_square_p_value(none, 10.0)));
  CHECK(chi_square_p_value(infinity, 10.0) == 0.0);
}

TEST_CASE("A p-value below the smallest number is not written as zero") {
  CHECK(p_text(0.0123) == "p = 0.012");
  CHECK(p_text(f_test_p_value(1e300, 3.0, 400.0)) == "p < 1e-300");
}
