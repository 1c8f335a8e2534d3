#include "identify/methods/amplitudes/resonance_within_sweep.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;

namespace {

constexpr double sweep_zeta = 0.0987;
constexpr double sweep_x_f = 2.2e-3;  // the lowest level is far from sticking whatever the drift

/// The levels of one experiment: ten sweeps of five, set by hand to 0.058 mm.
std::vector<std::vector<double>> levels_of(Normal& normal) {
  std::vector<std::vector<double>> levels(10);
  for (auto& sweep : levels)
    for (int i = 0; i < 5; ++i) sweep.push_back(4.45e-3 + 0.575e-3 * i + 0.058e-3 * normal());
  return levels;
}

/// Straight lines, one for each sweep: a drifting friction, errors of x, a curvature if asked for.
Record measured_sweeps(const std::vector<std::vector<double>>& levels, const std::vector<double>& friction,
                       double sigma, double curvature, Normal& normal) {
  const double G = analytic::den_hartog(sweep_zeta, 1.0).G;
  PairRecord record;
  for (std::size_t j = 0; j < levels.size(); ++j)
    for (const double Y : levels[j]) {
      const double bend = curvature * (Y - 5.6e-3) * (Y - 5.6e-3);
      record.pairs.push_back({Y, Y / (2.0 * sweep_zeta) - G * friction[j] + bend + sigma * normal(),
                              std::string(1, static_cast<char>('a' + j)),
                              static_cast<int>(record.pairs.size()) + 1});
    }
  return {record, std::nullopt};
}

std::vector<double> drift_of(Normal& normal, double deviation) {
  std::vector<double> friction(10);
  for (double& value : friction) value = sweep_x_f + deviation * normal();
  return friction;
}

}  // namespace

TEST_CASE("Drift between sweeps halves what zeta is known to, and parallel lines restore it") {
  // x_f drifts by 0.15 mm from sweep to sweep; errors of x of 0.045 mm. With the levels as they are the variance of
  // a slope is sigma^2/S within the sweeps, and for one line through all
  //   sigma^2/S_YY + (G sd(x_f))^2 sum_j (5 (mean_j Y - mean Y))^2/S_YY^2,
  // which gives sd(zeta) = 2 zeta^2 sd(b) of about 1.5e-4 and 2.8e-4. 3000 samples know them to 1.3 %.
  Normal normal(31);
  const auto levels = levels_of(normal);
  const double G = analytic::den_hartog(sweep_zeta, 1.0).G;
  constexpr double sigma = 0.045e-3, deviation = 0.15e-3;
  double mean = 0.0, within = 0.0, all = 0.0, lever = 0.0;
  for (const auto& sweep : levels)
    for (const double Y : sweep) mean += Y / 50.0;
  for (const auto& sweep : levels) {
    double own = 0.0;
    for (const double Y : sweep) own += Y / 5.0;
    for (const double Y : sweep) {
      within += (Y - own) * (Y - own);
      all += (Y - mean) * (Y - mean);
    }
    lever += 25.0 * (own - mean) * (own - mean);
  }
  const double sd_within = 2.0 * sweep_zeta * sweep_zeta * sigma / std::sqrt(within);
  const double sd_line = 2.0 * sweep_zeta * sweep_zeta *
                         std::sqrt(sigma * sigma / all + G * G * deviation * deviation * lever / (all * all));
  CHECK(sd_within == Approx(1.5e-4).epsilon(0.05));
  CHECK(sd_line == Approx(2.8e-4).epsilon(0.25));  // depends on the levels that were drawn

  Cloud line;
  Cloud sweeps;
  double variance = 0.0;
  int covered_zeta = 0, covered_F0 = 0;
  constexpr int samples = 3000;
  for (int i = 0; i < samples; ++i) {
    const Record record = measured_sweeps(levels, drift_of(normal, deviation), sigma, 0.0, normal);
    const Estimate one = resonance_least_squares(record, at_resonance, {});
    const Estimate e = resonance_within_sweep(record, at_resonance, {});
    REQUIRE(e.outcome.ok());
    line.add(one.value.zeta, one.value.F0);
    sweeps.add(e.value.zeta, e.value.F0);
    variance += (*e.covariance)(0, 0) / samples;
    covered_zeta += e.interval95->zeta[0] < sweep_zeta && sweep_zeta < e.interval95->zeta[1];
    covered_F0 += e.interval95->F0[0] < 1568.0 * sweep_x_f && 1568.0 * sweep_x_f < e.interval95->F0[1];
  }
  CHECK(std::sqrt(line.var_a()) == Approx(sd_line).epsilon(0.05));
  CHECK(std::sqrt(sweeps.var_a()) == Approx(sd_within).epsilon(0.05));
  CHECK(std::sqrt(variance) == Approx(sd_within).epsilon(0.02));
  // A coverage of 95 % is known to 0.4 %; the friction's degrees of freedom are an approximation.
  CHECK(covered_zeta / double(samples) == Approx(0.95).margin(0.012));
  CHECK(covered_F0 / double(samples) == Approx(0.95).margin(0.02));
}

