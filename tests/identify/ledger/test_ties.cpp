#include "identify/statistics/ties.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "identify/ledger/estimate/stated_shares.hpp"
#include "identify/ledger/ledger.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A straight line with a curvature that a mass and a stiffness explain alike, its rows in any order.
JointModel alike(const std::vector<Eigen::Index>& order) {
  const auto count = static_cast<Eigen::Index>(order.size());
  JointModel model;
  model.residuals.resize(count);
  model.base.resize(count, 2);
  model.relaxed.resize(count, 4);
  const dualdamp::core::RandomStream noise{5, 1};
  for (Eigen::Index row = 0; row < count; ++row) {
    const Eigen::Index i = order[static_cast<std::size_t>(row)];
    const double u = 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0;
    model.base.row(row) << u, 1.0;
    model.relaxed.row(row) << std::sin(3.0 * u), 3.7 * u * u + 0.3 * u, -1.3 * u * u + 0.7, u * u * u;
    model.residuals[row] = 3.0 * u * u + noise.normal(static_cast<std::uint64_t>(i));
  }
  model.relaxations = {{Assumption::one_mode, "sine"},
                       {.assumption = Assumption::constants, .test = "mass", .freed = Freed::mass},
                       {.assumption = Assumption::constants, .test = "stiffness", .freed = Freed::stiffness},
                       {Assumption::spring, "cube"}};
  model.value.zeta = model.value.F0 = 1.0;
  return model;
}

/// Mass and stiffness behind the numbers of an estimate.
std::pair<double, double> constants_of(const ParameterSet& value) {
  const double stiffness = value.F0 / value.x_f;
  return {std::pow(value.c / (2.0 * value.zeta), 2) / stiffness, stiffness};
}

/// A stiffness that is stated 5 % too low.
Measured too_soft(Kind kind) { return measured(kind, 21, nullptr, {.stiffness = -0.05, .states = 7}); }

void check_same(const Ledger& a, const Ledger& b, double scale) {
  REQUIRE(a.joint);
  REQUIRE(b.joint);
  REQUIRE(a.joint->interval95);
  REQUIRE(b.joint->interval95);
  CHECK(b.relaxed == a.relaxed);
  CHECK(b.departures == a.departures);
  const auto same = [](double one, double other) { return Approx(other).epsilon(1e-6).margin(1e-12) == one; };
  CHECK(same(b.joint->value.zeta, a.joint->value.zeta));
  CHECK(same(b.joint->value.c, a.joint->value.c));
  CHECK(same(b.joint->value.F0, scale * a.joint->value.F0));
  for (std::size_t end = 0; end < 2; ++end) {
    CHECK(same(b.joint->interval95->zeta[end], a.joint->interval95->zeta[end]));
    CHECK(same(b.joint->interval95->F0[end], scale * a.joint->interval95->F0[end]));
  }
  CHECK(b.entry(Assumption::constants).test == a.entry(Assumption::constants).test);
  CHECK(b.entry(Assumption::constants).wanted == a.entry(Assumption::constants).wanted);
}

}  // namespace

