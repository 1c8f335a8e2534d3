#include "identify/ledger/histories/history_model.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "core/random.hpp"
#include "identify/answer/answer.hpp"
#include "identify/ledger/histories/history_rows.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods/histories/friction_force.hpp"
#include "identify/methods/histories/output_error.hpp"
#include "identify/statistics/least_squares.hpp"
#include "tests/identify/ledger/laboratory.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t first_seed = 100;

bool lists(const JointModel& model, const std::string& test) {
  return std::ranges::find(model.relaxations, test, &Relaxation::test) != model.relaxations.end();
}

}  // namespace

TEST_CASE(
    "Many histories give way to their steady states, because the work grows with the third power of their number") {
  const History one = {.sample_rate = 100.0, .y = std::vector<double>(1000), .x = std::vector<double>(1000)};
  Record record;
  record.pairs.emplace();
  const auto fault_of = [&](std::size_t count) {
    record.histories.assign(count, one);
    return fault_of_histories(record);
  };
  CHECK(fault_of(4).empty());
  CHECK_THAT(fault_of(30), Catch::Contains("steady states"));
  record.pairs.reset();
  CHECK(fault_of(30).empty());
}

TEST_CASE("A free history without extremes is not tested, and says why; a driven one needs none") {
  Record record;
  record.histories = {{.sample_rate = 100.0, .x = {9e-3, 8e-3, 6e-3, 4e-3, 3e-3, 2e-3, 1e-3, 1e-3, 0.0, 0.0}}};
  CHECK(fault_of_histories(record) == "x has fewer than 16 samples");
  record.histories.front().force.assign(10, 1.0);
  CHECK(fault_of_histories(record).empty());
}

TEST_CASE("The stated noise of x makes the intervals of a history, unless its samples scatter clearly more") {
  const auto width = [](double stated, std::size_t warnings) {
    const Measured m = measured(Kind::decay, 6'300'003, nullptr, {.stated_noise = stated});
    const Ledger ledger = ledger_of(m.record, m.constants, {.deviations = m.deviations});
    CHECK(ledger.warnings.size() == warnings);
    const JointModel model = std::get<JointModel>(history_model(m.record, m.constants, m.deviations.sigma_x));
    const std::optional<Eigen::MatrixXd> covariance = unit_covariance(model.base);
    REQUIRE(covariance);
    return std::pair(model.is_stated, std::sqrt((*covariance)(0, 0)));
  };
  const auto [none, own] = width(0.0, 0);
  CHECK_FALSE(none);
  const auto [exact, as_stated] = width(1.0, 0);
  CHECK(exact);
  CHECK(as_stated == Approx(own).epsilon(0.1));
  CHECK(width(1.2, 0).second == Approx(1.2 * as_stated).epsilon(0.01));
  CHECK(width(3.0, 1).second == Approx(3.0 * as_stated).epsilon(0.01));
  const Measured m = measured(Kind::decay, 6'300'003);
  CHECK(ledger_of(m.record, m.constants, {.deviations = {.sigma_Y = 1e-4}}).warnings.size() == 1);
  const auto [used, too_small] = width(0.3, 1);
  CHECK_FALSE(used);
  CHECK(too_small == Approx(own));
}

TEST_CASE("A drift in decays from one amplitude is like friction over speed, under a force or from two it is not") {
  const auto like_speed = [](const Record& record, const KnownConstants& constants) {
    const JointModel model = std::get<JointModel>(history_model(record, constants));
    for (const Relaxation& relaxation : model.relaxations)
      CHECK((!relaxation.is_like_speed || relaxation.assumption == Assumption::stationarity));
    return std::ranges::count_if(model.relaxations, &Relaxation::is_like_speed);
  };
  Measured m = measured(Kind::decay, first_seed);
  CHECK(like_speed(m.record, m.constants) == 2);  // of the friction force, of the damping; not of the zero
  m.record.histories.push_back(m.record.histories.front());
  CHECK(like_speed(m.record, m.constants) == 2);
  for (double& x : m.record.histories.back().x) x *= 1.6;
  CHECK(like_speed(m.record, m.constants) == 0);
  const Measured forced = measured(Kind::forced, first_seed);
  CHECK(like_speed(forced.record, forced.constants) == 0);
}

