#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.hpp"
#include "identify/ledger/histories/history_rows.hpp"
#include "identify/ledger/ledger.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t sensor_seed = 4'700'000;

double largest_deflection(const Measured& m) {
  const auto [low, high] = std::ranges::minmax(m.record.histories.front().x);
  return std::max(std::abs(low), std::abs(high));
}

/// Of a record whose sensor of x is wrong and nothing else.
void check_charged_to_sensors(const Measured& m, const std::string& test) {
  const Ledger ledger = ledger_of(m.record, m.constants);
  REQUIRE(ledger.is_violated(Assumption::sensors));
  CHECK(ledger.entry(Assumption::sensors).test == test);
  REQUIRE(ledger.departures.size() == 1);
  CHECK(std::ranges::count(ledger.departures.front(), Assumption::sensors) == 1);
  REQUIRE(ledger.joint);
  CHECK(ledger.joint->value.zeta == Approx(m.rig.zeta).epsilon(0.03));
  CHECK(ledger.joint->value.F0 == Approx(m.rig.F0).epsilon(0.03));
}

}  // namespace

TEST_CASE("A zero of x of half the swing is charged to the sensors and relaxed") {
  Measured m = measured(Kind::ramp, sensor_seed);
  const double zero = 0.6 * largest_deflection(m);
  for (double& x : m.record.histories.front().x) x += zero;
  check_charged_to_sensors(m, "zero of x free");
}

TEST_CASE("A delay of x of an eighth of a period is charged to the sensors") {
  check_charged_to_sensors(measured(Kind::ramp, sensor_seed, nullptr, {.delay = 0.12}), "delay of x free");
}

TEST_CASE("An AC coupling of x is charged to the sensors, by its corner frequency") {
  Measured m = measured(Kind::ramp, sensor_seed);
  History& history = m.record.histories.front();
  const double corner = 0.06 * m.rig.omega();
  double before = history.x.front();
  double passed = before;
  for (double& x : history.x) {  // r' = x' - corner r by the trapezoidal rule
    const double half = 0.5 * corner / history.sample_rate;
    passed = ((1.0 - half) * passed + x - before) / (1.0 + half);
    before = x;
    x = passed;
  }
  check_charged_to_sensors(m, "corner frequency of x free");
}

TEST_CASE("Delayed and high-passed readings and their derivatives are those of closed forms") {
  constexpr double rate = 200.0;
  constexpr double w = 9.0;
  constexpr Eigen::Index count = 400;
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(count, 0.0, (count - 1) / rate);
  const Eigen::VectorXd x = (w * t).sin();
  const Eigen::VectorXd v = w * (w * t).cos();
  // Cubics between samples miss (w/rate)^4/384 = 1e-8.
  for (const double delay : {-0.0031, 0.0, 0.05}) {
    const Eigen::VectorXd late = delayed(x, v, rate, delay);
    const Eigen::VectorXd exact = (w * (t - delay)).sin();
    CHECK((late - exact).segment(12, count - 24).cwiseAbs().maxCoeff() < 2e-8);
  }
  // r' = x' - g r, r(0) = 0: r = w/(g^2 + w^2) (g cos wt + w sin wt - g exp(-g t)). x' as a constant in each
  // interval misses (w/rate)^2/12 = 2e-4.
  constexpr double g = 1.5;
  const Eigen::VectorXd exact = w / (g * g + w * w) * (g * (w * t).cos() + w * (w * t).sin() - g * (-g * t).exp());
  const Eigen::VectorXd passed = high_passed(x, rate, g);
  CHECK((passed - exact).cwiseAbs().maxCoeff() < 2e-4);
  constexpr double little = 1e-4;
  const Eigen::VectorXd difference =
      (high_passed(x, rate, g + little) - high_passed(x, rate, g - little)) / (2.0 * little);
  CHECK((by_corner(passed, rate, g) - difference).cwiseAbs().maxCoeff() < 1e-3 * difference.cwiseAbs().maxCoeff());
}

TEST_CASE("A sensor of x whose line is bent is charged, and friction is not") {
  for (const int order : {2, 3}) {
    CAPTURE(order);
    Measured m = measured(Kind::ramp, sensor_seed);
    const double most = largest_deflection(m);
    for (double& x : m.record.histories.front().x) x += 0.01 * most * std::pow(x / most, order);
    const Ledger ledger = ledger_of(m.record, m.constants);
    const LedgerEntry& sensors = ledger.entry(Assumption::sensors);
    CHECK(sensors.test == (order == 2 ? "square term of the sensor of x" : "cubic term of the sensor of x"));
    CHECK(sensors.p_value.value_or(1.0) < 1e-3);
    for (const LedgerEntry& entry : ledger.entries) {
      CAPTURE(entry.test, entry.reason);
      CHECK((entry.assumption == Assumption::sensors || entry.standing != Standing::violated));
    }
    REQUIRE(ledger.joint);
    CHECK(ledger.joint->value.zeta == Approx(m.rig.zeta).epsilon(0.03));
    CHECK(ledger.joint->value.F0 == Approx(m.rig.F0).epsilon(0.03));
  }
}
