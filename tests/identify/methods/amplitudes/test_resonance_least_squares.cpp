#include "identify/methods/amplitudes/resonance_least_squares.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "identify/methods/amplitudes/resonance_deming.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;
using std::numbers::pi;

namespace {

/// Pairs of the exact Eq (3), on both sides of the mean level as the caller lists them.
Record exact_pairs(double zeta, double r, double x_f, const std::vector<double>& levels) {
  std::vector<std::pair<double, double>> list;
  for (const double Y : levels)
    list.emplace_back(Y, analytic::amplitude(analytic::den_hartog(zeta, r), Y, x_f).value());
  return pairs(list);
}

KnownConstants constants_at(double r) { return {1.0, 100.0, 10.0 * r}; }

}  // namespace

TEST_CASE("The paper's fits of all, 4/5, 3/5 and 2/5 of its data") {
  const Estimate e = resonance_least_squares(pairs(subset_trend), soft_spring, {});
  REQUIRE(e.outcome.ok());
  REQUIRE(e.subsets.size() == 4);
  // zeta as printed, 0.0987, 0.114, 0.126, 0.142, and one digit more; F0 as printed with one digit more.
  const double zeta[] = {0.0987, 0.1136, 0.1263, 0.1419};
  const double F0[] = {4.391, 4.118, 3.912, 3.689};
  const char* const labels[] = {"5/5", "4/5", "3/5", "2/5"};
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(e.subsets[i].label == labels[i]);
    CHECK(e.subsets[i].used == 5 - static_cast<int>(i));
    // The levels are given to 0.5 um over a span of 0.575 to 2.3 mm, x alike: up to 0.1 % of the slope.
    CHECK(e.subsets[i].value.zeta == Approx(zeta[i]).margin(1.5e-4));
    CHECK(e.subsets[i].value.F0 == Approx(F0[i]).margin(5e-3));
    CHECK(e.subsets[i].value.c == Approx(2.0 * e.subsets[i].value.zeta * std::sqrt(1.042 * 1568.0)).epsilon(1e-13));
  }
  CHECK(e.value.zeta == e.subsets[0].value.zeta);
  CHECK(e.excluded.empty());  // not the foot of the stick-slip curve: Y/x_f is above its 1.59 throughout

  // Y over x against a line, by the normal equations with no code of ours: F = 288.92 with 1 and 2 degrees of
  // freedom, p = 1 - sqrt(F/(F + 2)) = 0.00344. What the exact law departs from its line moves F by 0.3 %.
  REQUIRE(e.lack_of_fit.has_value());
  CHECK(e.lack_of_fit->freedom == 2);
  CHECK(e.lack_of_fit->statistic == Approx(288.92).epsilon(0.01));
  CHECK(e.lack_of_fit->p_value ==
        Approx(1.0 - std::sqrt(e.lack_of_fit->statistic / (e.lack_of_fit->statistic + 2.0))).epsilon(1e-9));
  CHECK(e.lack_of_fit->p_value < 0.01);
  CHECK(e.lack_of_fit->fired);
  CHECK_FALSE(e.usable);
  CHECK(mentions(e.reason, "straight line"));
}

TEST_CASE("The test for curvature keeps its level with errors of x and of Y") {
  // Pairs of the exact law, so that every alarm is a false one. The test regresses Y on x, whose errors flatten the
  // line by sigma_x^2/var(x) and bend it by as much: 1e-3 at 0.1 mm over a spread of 3.4 mm, nothing beside a
  // residual that is 1/30 of the spread. 4000 samples know 5 % to 0.34 %; four times that is allowed.
  const double r = 38.79 / std::sqrt(1568.0 / 1.042);
  const std::vector<double> levels = {4.45e-3, 5.03e-3, 5.6e-3, 6.18e-3, 6.75e-3};
  const analytic::DenHartog law = analytic::den_hartog(0.12, r);
  Normal normal(29);
  constexpr int samples = 4000;
  for (const double sigma_Y : {0.0, 20e-6})
    for (const double sigma_x : {20e-6, 50e-6, 100e-6})
      for (const int sweeps : {1, 2, 10}) {
        int fired = 0, deming = 0;
        for (int i = 0; i < samples; ++i) {
          std::vector<std::pair<double, double>> list;
          for (int j = 0; j < sweeps; ++j)
            for (const double Y : levels)
              list.emplace_back(Y + sigma_Y * normal(), *analytic::amplitude(law, Y, 2.36e-3) + sigma_x * normal());
          fired += resonance_least_squares(pairs(list), soft_spring, {}).lack_of_fit->p_value < 0.05;
          deming += resonance_deming(pairs(list), soft_spring, {}).lack_of_fit->p_value < 0.05;
        }
        CAPTURE(sigma_Y, sigma_x, sweeps);
        CHECK(fired / double(samples) == Approx(0.05).margin(0.014));
        CHECK(deming / double(samples) == Approx(0.05).margin(0.014));
      }
}