TEST_CASE("Keys that differ by rounding alone are sorted by the second order") {
  std::vector<std::pair<double, int>> list = {{1.0, 4}, {2.0 + 1e-9, 3}, {2.0, 2}, {2.0 - 1e-9, 1}, {3.0, 5}};
  sort_with_ties(list, &std::pair<double, int>::first,
                 [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<int> order;
  for (const auto& [key, number] : list) order.push_back(number);
  CHECK(order == std::vector<int>{5, 1, 2, 3, 4});
  CHECK(is_tie(infinity, infinity));
  CHECK_FALSE(is_tie(1.0, infinity));
  CHECK_FALSE(is_tie(1e-20, 2e-20));
  CHECK(is_tie(1e-20, 2e-20, 1.0));
}

TEST_CASE("Relaxations that explain the same but for rounding keep their order, and p-values theirs, in any rows") {
  std::vector<Eigen::Index> order(30);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::mt19937_64 random(3);
  std::vector<double> p_values;
  for (int i = 0; i < 20; ++i) {
    const RelaxationTests found = test_relaxations(alike(order));
    REQUIRE_FALSE(found.departures.empty());
    const std::vector<RelaxationTest>& best = found.departures.front().explanations;
    REQUIRE(best.size() >= 2);
    CHECK(best[0].index == 1);
    CHECK(best[1].index == 2);
    p_values.push_back(std::log(best[0].p_value));
    // That of the constant that is uncertain comes first.
    const RelaxationTests uncertain = test_relaxations(alike(order), {.mass = 0.01, .stiffness = 0.02});
    CHECK(uncertain.departures.front().explanations.front().index == 2);
    std::ranges::shuffle(order, random);
  }
  const auto [least, most] = std::ranges::minmax(p_values);
  CHECK(most - least < 1e-6);
}

TEST_CASE("A mass and a stiffness share what k/m is off by the squares of their stated uncertainties") {
  const KnownConstants stated{2.0, 800.0, unknown};
  const KnownConstants fitted{2.0, 800.0 * std::exp(0.03), unknown};
  const auto shared = [&](double mass, double stiffness) {
    return StatedShares(stated, {.mass = 2.0 * mass, .stiffness = 800.0 * stiffness}).of(fitted);
  };
  CHECK(shared(0.0, 0.04).stiffness == Approx(fitted.stiffness));
  CHECK(shared(0.0, 0.04).mass == Approx(2.0));
  CHECK(shared(0.04, 0.0).stiffness == Approx(800.0));
  CHECK(shared(0.04, 0.0).mass == Approx(2.0 * std::exp(-0.03)));
  // The most probable of two normal errors: the mean of 0.03 by the weights 1 and 4.
  CHECK(shared(0.01, 0.02).stiffness == Approx(800.0 * std::exp(0.024)));
  CHECK(shared(0.01, 0.02).mass == Approx(2.0 * std::exp(-0.006)));
  // Half a per cent is excluded: the mass, of which nothing is stated, counts with 1 %.
  CHECK(shared(0.0, 0.005).mass == Approx(2.0 * std::exp(-0.024)));
}

TEST_CASE("The order of states, the unit of lengths and the twelfth digit of a constant leave the answer alone") {
  const Measured m = too_soft(Kind::response);
  const Ledger plain = ledger_of(m.record, m.constants);
  REQUIRE(plain.is_violated(Assumption::constants));
  std::mt19937_64 random(7);
  for (const double scale : {1.0, 7.3}) {
    Measured other = too_soft(Kind::response);
    std::ranges::shuffle(other.record.pairs->pairs, random);
    for (Pair& pair : other.record.pairs->pairs)
      for (double* length : {&pair.x, &pair.Y, &pair.fundamental}) *length *= scale;
    other.constants.mass *= 1.0 + 1e-11;
    check_same(plain, ledger_of(other.record, other.constants), scale);
  }
}

TEST_CASE("What the stated uncertainties allow is charged to the constant that is uncertain") {
  const Measured m = too_soft(Kind::extremes);
  const double mass = m.constants.mass;
  const double stiffness = m.constants.stiffness;
  const auto with = [&](double of_mass, double of_stiffness) {
    const ConstantUncertainties u{.mass = of_mass * mass, .stiffness = of_stiffness * stiffness};
    const Ledger ledger = ledger_of(m.record, m.constants, {.uncertainties = u});
    CHECK(ledger.departures.empty());
    CHECK(ledger.entry(Assumption::constants).is_as_stated);
    REQUIRE(ledger.joint);
    return *ledger.joint;
  };
  const Estimate soft = with(0.0, 0.04);
  CHECK(constants_of(soft.value).first == Approx(mass));
  CHECK(constants_of(soft.value).second == Approx(m.rig.k).epsilon(0.01));
  CHECK(soft.value.F0 == Approx(m.rig.F0).epsilon(0.05));
  CHECK(constants_of(with(0.04, 0.0).value).second == Approx(stiffness));
  const auto [half_mass, half_stiffness] = constants_of(with(0.04, 0.04).value);
  CHECK(half_mass * half_stiffness == Approx(mass * stiffness));
}

TEST_CASE("A free history has the same zeta and interval in every unit of mass, length and time") {
  const auto ledger_with = [](double mass, double length, double rate) {
    Measured m = measured(Kind::decay, 100);
    for (double& x : m.record.histories.front().x) x *= length;
    m.record.histories.front().sample_rate *= rate;
    m.constants.mass *= mass;
    m.constants.stiffness *= mass * rate * rate;
    return ledger_of(m.record, m.constants, {});
  };
  const Ledger plain = ledger_with(1.0, 1.0, 1.0);
  REQUIRE(plain.joint);
  // Powers of two change no digit; a root of mass times stiffness does where the power is odd.
  for (const auto& [mass, length, rate] : {std::array{0.25, 1.0, 1.0},
                                           {0.5, 1.0, 1.0},
                                           {1.0 / 1024.0, 1.0, 1.0},
                                           {16.0, 1.0, 1.0},
                                           {1.0, 0.125, 1.0},
                                           {1.0, 1024.0, 1.0},
                                           {1.0, 1.0, 0.125},
                                           {1.0, 1.0, 64.0},
                                           {0.25, 8.0, 16.0},
                                           {0.01, 3.0, 7.0}}) {
    CAPTURE(mass, length, rate);
    const Ledger scaled = ledger_with(mass, length, rate);
    REQUIRE(scaled.joint);
    const double force = mass * length * rate * rate;
    for (std::size_t end = 0; end < 2; ++end) {
      CHECK(scaled.joint->interval95->zeta[end] == Approx(plain.joint->interval95->zeta[end]).epsilon(1e-7));
      CHECK(scaled.joint->interval95->F0[end] == Approx(force * plain.joint->interval95->F0[end]).epsilon(1e-7));
    }
    for (std::size_t i = 0; i < plain.entries.size(); ++i)
      CHECK(scaled.entries[i].p_value.value_or(1.0) == Approx(plain.entries[i].p_value.value_or(1.0)).margin(1e-6));
  }
}
