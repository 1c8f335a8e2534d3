#include "identify/ledger/relaxation_tests.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "identify/ledger/drift_or_speed.hpp"
#include "identify/ledger/ledger.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

/// A straight line over u in [-1, 1]. Relaxations: u^2, u^3, sin 3u, nearly equal in pairs, and the line itself.
JointModel line_with(double square, std::uint32_t number) {
  constexpr Eigen::Index count = 30;
  JointModel model;
  model.residuals.resize(count);
  model.base.resize(count, 2);
  model.relaxed.resize(count, 4);
  const dualdamp::core::RandomStream noise{3, number};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double u = 2.0 * static_cast<double>(i) / (count - 1.0) - 1.0;
    model.base.row(i) << u, 1.0;
    model.relaxed.row(i) << u * u, u * u * u, std::sin(3.0 * u), 2.0 * u;
    model.residuals[i] = square * u * u + noise.normal(static_cast<std::uint64_t>(i));
  }
  model.relaxations = {{Assumption::friction_velocity, "square"},
                       {Assumption::spring, "cube"},
                       {Assumption::one_mode, "sine"},
                       {Assumption::constants, "the line"}};
  model.value.zeta = 1.0;
  model.value.F0 = 1.0;
  return model;
}

}  // namespace

TEST_CASE("Friction over speed is named with a drift that it can stand for, by its term that explains most") {
  JointModel model;
  model.relaxations = {{.assumption = Assumption::stationarity, .is_like_speed = true},
                       {.assumption = Assumption::friction_velocity},
                       {.assumption = Assumption::friction_velocity},
                       {.assumption = Assumption::spring}};
  const std::vector<RelaxationTest> tests = {{.index = 0, .explained = 90.0},
                                             {.index = 1, .explained = 20.0},
                                             {.index = 2, .explained = 30.0},
                                             {.index = 3}};
  FoundDeparture drift{{tests[0]}};
  name_speed_beside_drift(model, tests, drift);
  REQUIRE(drift.explanations.size() == 2);
  CHECK(drift.explanations[1].index == 2);
  FoundDeparture both{{tests[1], tests[0]}};
  name_speed_beside_drift(model, tests, both);
  CHECK(both.explanations.size() == 2);
  FoundDeparture spring{{tests[3]}};
  name_speed_beside_drift(model, tests, spring);
  CHECK(spring.explanations.size() == 1);
}

TEST_CASE("An assumption is violated by its own change: explanations that move nothing are harmless beside it") {
  const Measured m = measured(Kind::response, 145, [](Rig& rig) { rig.saturation = 0.1; });
  const Ledger ledger = ledger_of(m.record, m.constants);
  REQUIRE(ledger.departures.size() == 1);
  CHECK(ledger.departures.front() == std::vector<Assumption>{Assumption::friction_velocity});
  const double p_value = *ledger.entry(Assumption::friction_velocity).p_value;
  int harmless = 0;
  for (const LedgerEntry& entry : ledger.entries) {
    if (entry.p_value != p_value) continue;
    const double change = std::max(std::abs(*entry.zeta_change), std::abs(*entry.F0_change));
    CHECK(ledger.is_violated(entry.assumption) == (change >= LedgerOptions{}.least_change));
    harmless += ledger.is_violated(entry.assumption) ? 0 : 1;
  }
  CHECK(harmless >= 3);
}

TEST_CASE("All tests of a record together reject once in twenty where nothing is wrong") {
  constexpr std::uint32_t records = 400;
  int rejected = 0;
  for (std::uint32_t i = 0; i < records; ++i)
    rejected += test_relaxations(line_with(0.0, i)).departures.empty() ? 0 : 1;
  // 20 expected, with a standard deviation of 4.4.
  CHECK(rejected >= 8);
  CHECK(rejected <= 33);
}