TEST_CASE("Constants of a decay that are off by a large factor are charged, and no single fit answers") {
  for (const double factor : {0.25, 2.0}) {
    CAPTURE(factor);
    Measured m = measured(Kind::decay, first_seed);
    m.constants.stiffness *= factor;
    const Ledger ledger = ledger_of(m.record, m.constants);
    REQUIRE(ledger.is_violated(Assumption::constants));
    CHECK(ledger.entry(Assumption::constants).p_value.value_or(1.0) < 1e-6);
    const Identification found = concluded({output_error(m.record, m.constants, {})}, ledger);
    CHECK_FALSE(found.estimates[0].usable);
  }
}

TEST_CASE("A swing out of step with a linear spring is charged to the spring, with its effect") {
  Measured m;
  m.rig = {.m = 0.061, .k = 2.2, .zeta = 0.011, .F0 = 0.013, .cubic = -1.0 / 6.0, .L = 1.0};  // a pendulum, in rad
  constexpr double rate = 100.0;
  const auto motion = motion_of(m.rig, [](double) { return 0.0; }, 21.0, rate, 1.0);
  const dualdamp::core::RandomStream noise{7, 1};
  History history{.sample_rate = rate};
  for (std::size_t i = 0; i < motion.x.size(); ++i)
    history.x.push_back(motion.x[i] + 0.0017 * noise.normal(static_cast<std::uint64_t>(i)));
  m.record.histories.push_back(history);
  m.constants = {m.rig.m, m.rig.k, unknown};
  const Ledger ledger = ledger_of(m.record, m.constants);
  const LedgerEntry& spring = ledger.entry(Assumption::spring);
  CHECK(spring.standing == Standing::violated);
  CHECK(std::abs(spring.zeta_change.value_or(0.0)) > 0.02);
  CHECK_FALSE(ledger.is_violated(Assumption::constants));
  REQUIRE(ledger.joint);
  CHECK(ledger.joint->value.zeta == Approx(0.011).epsilon(0.02));
  CHECK(ledger.joint->value.F0 == Approx(0.013).epsilon(0.02));
}

TEST_CASE("The place of a step of the drive between two samples is no delay of a sensor") {
  Measured m;
  m.rig = {.m = 1.5, .k = 2000.0, .zeta = 0.055, .F0 = 4.0};
  constexpr double rate = 500.0;
  const auto force = [](double t) { return t < 1.0004 ? 20.0 * t : 0.0; };  // of a wire that is cut
  const auto motion = motion_of(m.rig, force, 2.0, 10.0 * rate);
  const dualdamp::core::RandomStream noise{6, 1};
  History history{.sample_rate = rate};
  for (std::size_t i = 0; i < motion.x.size() / 10; ++i) {
    history.x.push_back(motion.x[10 * i] + 1e-5 * noise.normal(2 * i));
    history.force.push_back(motion.drive[10 * i] + 0.01 * noise.normal(2 * i + 1));
  }
  m.record.histories.push_back(history);
  m.constants = {m.rig.m, m.rig.k, unknown};
  const Ledger ledger = ledger_of(m.record, m.constants);
  CHECK(ledger.departures.empty());
  REQUIRE(ledger.joint);
  CHECK(ledger.joint->value.zeta == Approx(0.055).epsilon(0.01));
}