TEST_CASE("G at the paper's estimates") {
  const double zeta[] = {0.0987, 0.114, 0.126, 0.142};
  const double G[] = {6.4546, 5.5896, 5.0583, 4.4897};
  for (int i = 0; i < 4; ++i) CHECK(analytic::den_hartog(zeta[i], 1.0).G == Approx(G[i]).margin(5e-5));
  // The force is (pi/4) k times the intercept on the input axis, in which zeta and G cancel: within 0.3 % here.
  const Estimate e = resonance_least_squares(pairs(subset_trend), soft_spring, {});
  CHECK(e.value.F0 == Approx(pi / 4.0 * 1568.0 * -e.line->intercept / e.line->slope).epsilon(3e-3));
}

TEST_CASE("Pairs on a straight line return the line") {
  const double zeta = 0.12, x_f = 0.004;
  const double G = analytic::den_hartog(zeta, 1.0).G;
  std::vector<std::pair<double, double>> list;
  for (const double Y : {0.05, 0.01, 0.03, 0.02, 0.04}) list.emplace_back(Y, Y / (2.0 * zeta) - G * x_f);
  const Estimate e = resonance_least_squares(pairs(list), constants_at(1.0), {});
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.value.zeta == Approx(zeta).epsilon(1e-13));
  CHECK(e.value.x_f == Approx(x_f).epsilon(1e-13));
  CHECK(e.line->residual_deviation < 1e-15);
  // Nothing but rounding is left in the residuals, so no test of them may fire.
  REQUIRE(e.lack_of_fit.has_value());
  CHECK_FALSE(e.lack_of_fit->fired);
  CHECK(e.lack_of_fit->p_value > 0.05);
  CHECK(e.used == std::vector<int>{1, 2, 3, 4, 5});
}

TEST_CASE("Standard errors, correlation and intervals hold in a Monte Carlo experiment") {
  // Straight-line data with normal errors of x: the covariance of the line is exact and that of (zeta, F0) follows
  // to first order in std(zeta)/zeta = 1 %, so it errs by about 1e-4. 20000 samples know a standard deviation to
  // 1/sqrt(40000) = 0.5 %; three times that is allowed. The coverage of a 95 % interval is known to 0.15 %.
  const double zeta = 0.12, x_f = 2.5e-3, sigma = 5e-5;
  const KnownConstants constants{1.042, 1568.0, std::sqrt(1568.0 / 1.042)};
  const double G = analytic::den_hartog(zeta, 1.0).G;
  const std::vector<double> levels = {4.45e-3, 5.03e-3, 5.6e-3, 6.18e-3, 6.75e-3, 5.0e-3};
  Normal normal(17);
  Cloud cloud;
  double mean_variance_zeta = 0.0, mean_variance_F0 = 0.0, mean_covariance = 0.0;
  int covered_zeta = 0, covered_F0 = 0;
  constexpr int samples = 20000;
  Estimate e;
  for (int i = 0; i < samples; ++i) {
    std::vector<std::pair<double, double>> list;
    for (const double Y : levels) list.emplace_back(Y, Y / (2.0 * zeta) - G * x_f + sigma * normal());
    e = resonance_least_squares(pairs(list), constants, {});
    REQUIRE(e.covariance.has_value());
    cloud.add(e.value.zeta, e.value.F0);
    mean_variance_zeta += (*e.covariance)(0, 0) / samples;
    mean_variance_F0 += (*e.covariance)(1, 1) / samples;
    mean_covariance += (*e.covariance)(0, 1) / samples;
    covered_zeta += e.interval95->zeta[0] < zeta && zeta < e.interval95->zeta[1];
    covered_F0 += e.interval95->F0[0] < 1568.0 * x_f && 1568.0 * x_f < e.interval95->F0[1];
  }
  CHECK(std::sqrt(mean_variance_zeta) == Approx(std::sqrt(cloud.var_a())).epsilon(0.02));
  CHECK(std::sqrt(mean_variance_F0) == Approx(std::sqrt(cloud.var_b())).epsilon(0.02));
  CHECK(mean_covariance == Approx(cloud.covariance()).epsilon(0.03));
  CHECK(covered_zeta / double(samples) == Approx(0.95).margin(0.006));
  CHECK(covered_F0 / double(samples) == Approx(0.95).margin(0.006));
  // The two errors are nearly one error: a steeper line has a lower intercept.
  CHECK(*e.correlation < -0.9);

  // Small-zeta forms: std(zeta) = 2 zeta^2 s/sqrt(S_YY), std(F0) = (pi/4)(k s/b) sqrt(1/n + (mean Y -
  // Y_int)^2/S_YY), the first exact, the second up to terms of order zeta^2.
  double mean_Y = 0.0, S_YY = 0.0;
  for (const double Y : levels) mean_Y += Y / static_cast<double>(levels.size());
  for (const double Y : levels) S_YY += (Y - mean_Y) * (Y - mean_Y);
  const double s = e.line->residual_deviation;
  const double from_intercept = mean_Y + e.line->intercept / e.line->slope;
  CHECK(e.std->zeta == Approx(2.0 * e.value.zeta * e.value.zeta * s / std::sqrt(S_YY)).epsilon(1e-12));
  CHECK(e.std->F0 ==
        Approx(pi / 4.0 * 1568.0 * s / e.line->slope *
               std::sqrt(1.0 / static_cast<double>(levels.size()) + from_intercept * from_intercept / S_YY))
            .epsilon(2.0 * zeta * zeta));
}

