#include "identify/methods/amplitudes/den_hartog_fit.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "friction_models/laws/coulomb.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "sim/curves/curves.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;

namespace {

const std::vector<double> five_levels = {4.45e-3, 5.025e-3, 5.6e-3, 6.175e-3, 6.75e-3};

/// Pairs of the closed form at every level and frequency, with errors of x.
Record pairs_at(double zeta, double x_f, const std::vector<double>& ratios, double sigma, Normal& normal) {
  PairRecord record;
  for (const double r : ratios)
    for (const double Y : five_levels)
      record.pairs.push_back(
          {.Y = Y,
           .x = analytic::amplitude(analytic::den_hartog(zeta, r), Y, x_f).value() + sigma * normal(),
           .sweep = {},
           .number = static_cast<int>(record.pairs.size()) + 1,
           .omega = r * natural});
  return {record, std::nullopt};
}

Record exact_pairs_at(double zeta, double x_f, const std::vector<double>& ratios) {
  Normal none(1);
  return pairs_at(zeta, x_f, ratios, 0.0, none);
}

/// Standard errors of (zeta, x_f, wn/wn), the last one free or known, for errors sigma of x: from differences of
/// the closed form, by no code of the method.
Eigen::VectorXd standard_errors(double zeta, double x_f, const std::vector<double>& ratios, double sigma,
                                bool free) {
  Eigen::MatrixXd J(static_cast<Eigen::Index>(ratios.size() * five_levels.size()), 3);
  Eigen::Index row = 0;
  for (const double r : ratios)
    for (const double Y : five_levels) {
      const auto x = [&](double dz, double df, double dn) {
        return analytic::amplitude(analytic::den_hartog(zeta + dz, r / (1.0 + dn)), Y, x_f + df).value();
      };
      constexpr double h = 1e-6;
      J.row(row++) << (x(h, 0, 0) - x(-h, 0, 0)) / (2.0 * h),
          (x(0, h * x_f, 0) - x(0, -h * x_f, 0)) / (2.0 * h * x_f), (x(0, 0, h) - x(0, 0, -h)) / (2.0 * h);
    }
  const Eigen::Index size = free ? 3 : 2;
  const Eigen::MatrixXd columns = J.leftCols(size);
  const Eigen::MatrixXd covariance = (columns.transpose() * columns).inverse();
  return sigma * covariance.diagonal().cwiseSqrt();
}

}  // namespace

TEST_CASE("Exact pairs give the truth, near resonance or not") {
  for (const double zeta : {0.01, 0.05, 0.12, 0.3})
    for (const std::vector<double>& ratios : {std::vector{1.0}, std::vector{0.9}, std::vector{1.1},
                                              std::vector{0.95, 1.0, 1.05}, std::vector{0.6, 1.4}}) {
      const double x_f = 1.0e-3;
      CAPTURE(zeta, ratios);
      const Estimate e = den_hartog_fit(exact_pairs_at(zeta, x_f, ratios), bearing, {});
      REQUIRE(e.outcome.ok());
      CHECK(e.usable);
      CHECK(e.excluded.empty());
      CHECK(e.value.zeta == Approx(zeta).epsilon(1e-9));
      CHECK(e.value.x_f == Approx(x_f).epsilon(1e-9));
      CHECK(e.value.c == Approx(2.0 * zeta * std::sqrt(mass * stiffness)).epsilon(1e-9));
    }
}

TEST_CASE("Simulated pairs give the truth where the line of the resonance method does not") {
  // 3 % above resonance: the line errs by several percent, the exact law by rounding.
  const double zeta = 0.12, F0 = 3.7;
  sim::Model model;
  model.oscillator = {mass, stiffness, 2.0 * zeta * std::sqrt(mass * stiffness), sim::DamperTo::ground};
  model.friction.emplace_back(friction::Coulomb(F0, F0));
  model.excitation.type = sim::ExcitationType::base_harmonic;
  model.excitation.frequency = 1.03 * natural;
  std::vector<std::pair<double, double>> list;
  for (const sim::CurvePoint& point : sim::xy_curve(model, five_levels).points) list.emplace_back(point.Y, point.x);
  const KnownConstants constants{mass, stiffness, 1.03 * natural};
  const Estimate e = den_hartog_fit(pairs(list), constants, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.value.zeta == Approx(zeta).epsilon(1e-9));
  CHECK(e.value.F0 == Approx(F0).epsilon(1e-9));
  CHECK(std::abs(resonance_least_squares(pairs(list), constants, {}).value.zeta / zeta - 1.0) > 0.03);
}

