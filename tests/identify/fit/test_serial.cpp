#include <Eigen/QR>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "identify/fit/serial_test.hpp"
#include "identify/statistics/distributions.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

/// A fit of all of kinetic and damping to one record.
identify::Fit fit_to(identify::Rig rig, const identify::Record& record, const std::vector<std::string>& names,
                     bool robust = false) {
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  REQUIRE(fault.empty());
  std::vector<identify::FitParameter> parameters = test::sought_in(rig, names, 1.1);
  for (const identify::RecordParameter each : experiments.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  return identify::fit_rig(rig, std::move(parameters), experiments, {.robust = robust, .profile = false});
}

/// Two levels, each at 12 frequencies around the resonance.
std::vector<std::pair<double, double>> two_levels(const identify::Rig& rig) {
  std::vector<std::pair<double, double>> levels;
  for (const double Y : {0.003, 0.006})
    for (int i = 0; i < 12; ++i) levels.emplace_back(Y, rig.known.excitation.frequency * (0.9 + 0.04 * i));
  return levels;
}

}  // namespace

TEST_CASE("serial: the chance of a quadratic form below zero, by closed forms", "[identify][fit]") {
  for (const double a : {0.01, 0.3, 1.0, 4.0}) {
    CAPTURE(a);
    // P(z1^2 < a z2^2), and of sums of two squares, which are exponential.
    CHECK(identify::chance_below_zero(Eigen::Vector2d(1.0, -a)) ==
          Approx(2.0 / std::numbers::pi * std::atan(std::sqrt(a))).margin(1e-6));
    CHECK(identify::chance_below_zero(Eigen::Vector4d(1.0, 1.0, -a, -a)) == Approx(a / (1.0 + a)).margin(1e-6));
    // P(chi-square of 7 < a chi-square of 12) by Fisher's F.
    Eigen::VectorXd lambda = Eigen::VectorXd::Constant(19, 2.5);
    lambda.tail(12).setConstant(-2.5 * a);
    CHECK(identify::chance_below_zero(lambda) ==
          Approx(1.0 - identify::f_test_p_value(a * 12.0 / 7.0, 7.0, 12.0)).margin(1e-6));
  }
}

TEST_CASE("serial: residuals of a regression keep the level, and a slow error is found", "[identify][fit]") {
  constexpr Eigen::Index count = 20;
  Eigen::MatrixXd columns(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) / (count - 1);
    columns.row(i) << 1.0, s, s * s, std::exp(s);
  }
  const Eigen::MatrixXd base =
      Eigen::HouseholderQR<Eigen::MatrixXd>(columns).householderQ() * Eigen::MatrixXd::Identity(count, 4);
  int below = 0;
  int found = 0;
  constexpr int seeds = 600;
  for (int seed = 0; seed < seeds; ++seed) {
    const core::RandomStream draws{static_cast<std::uint64_t>(seed), 930};
    Eigen::VectorXd noise(count);
    Eigen::VectorXd slow(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      noise[i] = draws.normal(static_cast<std::uint64_t>(i));
      slow[i] = 6.0 * std::sin(4.0 * std::numbers::pi * static_cast<double>(i) / (count - 1));
    }
    const auto left = [&](const Eigen::VectorXd& errors) {
      return Eigen::VectorXd(errors - base * (base.transpose() * errors));
    };
    below += identify::serial_p_value(left(noise), base) < 0.05 ? 1 : 0;
    found += identify::serial_p_value(left(noise + slow), base) < 1e-3 ? 1 : 0;
  }
  // 5 % of 600 with a standard deviation of 5.3. Without the base of the fit 4 would lie below.
  CHECK(below > 30 - 22);
  CHECK(below < 30 + 22);
  CHECK(found > 500);
}

TEST_CASE("serial: a decay beside a wrong mass, and pairs of another law, are told without a stated noise",
          "[identify][fit]") {
  identify::Rig rig = test::rig_with(test::law_case_of("coulomb"));
  const identify::Record decay = test::decay_of_rig(rig, 0.05, 16, 1e-5, 3);
  CHECK(fit_to(rig, decay, {"kinetic", "damping"}).warnings.empty());
  identify::Rig heavy = rig;
  heavy.known.oscillator.mass *= 1.1;
  const identify::Fit wrong = fit_to(heavy, decay, {"kinetic", "damping"});
  REQUIRE(wrong.outcome.ok());
  REQUIRE(!wrong.warnings.empty());
  CHECK_THAT(wrong.warnings.front(), Catch::Contains("the residuals of t are not noise"));

  std::vector<std::pair<double, double>> levels;
  for (int i = 0; i < 14; ++i) levels.emplace_back(0.002 + 0.0008 * i, rig.known.excitation.frequency);
  CHECK(fit_to(rig, test::steady_states_of(rig, levels, 1e-5, 3e-3, 5), {"kinetic", "damping"}).warnings.empty());
  identify::Rig hard = rig;
  hard.known.oscillator.cubic_stiffness = 1e5;
  const identify::Fit of_hard =
      fit_to(rig, test::steady_states_of(hard, levels, 1e-5, 3e-3, 5), {"kinetic", "damping"});
  REQUIRE(of_hard.outcome.ok());
  REQUIRE(!of_hard.warnings.empty());
  CHECK_THAT(of_hard.warnings.front(), Catch::Contains("too similar from reading to reading"));
}