TEST_CASE("Known measurement deviations replace the scatter") {
  LineOptions options;
  options.sigma_x = 1e-4;
  options.sigma_Y = 2e-5;
  // Two pairs leave no freedom, and have standard errors all the same: those of the two-point method.
  const Estimate e = resonance_least_squares(pairs({table_1[0], table_1[3]}), table_1_constants, options);
  REQUIRE(e.std.has_value());
  const double b = e.line->slope;
  const double dY = 0.5;
  CHECK(e.std->zeta ==
        Approx(2.0 * e.value.zeta * e.value.zeta * std::sqrt(1e-8 + b * b * 4e-10) * std::sqrt(2.0) / dY)
            .epsilon(1e-12));
  CHECK_FALSE(resonance_least_squares(pairs({table_1[0], table_1[3]}), table_1_constants, {}).std.has_value());
}

TEST_CASE("Pairs that scatter more than the stated deviations say are told") {
  Normal normal(6);
  std::vector<std::pair<double, double>> list;
  for (int sweep = 0; sweep < 3; ++sweep)
    for (const double Y : {4.0, 4.4, 4.8, 5.2, 5.6, 6.0, 6.4, 6.8})
      list.emplace_back(Y, 5.0 * (Y - 2.4) + 0.1 * normal());
  const auto said = [&](double sigma_x) {
    LineOptions options;
    options.sigma_x = sigma_x;
    const Estimate e = resonance_least_squares(pairs(list), constants_at(1.0), options);
    return std::ranges::count_if(e.warnings,
                                 [](const std::string& w) { return mentions(w, "the readings scatter"); });
  };
  CHECK(said(0.05) == 1);
  CHECK(said(0.1) == 0);
  CHECK(said(1.0) == 0);
  CHECK(said(0.0) == 0);
}

TEST_CASE("Pairs that stick are left out") {
  // zeta = 0.142 sticks below Y/x_f = 1.588, x/x_f = 1.090. There the true curve has a foot above the line: x =
  // 0.20 x_f at Y = 1.28 x_f, and it meets the line at the boundary. The foot is drawn here as a straight piece
  // between the two.
  const double zeta = 0.142, x_f = 1e-3;
  const analytic::DenHartog d = analytic::den_hartog(zeta, 1.0);
  const double Y_b = x_f / analytic::non_sticking_boundary(d);
  const double x_b = analytic::non_sticking_limit(d) * x_f;
  std::vector<std::pair<double, double>> list;
  for (const double Y : {1.28e-3, 1.4e-3, 1.5e-3}) {
    list.emplace_back(Y, 0.2e-3 + (x_b - 0.2e-3) * (Y - 1.28e-3) / (Y_b - 1.28e-3));
  }
  for (const double Y : {1.65e-3, 2.0e-3, 2.5e-3, 3.0e-3, 3.5e-3})
    list.emplace_back(Y, analytic::amplitude(d, Y, x_f).value());
  const Estimate e = resonance_least_squares(pairs(list), constants_at(1.0), {});
  REQUIRE(e.outcome.ok());
  REQUIRE(e.excluded.size() == 3);
  for (int i = 0; i < 3; ++i) {
    CHECK(e.excluded[static_cast<std::size_t>(i)].number == i + 1);
    CHECK(mentions(e.excluded[static_cast<std::size_t>(i)].reason, "sticks"));
  }
  CHECK(e.used == std::vector<int>{4, 5, 6, 7, 8});
  // What is left are exact pairs: the neglected H alone, about zeta/(2 pi) in places of Y near the boundary.
  CHECK(e.value.zeta == Approx(zeta).epsilon(5e-3));
  CHECK(e.value.x_f == Approx(x_f).epsilon(1e-2));
}