TEST_CASE("A force that is cut between two samples is no departure of friction") {
  Measured m;
  m.rig = {.m = 2.0, .k = 3000.0, .zeta = 0.06, .F0 = 1.0};
  const double omega = m.rig.omega();
  const double rate = 60.0 * omega / (2.0 * std::numbers::pi);
  constexpr int finer = 10;
  const double end = 18.3 * 2.0 * std::numbers::pi / omega;
  const auto force = [&](double t) { return t < end ? 3.6 * std::sin(omega * t) : 0.0; };
  const auto motion = motion_of(m.rig, force, 6.0, finer * rate);
  for (const std::uint32_t draw : {1U, 2U}) {
    const dualdamp::core::RandomStream noise{41, draw};
    History history{.sample_rate = rate};
    for (std::size_t i = 0; i < motion.x.size() / finer; ++i) {
      history.x.push_back(motion.x[finer * i] + 2e-6 * noise.normal(2 * i));
      history.force.push_back(motion.drive[finer * i] + 0.0015 * noise.normal(2 * i + 1));
    }
    m.record.histories = {history};
    m.constants = {m.rig.m, m.rig.k, unknown};
    const Ledger ledger = ledger_of(m.record, m.constants);
    CAPTURE(draw);
    for (const LedgerEntry& entry : ledger.entries) {
      CAPTURE(entry.test, entry.p_value.value_or(1.0));
      CHECK(entry.standing != Standing::violated);
    }
    REQUIRE(ledger.joint);
    CHECK(ledger.joint->value.zeta == Approx(0.06).epsilon(0.01));
    CHECK(ledger.joint->value.F0 == Approx(1.0).epsilon(0.01));
  }
}

TEST_CASE("A zero that is off and drifts is no friction of one direction for certain") {
  Measured m;
  m.rig = {.m = 0.8, .k = 1200.0, .zeta = 0.0145, .F0 = 1.1};
  constexpr double rate = 200.0;
  const auto motion = motion_of(m.rig, [](double) { return 0.0; }, 4.0, rate, 0.025);
  const dualdamp::core::RandomStream noise{5, 1};
  History history{.sample_rate = rate};
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(motion.x.size());
    history.x.push_back(motion.x[i] + 3e-4 + 1.5e-3 * share + 1e-5 * noise.normal(static_cast<std::uint64_t>(i)));
  }
  m.record.histories.push_back(history);
  m.constants = {m.rig.m, m.rig.k, unknown};
  const Ledger ledger = ledger_of(m.record, m.constants);
  CHECK(ledger.is_violated(Assumption::stationarity));
  CHECK(ledger.is_violated(Assumption::symmetry));
  CHECK(ledger.is_violated(Assumption::sensors));
  CHECK(ledger.entry(Assumption::sensors).test == "zero of x free");
}

TEST_CASE("The history of the drive is asked for only where it is missing") {
  const auto about = [](Kind kind) {
    const Measured m = measured(kind, first_seed);
    return ledger_of(m.record, m.constants).entry(Assumption::drive).reason;
  };
  CHECK(about(Kind::decay) == "a free vibration has no drive");
  CHECK(about(Kind::random).find("the measured drive enters the model as it is") == 0);
  CHECK(about(Kind::xy).find("the history of the drive would show it") != std::string::npos);
}

TEST_CASE("A history without a stated mass is told to state one, not to record a history") {
  Measured m = measured(Kind::decay, first_seed);
  m.constants.mass = unknown;
  const Ledger ledger = ledger_of(m.record, m.constants);
  for (const Assumption assumption : {Assumption::constants, Assumption::one_mode})
    CHECK(ledger.entry(assumption).reason.starts_with("no mass is stated"));
}

TEST_CASE("A simulated motion that misses the record tests nothing") {
  Measured m = measured(Kind::random, first_seed);
  // The first part, a motion that the force does not make.
  History& history = m.record.histories[0];
  const std::size_t length = history.x.size() / 4;
  for (std::vector<double>* column : {&history.y, &history.x, &history.v, &history.a, &history.force})
    if (!column->empty()) column->resize(length);
  std::ranges::reverse(history.x);
  const auto model = history_model(m.record, m.constants);
  REQUIRE(std::holds_alternative<std::string>(model));
  CHECK(std::get<std::string>(model).find("whatever the mass, the stiffness, the zero of x") != std::string::npos);
}

