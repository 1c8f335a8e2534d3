#include "identify/methods/decays/free_decay.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/analytic/free_decay.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
using dualdamp::sim::analytic::decrement_amplitude;
using dualdamp::sim::analytic::free_decay_extremes;
using std::numbers::pi;

namespace {

/// The paper's free decays: zeta = 0.0819, x_f = 0.807 mm, from about 13.6 mm.
constexpr double paper_zeta = 0.0819;
constexpr double paper_x_f = 0.807e-3;
constexpr double paper_X_0 = 13.6e-3;

std::vector<double> shifted(std::vector<double> extremes, double offset) {
  for (double& e : extremes) e += offset;
  return extremes;
}

}  // namespace

TEST_CASE("Exact decays return the truth whatever offset, sign and number of extremes") {
  // Four or more extremes determine the four unknowns. Rounding of the extremes, 1e-16 of X_0, is amplified by X_0
  // over the differences of two apart: a few tens here.
  for (const double zeta : {0.0, 1e-4, 0.02, 0.0819, 0.2}) {
    for (const double x_0 : {1.0, -1.0}) {
      for (const double offset : {0.0, 0.04}) {
        for (const int count : {4, 5, 6, 8}) {
          const double x_f = 0.02;
          const auto e = free_decay_extremes(zeta, x_f, x_0, count);
          if (static_cast<int>(e.size()) < count) continue;
          const Estimate estimate = free_decay(extremes(shifted(e, offset)), stiff_spring, {});
          CAPTURE(zeta, x_0, offset, count, estimate.reason);
          REQUIRE(estimate.outcome.ok());
          CHECK(estimate.usable);
          CHECK(std::abs(estimate.value.zeta - zeta) < 1e-12);
          CHECK(std::abs(estimate.value.x_f - x_f) < 1e-12);
          REQUIRE(estimate.decay.has_value());
          CHECK(std::abs(estimate.decay->offset - offset) < 1e-12);
          CHECK(std::abs(estimate.decay->first_amplitude - x_0) < 1e-12);
          CHECK(estimate.std.has_value() == (count > 4));
          if (estimate.lack_of_fit) CHECK_FALSE(estimate.lack_of_fit->fired);
        }
      }
    }
  }
}

TEST_CASE("A decay without dry friction and one at any scale") {
  const auto e = free_decay_extremes(0.05, 0.0, 2.0, 6);
  const Estimate viscous = free_decay(extremes(e), stiff_spring, {});
  CHECK(viscous.usable);
  CHECK(viscous.value.zeta == Approx(0.05).epsilon(1e-12));
  CHECK(std::abs(viscous.value.x_f) < 1e-13);
  for (const double scale : {1e-200, 1e200}) {
    const auto scaled = free_decay_extremes(0.0819, 0.06 * scale, scale, 5);
    const Estimate estimate = free_decay(extremes(scaled), {1.0, 1.0, 0.0}, {});
    REQUIRE(estimate.outcome.ok());
    CHECK(estimate.value.zeta == Approx(0.0819).epsilon(1e-11));
    CHECK(estimate.value.x_f == Approx(0.06 * scale).epsilon(1e-11));
  }
}

TEST_CASE("Five extremes hold the two classical estimates") {
  const auto e = free_decay_extremes(paper_zeta, paper_x_f, paper_X_0, 5);
  REQUIRE(e.size() == 5);
  const Estimate estimate = free_decay(extremes(e), stiff_spring, {});
  REQUIRE(estimate.subsets.size() == 2);
  CHECK(estimate.subsets[0].label == "1-4");
  CHECK(estimate.subsets[1].label == "2-5");
  for (const SubsetFit& window : estimate.subsets) {
    CHECK(window.used == 4);
    CHECK(window.value.zeta == Approx(paper_zeta).epsilon(1e-11));
    CHECK(window.value.F0 == Approx(4365.0 * paper_x_f).epsilon(1e-11));
  }
  CHECK(estimate.value.c == Approx(2.0 * paper_zeta * std::sqrt(1.042 * 4365.0)).epsilon(1e-11));
}

TEST_CASE("A known zero offset makes do with three extremes") {
  FreeDecayOptions options;
  options.zero_offset = true;
  const auto e = free_decay_extremes(paper_zeta, paper_x_f, paper_X_0, 3);
  const Estimate three = free_decay(extremes(e), stiff_spring, options);
  REQUIRE(three.outcome.ok());
  CHECK(three.value.zeta == Approx(paper_zeta).epsilon(1e-12));
  CHECK(three.value.x_f == Approx(paper_x_f).epsilon(1e-12));
  CHECK(three.decay->offset == 0.0);
  CHECK_FALSE(free_decay(extremes(e), stiff_spring, {}).outcome.ok());
  const auto more = free_decay_extremes(paper_zeta, paper_x_f, paper_X_0, 5);
  const Estimate five = free_decay(extremes(more), stiff_spring, options);
  CHECK(five.value.zeta == Approx(paper_zeta).epsilon(1e-12));
  // An offset that is there and denied: 0.3 mm turns zeta and x_f far off, and the residuals show it.
  const Estimate denied = free_decay(extremes(shifted(more, 0.3e-3)), stiff_spring, options);
  CHECK(denied.decay->residual_deviation > 0.1e-3);
}

