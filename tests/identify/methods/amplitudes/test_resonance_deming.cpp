#include "identify/methods/amplitudes/resonance_deming.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "identify/methods/amplitudes/line_estimate.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;

namespace {

constexpr double line_zeta = 0.12;
constexpr double line_x_f = 2.5e-3;

/// Sweeps of five levels over the paper's range, on the straight line, with errors of both amplitudes.
std::vector<std::pair<double, double>> noisy_line(Normal& normal, double sigma_x, double sigma_Y, int count = 25) {
  const double G = analytic::den_hartog(line_zeta, 1.0).G;
  std::vector<std::pair<double, double>> list;
  for (int i = 0; i < count; ++i) {
    const double Y = 4.45e-3 + 0.575e-3 * (i % 5);
    list.emplace_back(Y + sigma_Y * normal(), Y / (2.0 * line_zeta) - G * line_x_f + sigma_x * normal());
  }
  return list;
}

}  // namespace

TEST_CASE("Errors of the input bias the least-squares line and not Deming's") {
  // The least-squares slope is attenuated by 1/(1 + sigma_Y^2/var Y), var Y = 2 (0.575 mm)^2 = 0.661 mm^2: 1.5 %
  // for 0.1 mm, 6.05 % for 0.2 mm, and the intercept on the Y axis with it, F0 by -1.1 % and -4.4 %, up to 3/n of
  // that for n = 100 pairs. The mean of 1000 samples is known to 0.05 % and 0.1 % here.
  struct Case {
    double sigma_Y, zeta_bias, F0_bias, margin;
  };
  for (const Case& c : {Case{0.1e-3, 0.0151, -0.0114, 0.002}, Case{0.2e-3, 0.0605, -0.044, 0.005}}) {
    LineOptions options;
    options.sigma_x = 0.05e-3;
    options.sigma_Y = c.sigma_Y;
    Normal normal(3);
    Cloud ordinary;
    Cloud deming;
    constexpr int samples = 1000;
    for (int i = 0; i < samples; ++i) {
      const Record record = pairs(noisy_line(normal, options.sigma_x, options.sigma_Y, 100));
      const Estimate line = resonance_least_squares(record, at_resonance, options);
      const Estimate both = resonance_deming(record, at_resonance, options);
      REQUIRE(line.outcome.ok());
      REQUIRE(both.outcome.ok());
      ordinary.add(line.value.zeta / line_zeta - 1.0, line.value.x_f / line_x_f - 1.0);
      deming.add(both.value.zeta / line_zeta - 1.0, both.value.x_f / line_x_f - 1.0);
    }
    CAPTURE(c.sigma_Y);
    CHECK(ordinary.mean_a == Approx(c.zeta_bias).margin(c.margin));
    CHECK(ordinary.mean_b == Approx(c.F0_bias).margin(c.margin));
    CHECK(std::abs(deming.mean_a) < c.margin);
    CHECK(std::abs(deming.mean_b) < c.margin);
  }
}

TEST_CASE("Standard errors and intervals of Deming's line hold in a Monte Carlo experiment") {
  // The covariance is that for large samples; its next term is of relative order 1/n = 4 %. 6000 samples know a
  // standard deviation to 0.9 %, a coverage of 95 % to 0.3 %.
  LineOptions options;
  options.sigma_x = 0.2e-3;
  options.sigma_Y = 0.1e-3;
  Normal normal(8);
  Cloud cloud;
  double variance_zeta = 0.0, variance_F0 = 0.0;
  int covered_zeta = 0, covered_F0 = 0;
  constexpr int samples = 6000;
  for (int i = 0; i < samples; ++i) {
    const Estimate e =
        resonance_deming(pairs(noisy_line(normal, options.sigma_x, options.sigma_Y)), at_resonance, options);
    REQUIRE(e.covariance.has_value());
    cloud.add(e.value.zeta, e.value.F0);
    variance_zeta += (*e.covariance)(0, 0) / samples;
    variance_F0 += (*e.covariance)(1, 1) / samples;
    covered_zeta += e.interval95->zeta[0] < line_zeta && line_zeta < e.interval95->zeta[1];
    covered_F0 += e.interval95->F0[0] < 1568.0 * line_x_f && 1568.0 * line_x_f < e.interval95->F0[1];
  }
  CHECK(std::sqrt(variance_zeta) == Approx(std::sqrt(cloud.var_a())).epsilon(0.04));
  CHECK(std::sqrt(variance_F0) == Approx(std::sqrt(cloud.var_b())).epsilon(0.04));
  CHECK(covered_zeta / double(samples) == Approx(0.95).margin(0.015));
  CHECK(covered_F0 / double(samples) == Approx(0.95).margin(0.015));
}