TEST_CASE("A decay of x alone charges no gain and no delay of x") {
  const auto alter = [](Rig& rig) { rig.stribeck = 0.6; };
  for (std::uint64_t seed = first_seed; seed < first_seed + 4; ++seed) {
    CAPTURE(seed);
    const Measured m = measured(Kind::decay, seed, alter);
    const auto model = history_model(m.record, m.constants);
    REQUIRE(std::holds_alternative<JointModel>(model));
    CHECK_FALSE(lists(std::get<JointModel>(model), "gain of x free"));
    CHECK_FALSE(lists(std::get<JointModel>(model), "delay of x free"));
    CHECK(ledger_of(m.record, m.constants).is_violated(Assumption::friction_velocity));
  }
  const Measured with_v = measured(Kind::decay, first_seed, nullptr, {.v_noise = 0.02});
  CHECK(lists(std::get<JointModel>(history_model(with_v.record, with_v.constants)), "gain of x free"));
}

TEST_CASE("A test that would see only a huge departure leaves its assumption untested") {
  int blind = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + 10; ++seed) {
    const Measured m = measured(Kind::xy, seed, nullptr, {.noise = 10.0});
    const Ledger ledger = ledger_of(m.record, m.constants);
    for (const LedgerEntry& entry : ledger.entries) {
      if (!entry.reason.starts_with("only a departure that moves")) continue;
      ++blind;
      CHECK(entry.standing == Standing::untested);
      CHECK_FALSE(entry.p_value);
    }
  }
  CHECK(blind > 0);
}

namespace {

/// 30 periods at one level of a moving base, from rest.
Measured on_moving_base(std::uint32_t seed) {
  Measured m;
  m.rig = {.m = 0.33244, .k = 188.94, .zeta = 0.07455, .F0 = 0.2618, .on_base = true};
  constexpr double rate = 284.57;
  constexpr double Y = 0.00417;
  const double omega = 0.9375 * m.rig.omega();
  const auto y = [=](double t) { return Y * std::cos(omega * t + 0.3); };
  const auto motion = motion_of(m.rig, [&](double t) { return m.rig.k * y(t); }, 7.03, rate);
  const dualdamp::core::RandomStream noise{7, seed};
  History history{.sample_rate = rate};
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    history.x.push_back(motion.x[i] + 4e-5 * noise.normal(2 * i));
    history.y.push_back(y(static_cast<double>(i) / rate) + 1e-5 * noise.normal(2 * i + 1));
  }
  m.record.histories.push_back(history);
  m.constants = {m.rig.m, m.rig.k, unknown};
  return m;
}

}  // namespace

TEST_CASE("A stiffness 10 to 20 % too high beside one steady level is charged, with the value that fits") {
  Measured m = on_moving_base(1);
  const Identification right = concluded({friction_force(m.record, m.constants)}, ledger_of(m.record, m.constants));
  CHECK(right.estimates[0].usable);
  // As stated, the motion is only fitted with damping below zero, where noise in the drive grows.
  for (const double factor : {1.1, 1.15, 1.2}) {
    CAPTURE(factor);
    m.constants.stiffness = factor * m.rig.k;
    const Ledger ledger = ledger_of(m.record, m.constants);
    REQUIRE(ledger.is_violated(Assumption::constants));
    CHECK(mentions(ledger.entry(Assumption::constants).wanted, "a stiffness of 18"));
    const Identification found = concluded({friction_force(m.record, m.constants)}, ledger);
    CHECK_FALSE(found.estimates[0].usable);
    CHECK(mentions(found.reason, "mass, stiffness and frequency are as stated"));
    CHECK(mentions(found.verdict, "they fit " + ledger.entry(Assumption::constants).wanted));
  }
}