TEST_CASE("Fewer than two sliding pairs are no estimate") {
  const Record record = pairs({{1.30e-3, 0.25e-3}, {1.35e-3, 0.40e-3}, {1.40e-3, 0.52e-3}});
  const Estimate e = resonance_least_squares(record, constants_at(1.0), {});
  CHECK_FALSE(e.outcome.ok());
  CHECK_FALSE(e.usable);
  CHECK(e.excluded.size() >= 2);
  CHECK(mentions(e.reason, "two pairs are needed"));
  CHECK(mentions(e.reason, "pair 1: the mass sticks"));
}

TEST_CASE("The gate ends, and leaves no sticking pair, whatever the record") {
  Normal normal(23);
  int with_friction = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<std::pair<double, double>> list;
    const int count = 2 + trial % 12;
    for (int i = 0; i < count; ++i) {
      const double Y = 1.0 + 0.8 * std::abs(normal());
      list.emplace_back(Y, std::abs(3.0 * (Y - 0.8) + normal()));
    }
    const Estimate e = resonance_least_squares(pairs(list), constants_at(1.0), {});
    CHECK(e.used.size() + e.excluded.size() <= list.size());
    if (!e.outcome.ok()) continue;
    CHECK(e.used.size() + e.excluded.size() == list.size());
    if (e.value.x_f <= 0.0) continue;
    ++with_friction;
    const double limit = analytic::non_sticking_limit(analytic::den_hartog(e.value.zeta, 1.0)) * e.value.x_f;
    for (const int number : e.used) CHECK(list[static_cast<std::size_t>(number - 1)].second > limit);
  }
  CHECK(with_friction > 200);
}

TEST_CASE("Detuning is told, in size and sign") {
  // Exact pairs at w = r wn, zeta = 0.12, read by the method. The diagnostic is computed at the estimate, the truth
  // is at the true parameters: they agree to the square of the error.
  const double zeta = 0.12, x_f = 2.36e-3;
  const std::vector<double> levels = {4.45e-3, 5.03e-3, 5.6e-3, 6.18e-3, 6.75e-3};
  struct Case {
    double delta, zeta_error, x_f_error;
    bool usable;
  };
  // Errors of the method, zeta and x_f, from the same pairs by independent arithmetic (numpy). The friction force
  // forgives more than the damping ratio.
  for (const Case& c : {Case{-0.05, 0.016842, -0.036727, true}, Case{-0.01, -0.006611, -0.003232, true},
                        Case{0.0, -0.000533, 0.001437, true}, Case{0.01, 0.010414, 0.004652, true},
                        Case{0.02, 0.026156, 0.006500, true}, Case{0.1, 0.300781, -0.011289, false}}) {
    const double r = 1.0 + c.delta;
    const Estimate e = resonance_least_squares(exact_pairs(zeta, r, x_f, levels), constants_at(r), {});
    CAPTURE(c.delta, e.reason);
    REQUIRE(e.outcome.ok());
    CHECK(e.value.zeta / zeta - 1.0 == Approx(c.zeta_error).margin(1e-6));
    CHECK(e.value.x_f / x_f - 1.0 == Approx(c.x_f_error).margin(1e-6));
    CHECK(e.usable == c.usable);
    const bool large = std::max(std::abs(c.zeta_error), std::abs(c.x_f_error)) > 0.01;
    const bool told = !e.usable || !e.warnings.empty();
    CHECK(told == large);
  }
}

TEST_CASE("A damping ratio of 0.02 does not forgive a detuning of 2 %") {
  // The scale of the error is detuning over zeta.
  const Estimate e =
      resonance_least_squares(exact_pairs(0.02, 1.02, 0.1, {0.4, 0.5, 0.6, 0.7, 0.8}), constants_at(1.02), {});
  CHECK(std::abs(e.value.zeta / 0.02 - 1.0) > 0.3);
  CHECK_FALSE(e.usable);
  CHECK(mentions(e.reason, "w/wn = 1.02"));
}