TEST_CASE("The natural frequency is fitted from three frequencies and refused from fewer") {
  // Errors of x of 0.045 mm at zeta = 0.12, x_f = 2.36 mm: standard errors by differences of the closed form.
  const double zeta = 0.12, x_f = 2.36e-3, sigma = 0.045e-3;
  const Eigen::VectorXd one = standard_errors(zeta, x_f, {1.0}, sigma, false);
  const Eigen::VectorXd one_free = standard_errors(zeta, x_f, {1.0}, sigma, true);
  const Eigen::VectorXd three_free = standard_errors(zeta, x_f, {0.95, 1.0, 1.05}, sigma, true);
  CHECK(one[0] == Approx(0.0007).epsilon(0.1));
  CHECK(one_free[0] > 20.0 * one[0]);
  CHECK(one_free[2] > 0.1);
  CHECK(three_free[0] == Approx(0.0005).epsilon(0.2));
  CHECK(three_free[2] == Approx(0.001).epsilon(0.5));

  DenHartogOptions options;
  options.free_natural_frequency = true;
  options.sigma_x = sigma;
  for (const std::vector<double>& ratios : {std::vector{1.0}, std::vector{0.95, 1.05}}) {
    const Estimate refused = den_hartog_fit(exact_pairs_at(zeta, x_f, ratios), bearing, options);
    CHECK_FALSE(refused.outcome.ok());
    CHECK(mentions(refused.reason, "fewer than three frequencies"));
  }
  const Estimate e = den_hartog_fit(exact_pairs_at(zeta, x_f, {0.95, 1.0, 1.05}), bearing, options);
  REQUIRE(e.outcome.ok());
  CHECK(e.std->zeta == Approx(three_free[0]).epsilon(1e-4));
  CHECK(e.std->x_f == Approx(three_free[1]).epsilon(1e-4));
  REQUIRE(e.others.size() == 1);
  CHECK(e.others[0].name == "natural_frequency");
  CHECK(*e.others[0].std == Approx(natural * three_free[2]).epsilon(1e-4));

  // A laboratory that has its mass wrong by 4 %, and so wn by 2 %.
  const KnownConstants wrong{1.04 * mass, stiffness, unknown};
  const Estimate fixed = den_hartog_fit(exact_pairs_at(zeta, x_f, {0.95, 1.0, 1.05}), wrong, {});
  CHECK_FALSE(fixed.usable);
  CHECK(mentions(fixed.reason, "the frequencies contradict wn"));
  const Estimate free = den_hartog_fit(exact_pairs_at(zeta, x_f, {0.95, 1.0, 1.05}), wrong, options);
  CHECK(free.usable);
  CHECK(free.value.zeta == Approx(zeta).epsilon(1e-9));
  CHECK(free.value.c == Approx(2.0 * zeta * std::sqrt(mass * stiffness)).epsilon(1e-9));
  CHECK(free.others[0].value == Approx(natural).epsilon(1e-9));
}

TEST_CASE("Intervals of the exact law hold in a Monte Carlo experiment") {
  // The model is curved by sd(zeta)/zeta = 1 %, so its linear covariance errs by about that. 2000 samples know a
  // standard deviation to 1.6 %, a coverage of 95 % to 0.5 %.
  const double zeta = 0.1, x_f = 2.2e-3;
  Normal normal(19);
  Cloud cloud;
  double variance = 0.0;
  int covered_zeta = 0, covered_F0 = 0, fired = 0;
  constexpr int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    const Estimate e = den_hartog_fit(pairs_at(zeta, x_f, {0.97, 1.02}, 0.05e-3, normal), bearing, {});
    REQUIRE(e.outcome.ok());
    cloud.add(e.value.zeta, e.value.F0);
    variance += (*e.covariance)(0, 0) / samples;
    covered_zeta += e.interval95->zeta[0] < zeta && zeta < e.interval95->zeta[1];
    covered_F0 += e.interval95->F0[0] < stiffness * x_f && stiffness * x_f < e.interval95->F0[1];
    fired += e.lack_of_fit->p_value < 0.05;
  }
  CHECK(std::sqrt(variance) == Approx(std::sqrt(cloud.var_a())).epsilon(0.05));
  CHECK(covered_zeta / double(samples) == Approx(0.95).margin(0.02));
  CHECK(covered_F0 / double(samples) == Approx(0.95).margin(0.02));
  CHECK(fired / double(samples) == Approx(0.05).margin(0.02));
}

