#include "identify/uncertainty/uncertain_constants.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "identify/methods.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double mass = 1.042;
constexpr double stiffness = 1568.0;
constexpr KnownConstants constants{mass, stiffness, unknown};

/// X_(i+1) = R X_i - x_f (1 + R) about an offset of zero, with noise.
Record decay(double R, double x_f, double noise, std::uint64_t seed) {
  Normal normal(seed);
  std::vector<double> values;
  double amplitude = 0.02;
  for (int i = 0; i < 9; ++i) {
    values.push_back((i % 2 == 0 ? amplitude : -amplitude) + noise * normal());
    amplitude = R * amplitude - x_f * (1.0 + R);
  }
  return extremes(values);
}

Estimate by_free_decay(const Record& record, const KnownConstants& known) {
  return find_method("free_decay")->run(record, known);
}

/// Half width of an interval, squared.
double square(const Interval& interval) {
  const double half = 0.5 * (interval[1] - interval[0]);
  return half * half;
}

}  // namespace

TEST_CASE("Uncertain constants widen the intervals by what they do to the estimate") {
  // zeta and x_f follow from the extremes alone; F0 = k x_f and c = 2 zeta sqrt(m k).
  const Record record = decay(0.9, 2e-4, 2e-5, 1);
  const Estimate exact = by_free_decay(record, constants);
  const ConstantUncertainties uncertainties{.mass = 0.02 * mass, .stiffness = 0.03 * stiffness};
  const Estimate wide = with_uncertainties(by_free_decay, record, constants, uncertainties);
  REQUIRE(exact.interval95);
  REQUIRE(wide.interval95);
  CHECK(wide.value.F0 == exact.value.F0);
  CHECK(wide.interval95->zeta == exact.interval95->zeta);
  CHECK(wide.interval95->x_f == exact.interval95->x_f);
  const double F0 = exact.value.F0;
  const double c = exact.value.c;
  CHECK(wide.std->F0 == Approx(std::hypot(exact.std->F0, 0.03 * F0)).epsilon(1e-6));
  CHECK(wide.std->c == Approx(std::hypot(exact.std->c, 0.01 * c, 0.015 * c)).epsilon(1e-3));
  const double normal = 1.959964;
  CHECK(square(wide.interval95->F0) ==
        Approx(square(exact.interval95->F0) + std::pow(normal * 0.03 * F0, 2)).epsilon(1e-5));
  CHECK((*wide.covariance)(1, 1) == Approx((*exact.covariance)(1, 1) + std::pow(0.03 * F0, 2)).epsilon(1e-6));
}

TEST_CASE("Without an interval it is said what the uncertain constants alone contribute") {
  // Two pairs tell the two parameters of a line without freedom; F0 is proportional to k.
  const Record record = pairs({{4.5e-3, 5.36e-3}, {5.05e-3, 8.15e-3}});
  const auto read = [](const Record& of, const KnownConstants& known) {
    return find_method("resonance_two_point")->run(of, known);
  };
  const Estimate exact = read(record, soft_spring);
  REQUIRE(exact.outcome.ok());
  REQUIRE_FALSE(exact.interval95);
  const ConstantUncertainties uncertainties{.stiffness = 0.03 * stiffness};
  const Estimate told = with_uncertainties(read, record, soft_spring, uncertainties);
  CHECK_FALSE(told.interval95);
  REQUIRE(told.warnings.size() == exact.warnings.size() + 1);
  CHECK_THAT(told.warnings.back(), Catch::Contains("of zeta and 0.13 N of F0"));
}

TEST_CASE("Each uncertainty counts alone, as a share of its number") {
  CHECK_FALSE(ConstantUncertainties{}.any());
  const KnownConstants known{2.0, 400.0, 10.0};
  for (const StatedNumber& number : stated_numbers) {
    CAPTURE(number.text());
    ConstantUncertainties alone;
    alone.*number.uncertainty = 0.5;
    CHECK(alone.any());
    CHECK(number.relative(alone, known) == (number.is_gain() ? 0.5 : 0.5 / known.*number.constant));
    const bool is_known = number.relative(alone, {}) >= 0.0;  // of an unknown constant there is none
    CHECK(is_known == number.is_gain());
    CHECK(number.relative({}, {}) == 0.0);
  }
  // m w^2/k with dm/m = 1 %, dk/k = 2 % and dw/w = 1 %
  CHECK(relative_of_inertia({.mass = 0.02, .stiffness = 8.0, .frequency = 0.1}, known) ==
        Approx(0.01 * std::sqrt(1.0 + 4.0 + 4.0)));
}

TEST_CASE("The gain of a sensor that is uncertain makes lengths uncertain") {
  const Record record = decay(0.9, 2e-4, 2e-5, 2);
  const Estimate exact = by_free_decay(record, constants);
  const Estimate wide = with_uncertainties(by_free_decay, record, constants, {.gain_x = 0.05});
  CHECK(wide.interval95->zeta[1] == Approx(exact.interval95->zeta[1]).epsilon(1e-6));
  CHECK(wide.std->x_f == Approx(std::hypot(exact.std->x_f, 0.05 * exact.value.x_f)).epsilon(1e-6));
}

