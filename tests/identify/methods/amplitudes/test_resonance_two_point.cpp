#include "identify/methods/amplitudes/resonance_two_point.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("Table 2 of the paper") {
  TwoPointOptions options;
  options.pairs = {1, 4};
  const Estimate e = resonance_two_point(pairs(table_1), table_1_constants, options);
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  // From the six printed digits of Table 1: zeta = 0.5/(2 x 1.250066). The paper prints 0.199989, 3.99978 (which is
  // 20 x 0.199989, of the rounded zeta) and 2.0028.
  CHECK(e.value.zeta == Approx(0.25 / 1.250066).epsilon(1e-14));
  CHECK(e.value.zeta == Approx(0.19998944).margin(5e-9));
  CHECK(e.value.c == Approx(3.9997888).margin(5e-8));
  CHECK(e.value.F0 == Approx(2.00279).margin(5e-6));
  CHECK(e.value.x_f == Approx(e.value.F0 / 100.0).epsilon(1e-15));
  CHECK(e.used == std::vector<int>{1, 4});
  CHECK_FALSE(e.std.has_value());
  CHECK_FALSE(e.interval95.has_value());

  // The pairs of least and greatest input are the default.
  const Estimate chosen = resonance_two_point(pairs(table_1), table_1_constants, {});
  CHECK(chosen.value.F0 == e.value.F0);
  CHECK(chosen.used == e.used);
}

TEST_CASE("Eq (15) costs 2.75 % of the friction force at zeta = 0.2, and the estimate says so") {
  TwoPointOptions options;
  options.approximate_G = true;
  const Estimate e = resonance_two_point(pairs(table_1), table_1_constants, options);
  CHECK(e.value.zeta == Approx(0.19998944).margin(5e-9));
  CHECK(e.value.F0 == Approx(1.9449).margin(5e-5));
  CHECK(e.value.F0 / 2.0 - 1.0 == Approx(-0.0275).margin(5e-5));
  REQUIRE(e.warnings.size() == 1);
  CHECK(e.warnings[0].find("Eq (15)") != std::string::npos);
  INFO(e.warnings[0]);
  CHECK(e.warnings[0].find("F0 by -2.") != std::string::npos);
  // With the exact G the method errs by 0.14 % there, which is no warning.
  CHECK(resonance_two_point(pairs(table_1), table_1_constants, {}).warnings.empty());
}

TEST_CASE("Two pairs on a straight line return the line") {
  // The inverse of Eq (9) is exact for any zeta and x_f, at every scale of length: only rounding is left.
  for (const double zeta : {0.01, 0.2, 0.7}) {
    for (const double scale : {1e-150, 1e-3, 1.0, 1e150}) {
      const double x_f = 0.3 * scale;
      const double G = dualdamp::sim::analytic::den_hartog(zeta, 1.0).G;
      const auto x = [&](double Y) { return Y / (2.0 * zeta) - G * x_f; };
      const Estimate e = resonance_two_point(pairs({{1.0 * scale, x(1.0 * scale)}, {2.5 * scale, x(2.5 * scale)}}),
                                             {1.0, 100.0, 10.0}, {});
      CAPTURE(zeta, scale, e.reason);
      REQUIRE(e.outcome.ok());
      CHECK(e.value.zeta == Approx(zeta).epsilon(1e-13));
      CHECK(e.value.x_f == Approx(x_f).epsilon(1e-13));
    }
  }
}