TEST_CASE("Profiles and bootstrap of the exact law agree with its standard errors where errors are small") {
  Normal normal(20);
  DenHartogOptions options;
  options.profile = true;
  options.bootstrap = 1000;
  Record record =
      pairs_at(0.1, 2.2e-3, {0.96, 0.98, 1.0, 1.02, 1.04, 0.97, 0.99, 1.01, 1.03, 1.05}, 0.02e-3, normal);
  const Estimate e = den_hartog_fit(record, bearing, options);
  REQUIRE(e.others.size() == 4);
  CHECK((*e.others[0].interval95)[0] == Approx(e.interval95->zeta[0]).margin(0.05 * e.std->zeta));
  CHECK((*e.others[1].interval95)[1] == Approx(e.interval95->F0[1]).margin(0.05 * e.std->F0));
  // Residuals drawn: 1000 replicates know a standard deviation to 2.2 %.
  CHECK(*e.others[2].std == Approx(e.std->zeta).epsilon(0.07));
  CHECK(*e.others[3].std == Approx(e.std->F0).epsilon(0.07));
}

TEST_CASE("The exact law leaves out what sticks and tells what it cannot fit") {
  const Estimate bent = den_hartog_fit(pairs(subset_trend), soft_spring, {});
  REQUIRE(bent.outcome.ok());
  CHECK_FALSE(bent.usable);
  REQUIRE(bent.lack_of_fit.has_value());
  CHECK(bent.lack_of_fit->fired);

  // A pair below the sticking boundary (x/x_f = 1.09 at zeta = 0.142), of the foot that lies above the law.
  const double zeta = 0.142, x_f = 1e-3;
  PairRecord foot{{{.Y = 1.45e-3, .x = 0.6e-3, .sweep = {}, .number = 1}}};
  for (const double Y : {1.7e-3, 2.0e-3, 2.5e-3, 3.0e-3})
    foot.pairs.push_back({.Y = Y,
                          .x = analytic::amplitude(analytic::den_hartog(zeta, 1.0), Y, x_f).value(),
                          .sweep = {},
                          .number = static_cast<int>(foot.pairs.size()) + 1});
  const Estimate e = den_hartog_fit({foot, std::nullopt}, {mass, stiffness, natural}, {});
  REQUIRE(e.outcome.ok());
  REQUIRE(e.excluded.size() == 1);
  CHECK(e.excluded[0].number == 1);
  CHECK(e.value.zeta == Approx(zeta).epsilon(1e-9));
}

TEST_CASE("Phases are compared and not fitted") {
  Record record = exact_pairs_at(0.12, 2.0e-3, {1.0});
  for (Pair& pair : record.pairs->pairs)
    pair.phase = analytic::non_sticking_state(analytic::den_hartog(0.12, 1.0), pair.Y, 2.0e-3)->phase;
  const Estimate right = den_hartog_fit(record, bearing, {});
  CHECK(right.warnings.empty());
  for (Pair& pair : record.pairs->pairs) pair.phase += 0.07;  // 4 degrees
  const Estimate late = den_hartog_fit(record, bearing, {});
  CHECK(late.value.zeta == right.value.zeta);
  REQUIRE(late.warnings.size() == 1);
  CHECK(mentions(late.warnings[0], "4.01 degrees"));
}

TEST_CASE("Pairs that allow no fit of the exact law are refused with the reason") {
  const auto refused = [](const Record& record, const KnownConstants& constants, const std::string& words) {
    const Estimate e = den_hartog_fit(record, constants, {});
    CHECK_FALSE(e.outcome.ok());
    INFO(e.reason);
    CHECK(mentions(e.reason, words));
  };
  refused(Record{}, table_1_constants, "no x-Y pairs");
  refused(pairs({{0.1, 0.2}}), table_1_constants, "2 pairs are needed, and 1 is left");
  refused(pairs({{0.1, 0.2}, {0.1, 0.21}}), table_1_constants, "one level");
  refused(pairs(table_1), {1.0, 100.0, unknown}, "needs the forcing frequency");
  refused(pairs(table_1), {unknown, 100.0, 10.0}, "needs the mass");
}

TEST_CASE("Over frequency at one input the tests of the exact law fire as often as they say") {
  // Nine frequencies at 5 mm, errors of 8 um. 1000 samples know a rate of 5 % to 0.7 %.
  Normal normal(23);
  int friction = 0, detuned = 0;
  constexpr int samples = 1000;
  for (int i = 0; i < samples; ++i) {
    PairRecord record;
    for (int j = 0; j < 9; ++j) {
      const double r = 0.81 + 0.0485 * j;
      record.pairs.push_back(
          {.Y = 5e-3,
           .x = analytic::amplitude(analytic::den_hartog(0.12, r), 5e-3, 2.36e-3).value() + 8e-6 * normal(),
           .sweep = {},
           .number = j + 1,
           .omega = r * natural});
    }
    const Estimate e = den_hartog_fit({record, std::nullopt}, bearing, {});
    friction += e.lack_of_fit->p_value < 0.05;
    detuned += mentions(e.reason, "contradict");
  }
  CHECK(friction / double(samples) == Approx(0.05).margin(0.02));
  CHECK(detuned / double(samples) < 0.07);
}