TEST_CASE("Intervals with stated uncertainties hold the truth as often as they say") {
  constexpr int records = 400;
  const double R = 0.9;
  const double x_f = 2e-4;
  const double L = -std::log(R) / std::numbers::pi;
  const double zeta = L / std::sqrt(1.0 + L * L);
  const double c = 2.0 * zeta * std::sqrt(mass * stiffness);
  int with_F0 = 0;
  int with_c = 0;
  int with_F0_unstated = 0;
  const ConstantUncertainties uncertainties{.mass = 0.1 * mass, .stiffness = 0.1 * stiffness, .gain_x = 0.05};
  const auto holds = [](const Interval& interval, double truth) {
    return interval[0] <= truth && truth <= interval[1] ? 1 : 0;
  };
  for (int seed = 0; seed < records; ++seed) {
    Normal normal(static_cast<std::uint64_t>(5000 + seed));
    const KnownConstants stated{mass * (1.0 + 0.1 * normal()), stiffness * (1.0 + 0.1 * normal()), unknown};
    const double gain = 1.0 + 0.05 * normal();
    Record record = decay(R, x_f, 3e-6, 9000U + static_cast<std::uint64_t>(seed));
    for (double& extreme : record.decay->extremes) extreme *= gain;
    const Estimate estimate = with_uncertainties(by_free_decay, record, stated, uncertainties);
    REQUIRE(estimate.interval95);
    with_F0 += holds(estimate.interval95->F0, stiffness * x_f);
    with_c += holds(estimate.interval95->c, c);
    with_F0_unstated += holds(by_free_decay(record, stated).interval95->F0, stiffness * x_f);
  }
  CHECK(with_F0 >= 0.92 * records);
  CHECK(with_F0 <= 0.98 * records);
  CHECK(with_c >= 0.92 * records);
  CHECK(with_c <= 0.98 * records);
  CHECK(with_F0_unstated < 0.7 * records);
}

TEST_CASE("Sensitivities say what one percent of each constant would do") {
  const Record record = decay(0.9, 2e-4, 0.0, 3);
  const std::vector<Sensitivity> list =
      sensitivities(by_free_decay, by_free_decay(record, constants), record, constants, {});
  REQUIRE(list.size() == 2);
  for (const Sensitivity& one : list) {
    CAPTURE(one.constant);
    CHECK((one.constant == "stiffness" || one.constant == "gain of x"));
    CHECK(one.F0_change == Approx(0.01).epsilon(1e-6));
    CHECK(one.zeta_change == Approx(0.0).margin(1e-9));
  }
  // One whose uncertainty is stated is in the intervals already.
  CHECK(sensitivities(by_free_decay, by_free_decay(record, constants), record, constants, {.stiffness = 1.0})
            .size() == 1);
}

TEST_CASE("Where a constant cannot be lower by its uncertainty, the higher one alone counts") {
  const Record record = decay(0.9, 2e-4, 2e-5, 4);
  const Estimate exact = by_free_decay(record, constants);
  const Estimate wide = with_uncertainties(by_free_decay, record, constants, {.mass = 1.2 * mass});
  const double change = (std::sqrt(2.2) - 1.0) * exact.value.c;
  CHECK(wide.std->c == Approx(std::hypot(exact.std->c, change)).epsilon(1e-6));
}

TEST_CASE("A constant that moves the bias of a method alone widens its intervals, and is among the sensitivities") {
  // A line at resonance does not ask for the frequency: only what its formula neglects does. Den Hartog's law at
  // resonance, and a stated frequency that is 1 % too high, as its uncertainty says.
  const double zeta = 0.025;
  const double omega = std::sqrt(stiffness / mass);
  const auto law = dualdamp::sim::analytic::den_hartog(zeta, 1.0);
  Normal normal(11);
  std::vector<std::pair<double, double>> levels;
  for (int i = 0; i < 24; ++i) {
    const double Y = 4e-4 * (1.0 + 0.05 * i);
    levels.emplace_back(Y, dualdamp::sim::analytic::amplitude(law, Y, 1.6e-4).value() * (1.0 + 0.002 * normal()));
  }
  const Record record = pairs(levels);
  const KnownConstants stated{mass, stiffness, 1.01 * omega};
  const Reader read = [](const Record& r, const KnownConstants& known) {
    return find_method("resonance_least_squares")->run(r, known);
  };
  const Estimate without = read(record, stated);
  REQUIRE(without.interval95);
  CHECK(without.value.zeta == Approx(zeta).epsilon(0.02));
  CHECK(without.interval95->zeta[1] < zeta);
  const Estimate wide = with_uncertainties(read, record, stated, {.frequency = 0.01 * omega});
  CHECK(wide.interval95->zeta[0] < zeta);
  CHECK(wide.interval95->zeta[1] > zeta);
  CHECK(sensitivities(read, without, record, stated, {}).front().constant == "frequency");
}

TEST_CASE("Sensitivities of a rail without spring are those of F0: there is no zeta to compare them by") {
  History history{.sample_rate = 500.0};
  Normal normal(3);
  for (int i = 0; i < 2000; ++i) {
    const double t = i / history.sample_rate;
    const double w = 2.0 * std::numbers::pi * 0.7;
    const double v = 0.2 * w * std::cos(w * t);
    history.x.push_back(0.2 * std::sin(w * t) + 1e-6 * normal());
    history.force.push_back(-3.0 * 0.2 * w * w * std::sin(w * t) + 20.0 * v + std::copysign(8.0, v) +
                            0.05 * normal());
  }
  Record record;
  record.histories.push_back(history);
  const KnownConstants rail{3.0, 0.0, unknown};
  const Reader read = [](const Record& r, const KnownConstants& known) {
    return find_method("recursive_least_squares")->run(r, known);
  };
  const std::vector<Sensitivity> list = sensitivities(read, read(record, rail), record, rail, {});
  REQUIRE(list.size() >= 2);
  for (std::size_t i = 0; i < list.size(); ++i) {
    CHECK(std::isnan(list[i].zeta_change));
    if (i > 0) CHECK(std::abs(list[i].F0_change) <= std::abs(list[i - 1].F0_change));
  }
}