TEST_CASE("Standard errors hold in a Monte Carlo experiment, and five extremes beat four") {
  // sigma = 0.05 mm of each extreme: std(zeta) = 0.0046, std(x_f) = 0.056 mm from four; 0.70 and 0.57 times that
  // from five. First order in std(zeta)/zeta = 6 %: the standard deviations err by about its square, 0.4 %. 10000
  // samples know them to 0.7 %.
  const double sigma = 0.05e-3;
  const auto truth = free_decay_extremes(paper_zeta, paper_x_f, paper_X_0, 5);
  FreeDecayOptions known;
  known.sigma_x = sigma;
  double zeta_of_four = 0.0, x_f_of_four = 0.0;
  for (const std::size_t count : {4, 5}) {
    const std::vector<double> exact(truth.begin(), truth.begin() + static_cast<std::ptrdiff_t>(count));
    const Estimate formula = free_decay(extremes(exact), stiff_spring, known);
    REQUIRE(formula.std.has_value());
    Normal normal(31);
    Cloud cloud;
    int covered = 0;
    constexpr int samples = 10000;
    for (int i = 0; i < samples; ++i) {
      std::vector<double> noisy = exact;
      for (double& e : noisy) e += sigma * normal();
      const Estimate sample = free_decay(extremes(noisy), stiff_spring, known);
      REQUIRE(sample.outcome.ok());
      cloud.add(sample.value.zeta, sample.value.F0);
      covered += sample.interval95->zeta[0] < paper_zeta && paper_zeta < sample.interval95->zeta[1];
    }
    CAPTURE(count);
    CHECK(formula.std->zeta == Approx(std::sqrt(cloud.var_a())).epsilon(0.02));
    CHECK(formula.std->F0 == Approx(std::sqrt(cloud.var_b())).epsilon(0.02));
    CHECK((*formula.covariance)(0, 1) == Approx(cloud.covariance()).epsilon(0.03));
    CHECK(covered / double(samples) == Approx(0.95).margin(0.01));
    if (count == 4) {
      zeta_of_four = formula.std->zeta;
      x_f_of_four = formula.std->x_f;
      CHECK(zeta_of_four == Approx(0.0046).margin(1e-4));
      CHECK(x_f_of_four == Approx(0.056e-3).margin(1e-6));
    } else {
      CHECK(formula.std->zeta / zeta_of_four == Approx(0.70).margin(0.01));
      CHECK(formula.std->x_f / x_f_of_four == Approx(0.57).margin(0.01));
    }
  }
}

TEST_CASE("With the scatter of the residuals the intervals hold too") {
  // Eight extremes, four degrees of freedom.
  const auto exact = free_decay_extremes(0.03, 0.01, 1.0, 8);
  REQUIRE(exact.size() == 8);
  Normal normal(37);
  int covered_zeta = 0, covered_x_f = 0, rejected = 0;
  constexpr int samples = 4000;
  for (int i = 0; i < samples; ++i) {
    std::vector<double> noisy = exact;
    for (double& e : noisy) e += 2e-3 * normal();
    const Estimate sample = free_decay(extremes(noisy), stiff_spring, {});
    REQUIRE(sample.interval95.has_value());
    covered_zeta += sample.interval95->zeta[0] < 0.03 && 0.03 < sample.interval95->zeta[1];
    covered_x_f += sample.interval95->x_f[0] < 0.01 && 0.01 < sample.interval95->x_f[1];
    rejected += sample.lack_of_fit->p_value < 0.05;
  }
  // Three standard deviations of a count of 4000 at 5 % are 41, or 1 %.
  CHECK(covered_zeta / double(samples) == Approx(0.95).margin(0.011));
  CHECK(covered_x_f / double(samples) == Approx(0.95).margin(0.011));
  CHECK(rejected / double(samples) == Approx(0.05).margin(0.011));
}

TEST_CASE("Extremes after the stop are left out") {
  // Coulomb friction alone from 1.0 with x_f = 0.11: X_i = 1 - 0.22 i stops at X_4 = 0.12, X_5 = -0.10: the sixth
  // is the last turning point. What a recorder writes after it is the same place again, with a ripple.
  auto e = free_decay_extremes(0.0, 0.11, 1.0, 20);
  REQUIRE(e.size() == 6);
  const double rest = e.back();
  e.push_back(rest - 1e-4);
  e.push_back(rest + 1e-4);
  e.push_back(rest - 1e-4);
  const Estimate estimate = free_decay(extremes(e), stiff_spring, {});
  CAPTURE(estimate.reason);
  REQUIRE(estimate.outcome.ok());
  REQUIRE_FALSE(estimate.excluded.empty());
  CHECK(estimate.excluded.front().number == 7);
  CHECK(estimate.excluded.back().number == 9);
  CHECK(estimate.used.size() == 6);
  CHECK(std::abs(estimate.value.zeta) < 1e-12);
  CHECK(estimate.value.x_f == Approx(0.11).epsilon(1e-12));
}

