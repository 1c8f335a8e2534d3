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
identify::Fit fit_to(identify::Rig rig, const identify::Record& record, const std::vector<std::string>& names) {
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  REQUIRE(fault.empty());
  std::vector<identify::FitParameter> parameters = test::sought_in(rig, names, 1.1);
  for (const identify::RecordParameter each : experiments.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  return identify::fit_rig(rig, std::move(parameters), experiments, {.profile = false});
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