TEST_CASE("Parallel lines return the friction of each sweep") {
  Normal normal(32);
  const auto friction = drift_of(normal, 0.15e-3);
  const Estimate e =
      resonance_within_sweep(measured_sweeps(levels_of(normal), friction, 0.0, 0.0, normal), at_resonance, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.value.zeta == Approx(sweep_zeta).epsilon(1e-11));
  double mean = 0.0, square = 0.0;
  REQUIRE(e.subsets.size() == 10);
  for (std::size_t j = 0; j < 10; ++j) {
    CHECK(e.subsets[j].label == std::string("sweep ") + static_cast<char>('a' + j));
    CHECK(e.subsets[j].value.x_f == Approx(friction[j]).epsilon(1e-11));
    mean += friction[j] / 10.0;
  }
  for (const double value : friction) square += (value - mean) * (value - mean);
  CHECK(e.value.x_f == Approx(mean).epsilon(1e-11));
  REQUIRE(e.others.size() == 1);
  CHECK(e.others[0].name == "F0_between_sweeps");
  CHECK(e.others[0].value == Approx(1568.0 * std::sqrt(square / 9.0)).epsilon(1e-9));
  CHECK(e.std->F0 == Approx(1568.0 * std::sqrt(square / 90.0)).epsilon(1e-6));  // of the mean of ten
  CHECK_FALSE(e.lack_of_fit->fired);
}

TEST_CASE("What is not parallel or not straight is told") {
  Normal normal(33);
  const auto levels = levels_of(normal);
  // 0.5 mm over the half range of 1.15 mm, ten times the errors.
  const Estimate bent = resonance_within_sweep(
      measured_sweeps(levels, drift_of(normal, 0.15e-3), 0.045e-3, 0.5e-3 / 1.3e-6, normal), at_resonance, {});
  CHECK(bent.lack_of_fit->fired);
  CHECK_FALSE(bent.usable);
  CHECK(bent.lack_of_fit->freedom == 50 - 10 - 2);

  Record fan = measured_sweeps(levels, drift_of(normal, 0.0), 0.045e-3, 0.0, normal);
  for (Pair& pair : fan.pairs->pairs) pair.x += 0.2 * (pair.sweep[0] - 'e') * (pair.Y - 5.6e-3);
  const Estimate e = resonance_within_sweep(fan, at_resonance, {});
  REQUIRE_FALSE(e.warnings.empty());
  CHECK(e.warnings[0].find("not parallel") != std::string::npos);

  // Both tests fire as often as their level says: 5 % of 1000, give or take 7; four times that.
  int curved = 0, spread = 0;
  for (int i = 0; i < 1000; ++i) {
    const Estimate quiet = resonance_within_sweep(
        measured_sweeps(levels, drift_of(normal, 0.15e-3), 0.045e-3, 0.0, normal), at_resonance, {});
    curved += quiet.lack_of_fit->p_value < 0.05;
    spread += !quiet.warnings.empty();
  }
  CHECK(std::abs(curved - 50) < 28);
  CHECK(std::abs(spread - 50) < 28);
}

TEST_CASE("The test for curvature keeps its level under drift, with errors of x and of Y") {
  // As for one line (test_resonance_least_squares.cpp), with the heights of the sweeps taken out. 4000 samples know
  // 5 % to 0.34 %; four times that is allowed.
  Normal normal(35);
  const auto levels = levels_of(normal);
  constexpr int samples = 4000;
  for (const double sigma_Y : {0.0, 20e-6})
    for (const double sigma_x : {20e-6, 50e-6, 100e-6}) {
      int fired = 0;
      for (int i = 0; i < samples; ++i) {
        Record record = measured_sweeps(levels, drift_of(normal, 0.15e-3), sigma_x, 0.0, normal);
        for (Pair& pair : record.pairs->pairs) pair.Y += sigma_Y * normal();
        fired += resonance_within_sweep(record, at_resonance, {}).lack_of_fit->p_value < 0.05;
      }
      CAPTURE(sigma_Y, sigma_x);
      CHECK(fired / double(samples) == Approx(0.05).margin(0.014));
    }
}

TEST_CASE("Pairs that stick are left out by the friction of their own sweep") {
  // x = 3.2 mm slides where x_f = 2.8 mm (S = 1.063) and sticks where it is 3.4 mm.
  const double G = analytic::den_hartog(sweep_zeta, 1.0).G;
  PairRecord record;
  for (const double own : {2.8e-3, 3.4e-3})
    for (const double x : {3.2e-3, 6e-3, 9e-3, 12e-3})
      record.pairs.push_back({2.0 * sweep_zeta * (x + G * own), x, own < 3e-3 ? "low" : "high",
                              static_cast<int>(record.pairs.size()) + 1});
  const Estimate e = resonance_within_sweep({record, std::nullopt}, at_resonance, {});
  REQUIRE(e.outcome.ok());
  REQUIRE(e.excluded.size() == 1);
  CHECK(e.excluded[0].number == 5);
  CHECK(e.value.zeta == Approx(sweep_zeta).epsilon(1e-12));
}

TEST_CASE("Sweeps drawn again give what the formula gives; records without sweeps are refused") {
  Normal normal(34);
  WithinSweepOptions options;
  options.bootstrap = 2000;
  const Estimate e = resonance_within_sweep(
      measured_sweeps(levels_of(normal), drift_of(normal, 0.15e-3), 0.045e-3, 0.0, normal), at_resonance, options);
  REQUIRE(e.others.size() == 3);
  // Drawing ten from ten loses a tenth of the variance; and ten sweeps know their own variance to 24 %.
  CHECK(*e.others[1].std == Approx(e.std->zeta).epsilon(0.4));
  CHECK(*e.others[2].std == Approx(e.std->F0).epsilon(0.15));

  CHECK(lacks_sweeps(pairs(table_1)) == "the pairs are not labelled with two sweeps of two pairs or more");
  CHECK_FALSE(resonance_within_sweep(pairs(table_1), table_1_constants, {}).outcome.ok());
}