TEST_CASE("Pairs that allow no estimate are refused with the reason") {
  const auto refused = [](const Record& record, const KnownConstants& constants, const std::string& words) {
    const Estimate e = resonance_least_squares(record, constants, {});
    CHECK_FALSE(e.outcome.ok());
    CHECK_FALSE(e.usable);
    INFO(e.reason);
    CHECK(mentions(e.reason, words));
    CHECK(e.reason == e.outcome.reason);
  };
  const KnownConstants fine = constants_at(1.0);
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  refused(Record{}, fine, "no x-Y pairs");
  refused(extremes({1.0, -0.5, 0.2}), fine, "no x-Y pairs");
  refused(pairs({}), fine, "no x-Y pairs");
  refused(pairs({{0.1, 0.2}}), fine, "of 1 in the record 1 is left");
  refused(pairs({{0.1, 0.2}, {0.1, 0.3}, {0.1, 0.4}}), fine, "input amplitudes are all equal");
  refused(pairs({{0.1, 0.2}, {0.2, 0.2}, {0.3, 0.2}}), fine, "output amplitudes are all equal");
  refused(pairs({{0.1, 0.4}, {0.2, 0.3}, {0.3, 0.2}}), fine, "does not grow");
  refused(pairs({{nan, 0.4}, {0.2, inf}, {0.3, 0.2}}), fine, "1 is left");
  refused(pairs({{0.0, 0.0}, {0.2, 0.0}, {-0.3, 0.2}, {0.3, 0.4}}), fine, "1 is left");
  refused(pairs({{0.1, 0.2}, {0.2, 0.5}}), {0.0, 100.0, 10.0}, "mass");
  refused(pairs({{0.1, 0.2}, {0.2, 0.5}}), {1.0, nan, 10.0}, "stiffness");
  refused(pairs({{0.1, 0.2}, {0.2, 0.5}}), {1.0, 100.0, 0.0}, "near resonance");
  refused(pairs({{0.1, 0.2}, {0.2, 0.5}}), {1.0, 100.0, 21.0}, "near resonance");
  refused(pairs({{0.1, 0.2}, {0.2, 0.5}}), {1.0, 100.0, nan}, "needs the forcing frequency");
  refused(pairs({{1e300, 1e-300}, {2e300, 2e-300}}), fine, "does not grow");
}

TEST_CASE("Data left out for their own sake are named") {
  auto list = table_1;
  list.emplace_back(0.3, std::nan(""));
  list.emplace_back(0.3, -0.7);
  const Estimate e = resonance_least_squares(pairs(list), table_1_constants, {});
  REQUIRE(e.outcome.ok());
  REQUIRE(e.excluded.size() == 2);
  CHECK(e.excluded[0].number == 5);
  CHECK(mentions(e.excluded[0].reason, "not finite"));
  CHECK(mentions(e.excluded[1].reason, "negative"));
  CHECK(e.used == std::vector<int>{1, 2, 3, 4});
}

TEST_CASE("A friction force that came out negative is not usable, one of no size gets a warning") {
  const Estimate negative =
      resonance_least_squares(pairs({{0.1, 0.35}, {0.2, 0.6}, {0.3, 0.85001}}), constants_at(1.0), {});
  REQUIRE(negative.outcome.ok());
  CHECK(negative.value.F0 < 0.0);
  CHECK_FALSE(negative.usable);
  CHECK(mentions(negative.reason, "Coulomb friction came out negative"));

  const Estimate none =
      resonance_least_squares(pairs({{0.1, 0.25}, {0.2, 0.5}, {0.3, 0.75}}), constants_at(1.0), {});
  CHECK(none.usable);  // rounding alone made the sign
  CHECK(std::abs(none.value.F0) < 1e-12);

  const Estimate noisy = resonance_least_squares(pairs({{0.1, 0.251}, {0.2, 0.498}, {0.3, 0.752}, {0.4, 0.999}}),
                                                 constants_at(1.0), {});
  CHECK(noisy.usable);
  REQUIRE_FALSE(noisy.warnings.empty());
  CHECK(mentions(noisy.warnings[0], "cannot be distinguished from zero"));
}

TEST_CASE("A million pairs, which a quadratic method would take hours for") {
  std::vector<std::pair<double, double>> list;
  Normal normal(29);
  for (int i = 0; i < 1'000'000; ++i) {
    const double Y = 1.0 + 1e-6 * i;
    list.emplace_back(Y, 4.0 * Y - 3.2 + 0.2 * normal());
  }
  const Record record = pairs(list);
  const Estimate e = resonance_least_squares(record, constants_at(1.0), {});
  REQUIRE(e.outcome.ok());
  // The pairs left out for sticking are those with the lowest outputs, which steals from the lower end of the
  // scatter.
  CHECK(e.value.zeta == Approx(0.125).epsilon(0.1));
}