namespace {

/// The least p of the family of tests.
double least_p(const Ledger& ledger) {
  double least = 1.0;
  for (const LedgerEntry& entry : ledger.entries) least = std::min(least, entry.p_value.value_or(1.0));
  return least;
}

}  // namespace

TEST_CASE("A true record of x and a contradicts nothing, whatever the zero of a") {
  int charged = 0;
  // A model of a that is less accurate than the sensor is seen in all of them.
  for (const Kind kind : {Kind::decay, Kind::forced, Kind::beat, Kind::ramp}) {
    CAPTURE(name_of(kind));
    constexpr int records = 6;
    int seen = 0;
    for (std::uint64_t seed = first_seed; seed < first_seed + records; ++seed) {
      CAPTURE(seed);
      const auto ledger_with = [&](double zero) {
        const Measured m = measured(kind, seed, nullptr, {.a_noise = 0.001, .zero = zero, .samples = 25.0});
        return ledger_of(m.record, m.constants);
      };
      const Ledger ledger = ledger_with(0.0);
      seen += least_p(ledger) < family_level ? 1 : 0;
      charged += std::ranges::any_of(assumptions(), [&](Assumption a) { return ledger.is_violated(a); }) ? 1 : 0;
      const Ledger off = ledger_with(0.5);
      CHECK(off.plain.F0 == Approx(ledger.plain.F0).epsilon(1e-6));
      CHECK(least_p(off) == Approx(least_p(ledger)).margin(0.05));
    }
    CHECK(seen <= 2);
  }
  CHECK(charged <= 1);  // of 24, at a level of 5 %
}

TEST_CASE("The zero of v moves no estimate of the joint model") {
  for (const Kind kind : {Kind::decay, Kind::beat}) {
    const auto ledger_with = [&](double zero) {
      const Measured m = measured(kind, first_seed, nullptr, {.v_noise = 0.002, .zero = zero});
      return ledger_of(m.record, m.constants);
    };
    const Ledger right = ledger_with(0.0);
    const Ledger off = ledger_with(5.0);
    REQUIRE(right.joint);
    REQUIRE(off.joint);
    CHECK(off.joint->value.zeta == Approx(right.joint->value.zeta).epsilon(1e-6));
    CHECK(off.joint->value.F0 == Approx(right.joint->value.F0).epsilon(1e-6));
    CHECK(least_p(off) == Approx(least_p(right)).margin(0.05));
  }
}

TEST_CASE("The relaxations of histories that free a gain are marked, whatever they are called") {
  const Measured m = measured(Kind::decay, first_seed, nullptr, {.v_noise = 0.02});
  const auto model = history_model(m.record, m.constants);
  REQUIRE(std::holds_alternative<JointModel>(model));
  int gains = 0;
  for (const Relaxation& relaxation : std::get<JointModel>(model).relaxations) {
    CAPTURE(relaxation.test);
    CHECK((relaxation.freed == Freed::gain) == (relaxation.test.find("gain") != std::string::npos));
    gains += relaxation.freed == Freed::gain ? 1 : 0;
  }
  CHECK(gains == 3);  // of x, of v and of the drive
}