TEST_CASE("Two-point standard errors follow Eqs (16) and (17)") {
  TwoPointOptions options;
  options.sigma_x = 2e-4;
  options.sigma_Y = 3e-4;
  const Estimate e = resonance_two_point(pairs(table_1), table_1_constants, options);
  REQUIRE(e.std.has_value());
  // Eq (16) with independent errors: sqrt(2 sigma_Y^2 + 2 (2 zeta sigma_x)^2)/(2 (x2 - x1)).
  const double zeta = e.value.zeta;
  const double expected = std::sqrt(2.0 * 9e-8 + 2.0 * 4.0 * zeta * zeta * 4e-8) / (2.0 * (1.436144 - 0.186078));
  CHECK(e.std->zeta == Approx(expected).epsilon(1e-13));
  CHECK(e.interval95->zeta[1] - e.interval95->zeta[0] == Approx(2.0 * 1.959963984540054 * expected).epsilon(1e-12));
  // Its middle is where the truth lies: the method reads the exact amplitudes of Table 1 as 0.19999, not 0.2.
  CHECK(0.5 * (e.interval95->zeta[0] + e.interval95->zeta[1]) == Approx(0.2).margin(1e-6));

  // The cloud of estimates from perturbed pairs: 40000 samples know a standard deviation to 0.35 % and a
  // correlation c to (1 - c^2)/200; four times that is allowed, plus the second order, (0.4 %)^2.
  Normal normal(5);
  Cloud cloud;
  for (int i = 0; i < 40000; ++i) {
    auto noisy = table_1;
    for (auto& [Y, x] : noisy) {
      Y += 3e-4 * normal();
      x += 2e-4 * normal();
    }
    const Estimate sample = resonance_two_point(pairs(noisy), table_1_constants, {});
    cloud.add(sample.value.zeta, sample.value.F0);
  }
  CHECK(std::sqrt(cloud.var_a()) == Approx(e.std->zeta).epsilon(0.015));
  CHECK(std::sqrt(cloud.var_b()) == Approx(e.std->F0).epsilon(0.015));
  const double correlation = cloud.covariance() / std::sqrt(cloud.var_a() * cloud.var_b());
  CHECK(*e.correlation == Approx(correlation).margin(4.0 * (1.0 - correlation * correlation) / 200.0 + 1e-4));
  CHECK((*e.covariance)(0, 1) == Approx(*e.correlation * e.std->zeta * e.std->F0).epsilon(1e-12));
}

TEST_CASE("Named pairs that cannot be used are refused with the reason") {
  const auto refused = [](const Record& record, int first, int second, const std::string& words) {
    TwoPointOptions options;
    options.pairs = {first, second};
    const Estimate e = resonance_two_point(record, table_1_constants, options);
    CHECK_FALSE(e.outcome.ok());
    CHECK_FALSE(e.usable);
    INFO(e.reason);
    CHECK(e.reason.find(words) != std::string::npos);
  };
  refused(pairs(table_1), 2, 2, "the same");
  refused(pairs(table_1), 1, 9, "pair 9");
  refused(pairs(table_1), 0, 3, "pair 0");
  refused(pairs({{0.1, 0.1}, {0.1, 0.3}, {0.2, 0.5}}), 1, 2, "input amplitudes are all equal");
  refused(pairs({{0.1, 0.3}, {0.3, 0.3}, {0.2, 0.5}}), 1, 2, "output amplitudes are all equal");
  refused(pairs({{0.1, 0.5}, {0.3, 0.3}, {0.2, 0.4}}), 1, 2, "does not grow");
  refused(pairs({{0.1, -0.5}, {0.3, 0.3}, {0.2, 0.4}}), 1, 2, "pair 1");
  // Points 1 and 4 say x_f = 0.02; an output below S x_f = 0.0225 m sticks.
  auto low = table_1;
  low.insert(low.begin(), {0.035, 0.015});
  refused(pairs(low), 1, 5, "pair 1 was named and sticks");
}

TEST_CASE("The outermost pairs are chosen among those that slide") {
  auto low = table_1;
  low.push_back({0.028, 0.006});
  const Estimate e = resonance_two_point(pairs(low), table_1_constants, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.used == std::vector<int>{1, 4});
  REQUIRE(e.excluded.size() == 1);
  CHECK(e.excluded[0].number == 5);
  CHECK(e.excluded[0].reason.find("sticks") != std::string::npos);
}

TEST_CASE("Pairs off the line through the two are told") {
  // Levels 1 and 5 of the reconstructed data; level 3 lies 1.34 mm below their line, 11.4 % of the 11.779 mm
  // between them.
  const Estimate bent = resonance_two_point(pairs(subset_trend), soft_spring, {});
  REQUIRE(bent.outcome.ok());
  CHECK_FALSE(bent.usable);
  CHECK(bent.reason.find("pair 3 lies off the line through the two by 11.4 %") != std::string::npos);
  // Of the lower four levels, the third lies 0.51 mm below: 6.7 % of 7.59 mm.
  const Estimate lower =
      resonance_two_point(pairs({subset_trend.begin(), subset_trend.begin() + 4}), soft_spring, {});
  CHECK(lower.usable);
  REQUIRE(lower.warnings.size() == 1);
  CHECK(lower.warnings[0].find("pair ") == 0);
  CHECK(resonance_two_point(pairs(table_1), table_1_constants, {}).warnings.empty());
}