TEST_CASE("A departure is charged to the relaxation that explains it, and what it does to the base is told") {
  const RelaxationTests found = test_relaxations(line_with(5.0, 0));
  REQUIRE(found.departures.size() == 1);
  REQUIRE(found.departures[0].explanations.size() == 1);
  const RelaxationTest& test = found.departures[0].explanations[0];
  CHECK(test.index == 0);
  CHECK(test.p_value < 1e-4);
  // The mean of u^2 over the points is 0.356: the constant falls by this amount when the square is set free.
  CHECK(test.F0_change == Approx(-5.0 * 0.356).epsilon(0.35));
  CHECK(std::abs(test.zeta_change) < 1e-9);
}

TEST_CASE("A departure that has but one sign is tested on that side alone") {
  JointModel model = line_with(5.0, 0);
  const auto square = [&](int sign) {
    model.relaxations[0].sign = sign;
    const RelaxationTests found = test_relaxations(model);
    REQUIRE_FALSE(found.departures.empty());
    return std::ranges::any_of(found.departures, [](const FoundDeparture& departure) {
      return std::ranges::any_of(departure.explanations, [](const RelaxationTest& t) { return t.index == 0; });
    });
  };
  CHECK(square(1));
  model.relaxations[1].sign = 0;
  model.residuals += model.relaxed.col(1) * 6.0;  // another departure beside it
  CHECK_FALSE(square(-1));
}

TEST_CASE("A relaxation that is a base parameter in another guise is not tested") {
  const RelaxationTests found = test_relaxations(line_with(0.0, 1));
  CHECK(found.alone == std::vector<std::size_t>{3});
  CHECK(found.tests.size() == 3);
}

TEST_CASE("Relaxations that explain alike are named together") {
  JointModel model = line_with(0.0, 2);
  for (Eigen::Index i = 0; i < model.residuals.size(); ++i) model.residuals[i] += 6.0 * model.relaxed(i, 1);
  const RelaxationTests found = test_relaxations(model);
  REQUIRE(found.departures.size() == 1);
  REQUIRE(found.departures[0].explanations.size() == 2);  // beside a line, sin 3u is nearly u^3
}

TEST_CASE("A test that sees all that matters at a strict level leaves its level to the others") {
  // Forty terms hardly change the base parameters; the square changes the constant.
  const auto smallest_p = [](double share) {
    JointModel model = line_with(2.2, 5);
    constexpr Eigen::Index more = 40;
    const Eigen::Index own = model.relaxed.cols();
    model.relaxed.conservativeResize(Eigen::NoChange, own + more);
    const dualdamp::core::RandomStream random{4, 1};
    for (Eigen::Index j = own; j < own + more; ++j) {
      for (Eigen::Index i = 0; i < model.relaxed.rows(); ++i)
        model.relaxed(i, j) = random.normal(static_cast<std::uint64_t>(100 * j + i));
      // Orthogonal to the line, plus a share of the line: that share is the change of the base parameter.
      const Eigen::VectorXd term = model.relaxed.col(j);
      model.relaxed.col(j) = term - model.base * model.base.colPivHouseholderQr().solve(term);
      model.relaxed.col(j) += share * model.base.col(1);
      model.relaxations.push_back({Assumption::sensors, "noise"});
    }
    for (const RelaxationTest& test : test_relaxations(model).tests)
      if (test.index == 0) return test.p_value;
    return test_relaxations(model).departures.at(0).explanations.at(0).p_value;
  };
  CHECK(smallest_p(1e-4) < 0.5 * smallest_p(1.0));
}

TEST_CASE("A relaxation whose column is not finite is not tested, and the others are") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double beyond : {std::numeric_limits<double>::quiet_NaN(), infinity, 1e200}) {
    CAPTURE(beyond);
    JointModel model = line_with(5.0, 0);
    model.relaxed(7, 1) = beyond;
    const RelaxationTests found = test_relaxations(model);
    REQUIRE(found.departures.size() == 1);
    CHECK(found.departures[0].explanations[0].index == 0);
    for (const RelaxationTest& test : found.tests) CHECK(test.index != 1);
    CHECK(std::ranges::find(found.alone, std::size_t{1}) == found.alone.end());
  }
}