TEST_CASE("Histories with drag or a contact that yields have zeta and F0 beside it, with a Stribeck force none") {
  const auto ledger_with = [](void (*alter)(Rig&)) {
    const Measured m = measured(Kind::ramp, 880'003, alter);
    return std::pair(ledger_of(m.record, m.constants), m.rig);
  };
  const auto holds = [](const Interval& interval, double truth) {
    return interval[0] <= truth && truth <= interval[1] && interval[1] - interval[0] < 0.2 * truth;
  };
  const auto check = [&](void (*alter)(Rig&), const std::string& term) {
    const auto [ledger, rig] = ledger_with(alter);
    CAPTURE(term, rig.zeta, rig.F0);
    CHECK(ledger.violates_law());
    CHECK(ledger.frees_law);
    CHECK(ledger.relaxed == std::vector<std::string>{term});
    REQUIRE(ledger.joint);
    CHECK(holds(ledger.joint->interval95->zeta, rig.zeta));
    CHECK(holds(ledger.joint->interval95->F0, rig.F0));
  };
  check([](Rig& rig) { rig.drag = 0.5; }, "quadratic term over speed");
  check([](Rig& rig) { rig.compliance = 0.05; }, "friction that builds up after a reversal");
  const Ledger other = ledger_with([](Rig& rig) { rig.stribeck = 0.5; }).first;
  CHECK(other.violates_law());
  CHECK_FALSE(other.joint);
}

namespace {

/// The ledger of a decay of x alone from 30 mm with x_f = 0.6 mm, as its sensor reads it.
Ledger ledger_of_decay(const std::function<void(std::vector<double>&, double)>& read) {
  Measured m;
  m.rig = {.m = 1.0, .k = 1000.0, .zeta = 0.03, .F0 = 0.6};
  constexpr double rate = 400.0;
  History history{.sample_rate = rate, .x = motion_of(m.rig, [](double) { return 0.0; }, 4.0, rate, 0.03).x};
  read(history.x, rate);
  const dualdamp::core::RandomStream noise{6, 1};
  for (std::size_t i = 0; i < history.x.size(); ++i)
    history.x[i] += 5e-5 * noise.normal(static_cast<std::uint64_t>(i));
  m.record.histories.push_back(history);
  return ledger_of(m.record, {m.rig.m, m.rig.k, unknown});
}

}  // namespace

TEST_CASE("A zero of x comes before friction of one direction, and alone where that would give out work") {
  const auto with_zero = [](double zero) {
    return ledger_of_decay([zero](std::vector<double>& x, double) {
      for (double& value : x) value += zero;
    });
  };
  const Ledger possible = with_zero(4e-4);
  REQUIRE(possible.departures.size() == 1);
  CHECK(possible.departures[0] == std::vector<Assumption>{Assumption::sensors, Assumption::symmetry});
  for (const Assumption named : possible.departures[0]) {
    const std::string& reason = possible.entry(named).reason;
    const std::string size = ", the same as a zero of x that is off by ";
    REQUIRE(reason.find(size) != std::string::npos);
    CHECK(std::stod(reason.substr(reason.find(size) + size.size())) == Approx(4e-4).epsilon(0.05));
    CHECK(reason.find("half of the difference of F0 between the directions is ") != std::string::npos);
  }
  const Ledger beyond = with_zero(9e-4);
  REQUIRE(beyond.departures.size() == 1);
  CHECK(beyond.departures[0] == std::vector<Assumption>{Assumption::sensors});
}

TEST_CASE("An AC coupling of x alone is a fault of the sensor, and no damping of one direction") {
  for (const double corner : {2.5, 3.2}) {  // 0.08 of the natural frequency, as if the sensor bent; 0.1
    const Ledger ledger = ledger_of_decay([corner](std::vector<double>& x, double rate) {
      const std::vector<double> motion = x;
      const double u = corner / rate;
      for (std::size_t i = 1; i < x.size(); ++i)
        x[i] = std::exp(-u) * x[i - 1] + (1.0 - std::exp(-u)) / u * (motion[i] - motion[i - 1]);
    });
    CHECK(ledger.entry(Assumption::sensors).p_value.value_or(1.0) < 0.05);
    CHECK_FALSE(ledger.is_violated(Assumption::symmetry));
    const ParameterIntervals known = ledger.joint.value().interval95.value();
    CHECK((known.zeta[0] < 0.03 && 0.03 < known.zeta[1]));
    CHECK((known.F0[0] < 0.6 && 0.6 < known.F0[1]));
    CHECK((corner < 3.0 || ledger.entry(Assumption::sensors).test == "corner frequency of x free"));
  }
}