TEST_CASE("Times are checked against mass, stiffness and zeta") {
  const auto e = free_decay_extremes(paper_zeta, paper_x_f, paper_X_0, 5);
  const double half = pi * std::sqrt(1.042 / 4365.0) / std::sqrt(1.0 - paper_zeta * paper_zeta);
  const auto times = [&](double first, double step) {
    std::vector<double> t;
    for (int i = 0; i < 5; ++i) t.push_back(first + i * step);
    return t;
  };
  CHECK(free_decay(extremes(e, times(0.3, half)), stiff_spring, {}).warnings.empty());
  const Estimate slow = free_decay(extremes(e, times(0.3, 1.1 * half)), stiff_spring, {});
  CHECK(slow.usable);
  REQUIRE(slow.warnings.size() == 1);
  CHECK(mentions(slow.warnings[0], "half swings last"));
  // The last extreme may be the place of rest, whose time noise decides.
  std::vector<double> rest = times(0.3, half);
  rest.back() -= 0.6 * half;
  CHECK(free_decay(extremes(e, rest), stiff_spring, {}).warnings.empty());
  auto gap = times(0.0, half);
  for (std::size_t i = 3; i < 5; ++i) gap[i] += 2.0 * half;
  const Estimate missing = free_decay(extremes(e, gap), stiff_spring, {});
  CHECK_FALSE(missing.usable);
  CHECK(mentions(missing.reason, "missing between 3 and 4"));
  CHECK_FALSE(free_decay(extremes(e, {0.0, 1.0}), stiff_spring, {}).usable);
}

TEST_CASE("A decay of another law is told") {
  // Friction that grows with the cube of the swing: the extremes lie off the law by up to two percent of the first,
  // and the cubic term explains 0.997 of the square of that.
  std::vector<double> e;
  double X = 1.0;
  for (int i = 0; i < 9; ++i) {
    e.push_back(i % 2 == 0 ? X : -X);
    X = 0.97 * X - 0.02 * (1.0 + 8.0 * X * X * X);
  }
  const Estimate estimate = free_decay(extremes(e), stiff_spring, {});
  REQUIRE(estimate.outcome.ok());
  REQUIRE(estimate.lack_of_fit.has_value());
  CHECK(estimate.lack_of_fit->fired);
  CHECK_FALSE(estimate.usable);
  CHECK(estimate.subsets.size() == 6);
}

TEST_CASE("A growing motion is no decay to be used") {
  // Negative damping within the range searched: told by its sign.
  std::vector<double> e;
  for (int i = 0; i < 6; ++i) e.push_back((i % 2 == 0 ? 1.0 : -1.0) * std::pow(1.1, i));
  const Estimate estimate = free_decay(extremes(e), stiff_spring, {});
  REQUIRE(estimate.outcome.ok());
  CHECK(estimate.value.zeta < 0.0);
  CHECK_FALSE(estimate.usable);
  CHECK(mentions(estimate.reason, "damping ratio came out negative"));
}

TEST_CASE("Extremes that allow no estimate are refused with the reason") {
  const auto refused = [](const Record& record, const KnownConstants& constants, const std::string& words) {
    const Estimate e = free_decay(record, constants, {});
    CHECK_FALSE(e.outcome.ok());
    CHECK_FALSE(e.usable);
    INFO(e.reason);
    CHECK(mentions(e.reason, words));
  };
  refused(Record{}, stiff_spring, "no extremes");
  refused(pairs(table_1), stiff_spring, "no extremes");
  refused(extremes({}), stiff_spring, "four successive extremes are needed and 0");
  refused(extremes({1.0, -0.8, 0.6}), stiff_spring, "and 3 can be used");
  refused(extremes({1.0, 0.8, 0.6, 0.4, 0.2}), stiff_spring, "peak and trough by turns");
  refused(extremes({0.0, 0.0, 0.0, 0.0, 0.0}), stiff_spring, "peak and trough by turns");
  refused(extremes({1.0, -0.8, std::nan(""), 0.4}), stiff_spring, "not finite");
  refused(extremes({1.0, -0.8, std::numeric_limits<double>::infinity(), -0.4}), stiff_spring, "not finite");
  refused(extremes({1.0, -0.8, 0.9, -0.9}), stiff_spring, "no decay ratio");
  refused(extremes({1.0, -0.8, 0.6, -0.4}), {1.0, -5.0, 0.0}, "stiffness");
  refused(extremes({1.0, -2.0, 4.0, -8.0, 16.0, -32.0}), stiff_spring, "no decay ratio");
}