TEST_CASE("A relaxation that can hardly be told from one already charged is no second departure") {
  JointModel model = line_with(8.0, 4);
  // The fourth relaxation is the square but for 0.1 %, and the residuals hold some of this small difference.
  const Eigen::VectorXd u = 0.5 * model.relaxed.col(3);
  const Eigen::VectorXd wave = (9.0 * u.array()).cos();
  model.relaxed.col(3) = model.relaxed.col(0) + 1e-3 * wave;
  model.relaxations[3] = {Assumption::constants, "nearly the square"};
  model.residuals += 1.5 * wave;
  const RelaxationTests found = test_relaxations(model);
  REQUIRE(found.departures.size() == 1);
  CHECK(found.departures[0].explanations.size() == 2);
}

TEST_CASE("A fit that could not move from where it began still shows what a relaxation does to the base") {
  JointModel stuck = line_with(5.0, 0);
  stuck.residuals -=
      stuck.base * stuck.base.colPivHouseholderQr().solve(stuck.residuals).eval();  // at the plain fit
  JointModel model = stuck;
  model.refit = [stuck](const std::vector<std::size_t>&) { return stuck; };
  const RelaxationTests found = test_relaxations(model);
  REQUIRE_FALSE(found.departures.empty());
  const RelaxationTest& test = found.departures[0].explanations[0];
  CHECK(test.index == 0);
  CHECK(test.F0_change == Approx(-5.0 * 0.356).epsilon(0.35));
}

TEST_CASE("An assumption whose test rejects does not hold where it matters, however many departures were found") {
  // Three departures more than are relaxed one after another.
  const Measured m = measured(Kind::ramp, 800,
                              [](Rig& rig) {
                                rig.cubic = 0.02;
                                rig.drag = 0.3;
                                rig.stribeck = 0.3;
                                rig.drift = 0.3;
                                rig.asymmetry = 0.2;
                              },
                              {.delay = 0.01, .zero_drift = 0.5});
  const Ledger ledger = ledger_of(m.record, m.constants);
  CHECK(ledger.is_unexplained);
  CHECK_FALSE(ledger.joint);
  for (const LedgerEntry& entry : ledger.entries) {
    if (entry.p_value.value_or(1.0) >= 0.05) continue;
    CAPTURE(entry.test, *entry.p_value, entry.reason);
    const double change = std::max(std::abs(*entry.zeta_change), std::abs(*entry.F0_change));
    CHECK((entry.standing == Standing::violated || change < LedgerOptions{}.least_change));
  }
}

TEST_CASE("Errors of several stated numbers together are not taken for a further mode") {
  // The mass 1 % too small, both gains 1 % off: each of them alone explains the record less well than a further
  // mode.
  int violated = 0;
  int seen_as_mode = 0;
  int covered = 0;
  std::string charged;
  for (std::uint64_t seed = 600; seed < 606; ++seed) {
    const Measured m =
        measured(Kind::response, seed, nullptr, {.stiffness = 0.014, .gain = -0.01, .drive_gain = 0.01});
    LedgerOptions options;
    seen_as_mode += ledger_of(m.record, m.constants, options).is_violated(Assumption::one_mode) ? 1 : 0;
    options.uncertainties = {
        .mass = 0.01 * m.constants.mass, .stiffness = 0.01 * m.constants.stiffness, .gain_y = 0.01, .gain_x = 0.01};
    const Ledger ledger = ledger_of(m.record, m.constants, options);
    violated += ledger.departures.empty() ? 0 : 1;
    for (const std::vector<Assumption>& named : ledger.departures)
      for (const Assumption assumption : named) charged += std::string(name_of(assumption)) + " ";
    const bool has_interval = ledger.joint && ledger.joint->interval95;
    covered += has_interval && ledger.joint->interval95->zeta[0] <= m.rig.zeta &&
                       m.rig.zeta <= ledger.joint->interval95->zeta[1]
                   ? 1
                   : 0;
  }
  INFO(seen_as_mode << " " << violated << " " << charged << covered);
  CHECK(seen_as_mode >= 4);
  CHECK(violated <= 1);
  CHECK(covered >= 5);
}