TEST_CASE("Deming's line is the most likely one") {
  // It minimises sum (x - a - b Y)^2/(lambda + b^2): no line beside it is better.
  Normal normal(5);
  Moments moments;
  std::vector<std::pair<double, double>> list;
  for (int i = 0; i < 12; ++i) {
    list.emplace_back(1.0 + 0.2 * i + 0.1 * normal(), -2.0 + 0.8 * i + 0.3 * normal());
    moments.add(list.back().first, list.back().second);
  }
  for (const double lambda : {0.0, 0.3, 9.0, 400.0}) {
    CAPTURE(lambda);
    const Line line = line_of(moments, lambda).value();
    const auto cost = [&](double a, double b) {
      double sum = 0.0;
      for (const auto& [Y, x] : list) sum += (x - a - b * Y) * (x - a - b * Y);
      return sum / (lambda + b * b);
    };
    const double least = cost(line.intercept, line.slope);
    for (const double da : {-1e-3, 0.0, 1e-3})
      for (const double db : {-1e-3, 0.0, 1e-3})
        if (da != 0.0 || db != 0.0) CHECK(cost(line.intercept + da, line.slope + db) > least);
  }
  // The limit of errors in x alone.
  CHECK(line_of(moments, 1e12)->slope == Approx(moments.S_xY / moments.S_YY).epsilon(1e-9));
  CHECK(line_of(moments, INFINITY)->slope == moments.S_xY / moments.S_YY);
}

TEST_CASE("Known errors of one amplitude alone give the regression on the other") {
  Normal normal(6);
  const Record record = pairs(noisy_line(normal, 0.2e-3, 0.1e-3));
  LineOptions of_x;
  of_x.sigma_x = 0.1e-3;
  const Estimate line = resonance_least_squares(record, at_resonance, of_x);
  const Estimate same = resonance_deming(record, at_resonance, of_x);
  CHECK(same.value.zeta == line.value.zeta);
  CHECK(same.std->F0 == Approx(line.std->F0).epsilon(1e-14));
  LineOptions of_Y;
  of_Y.sigma_Y = 0.1e-3;
  Moments moments;
  for (const Pair& pair : record.pairs->pairs) moments.add(pair.Y, pair.x);
  CHECK(resonance_deming(record, at_resonance, of_Y).value.zeta ==
        Approx(0.5 * moments.S_xY / moments.S_xx).epsilon(1e-12));
}

TEST_CASE("Without known errors input and output are treated alike") {
  // Errors by the same fraction in both: the line does not depend on which amplitude is called the output.
  Normal normal(7);
  Moments straight;
  Moments swapped;
  for (const auto& [Y, x] : noisy_line(normal, 0.3e-3, 0.1e-3)) {
    straight.add(Y, x);
    swapped.add(x, Y);
  }
  const double ratio = straight.mean_x / straight.mean_Y;
  const double slope = line_of(straight, ratio * ratio)->slope;
  CHECK(line_of(swapped, 1.0 / (ratio * ratio))->slope == Approx(1.0 / slope).epsilon(1e-12));
  Normal again(7);
  CHECK(resonance_deming(pairs(noisy_line(again, 0.3e-3, 0.1e-3)), at_resonance, {}).value.zeta ==
        Approx(0.5 / slope).epsilon(1e-12));
}

TEST_CASE("Pairs on a straight line return the line, the reconstructed pairs are not usable") {
  Normal none(1);
  const Estimate e = resonance_deming(pairs(noisy_line(none, 0.0, 0.0)), at_resonance, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.value.zeta == Approx(line_zeta).epsilon(1e-13));
  CHECK(e.value.x_f == Approx(line_x_f).epsilon(1e-13));
  CHECK(e.usable);
  const Estimate bent = resonance_deming(pairs(subset_trend), soft_spring, {});
  CHECK_FALSE(bent.usable);
  CHECK(bent.lack_of_fit->fired);
}