TEST_CASE("serial: neighbours are the frequencies of a level, whatever the order of the rows", "[identify][fit]") {
  // Slow errors of opposite sign at two levels: along the frequency alone they alternate. The levels scatter by 1
  // %.
  const auto chance = [](bool reversed, double slow, std::uint64_t seed) {
    const core::RandomStream draws{seed, 931};
    identify::Signal signal{.name = "x"};
    Eigen::VectorXd residuals(40);
    for (int row = 0; row < 40; ++row) {
      const int i = reversed ? 39 - row : row;
      const int place = i / 2;
      signal.measured.push_back(1.0);
      signal.at.push_back(20.0 + place);
      signal.companion.values.push_back((i % 2 == 0 ? 2.0 : 4.0) * (1.0 + 0.01 * std::sin(7.0 * i)));
      residuals[row] = draws.normal(static_cast<std::uint64_t>(i)) +
                       (i % 2 == 0 ? slow : -slow) * std::sin(0.3 * static_cast<double>(place));
    }
    const Eigen::MatrixXd none(40, 0);
    return identify::serial_p_value(residuals, identify::lines_of(signal, true),
                                    {.Q = none, .T = none, .gram = Eigen::MatrixXd(0, 0)});
  };
  int below = 0;
  constexpr std::uint64_t seeds = 300;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) below += chance(false, 0.0, seed) < 0.05 ? 1 : 0;
  CHECK(std::abs(below - 15) < 15);  // 5 % of 300, with a standard deviation of 3.8
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CHECK(chance(false, 2.5, seed) < 1e-3);
    CHECK(chance(true, 0.0, seed) == Approx(chance(false, 0.0, seed)).epsilon(1e-6));
  }
  // Readings of one state have no order: beside their mean, which is fitted, d has one value.
  const identify::Signal repeats{
      .name = "x", .measured = {1.0, 2.0, 3.0, 4.0, 5.0}, .at = {7.0, 7.0, 7.0, 7.0, 7.0}};
  const Eigen::MatrixXd mean = Eigen::MatrixXd::Constant(5, 1, std::sqrt(0.2));
  CHECK(std::isnan(identify::serial_p_value(Eigen::VectorXd::LinSpaced(5, -2.0, 2.0),
                                            identify::lines_of(repeats, true),
                                            {.Q = mean, .T = mean, .gram = Eigen::MatrixXd::Identity(1, 1)})));
}

TEST_CASE("serial: a robust fit keeps the level of the test beside outliers", "[identify][fit]") {
  int below = 0;
  constexpr std::uint64_t seeds = 20;
  const identify::Rig rig = test::rig_with(test::law_case_of("coulomb"));
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    identify::Record record = test::steady_states_of(rig, two_levels(rig), 1e-5, 3e-3, seed);
    for (const std::size_t i : {std::size_t{4}, std::size_t{5}, std::size_t{17}}) record.pairs->pairs[i].x *= 1.2;
    const identify::Fit fit = fit_to(rig, record, {"kinetic", "damping"}, true);
    REQUIRE(fit.outcome.ok());
    REQUIRE(!std::isnan(fit.signals.front().p_value));
    below += fit.signals.front().p_value < 0.05 ? 1 : 0;
  }
  CHECK(below <= 4);  // 5 % of 20: 5 or more in 3 of 1000
}

TEST_CASE("serial: a robust fit of pairs tells another law as a plain one does", "[identify][fit]") {
  const identify::Rig rig = test::rig_with(test::law_case_of("coulomb"));
  identify::Rig hard = rig;
  hard.known.oscillator.cubic_stiffness = 1e5;
  const identify::Record record = test::steady_states_of(hard, two_levels(rig), 1e-5, 3e-3, 5);
  for (const bool robust : {false, true}) {
    const identify::Fit fit = fit_to(rig, record, {"kinetic", "damping"}, robust);
    REQUIRE(fit.outcome.ok());
    CHECK(fit.signals.front().p_value < 1e-3);
  }
}
