#include "identify/ledger/ledger.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <variant>

#include "identify/ledger/decay_model.hpp"
#include "identify/ledger/histories/history_model.hpp"
#include "identify/ledger/histories/history_rows.hpp"
#include "identify/ledger/relaxation_tests.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t ledger_seed = 100;

struct Found {
  int any = 0;
  int named = 0;
};

/// Number of records in which any assumption is violated, and in which a given one is.
Found ledgers(Kind kind, int records, Assumption assumption, void (*alter)(Rig&) = nullptr, const Off& off = {}) {
  Found found;
  for (int i = 0; i < records; ++i) {
    const Measured m = measured(kind, ledger_seed + static_cast<std::uint64_t>(i), alter, off);
    const Ledger ledger = ledger_of(m.record, m.constants);
    REQUIRE_FALSE(ledger.data.empty());
    REQUIRE(ledger.entries.size() == assumption_count);
    for (const LedgerEntry& entry : ledger.entries)
      if (entry.standing == Standing::violated) CHECK(entry.p_value.value_or(1.0) < family_level);
    found.any += ledger.departures.empty() ? 0 : 1;
    found.named += ledger.is_violated(assumption) ? 1 : 0;
  }
  return found;
}

Ledger ledger_for(Kind kind, std::uint64_t seed, void (*alter)(Rig&)) {
  const Measured m = measured(kind, seed, alter);
  return ledger_of(m.record, m.constants);
}

}  // namespace

TEST_CASE("True Coulomb and viscous friction violates nothing but by chance") {
  // At a level of 5 % three or more of ten records are rejected in 1 of 100 sets.
  for (const Kind kind : {Kind::xy, Kind::xy_phase, Kind::response, Kind::extremes, Kind::forced, Kind::beat}) {
    CAPTURE(name_of(kind));
    CHECK(ledgers(kind, 10, Assumption::friction_velocity).any <= 2);
  }
}

TEST_CASE("A wrong stiffness is charged to the constants") {
  for (const Kind kind : {Kind::response, Kind::forced}) {
    CAPTURE(name_of(kind));
    CHECK(ledgers(kind, 4, Assumption::constants, nullptr, {.stiffness = 0.03}).named >= 4);
  }
}

TEST_CASE("Quadratic drag is charged to friction over speed") {
  const auto alter = [](Rig& rig) { rig.drag = 1.0; };
  for (const Kind kind : {Kind::xy, Kind::forced}) {
    CAPTURE(name_of(kind));
    CHECK(ledgers(kind, 4, Assumption::friction_velocity, alter).named >= 4);
  }
}

TEST_CASE("What a record cannot show is untested, with what would show it") {
  const Measured m = measured(Kind::xy, ledger_seed);
  const Ledger ledger = ledger_of(m.record, m.constants);
  const LedgerEntry& symmetry = ledger.entry(Assumption::symmetry);
  CHECK(symmetry.standing == Standing::untested);
  CHECK(symmetry.reason.find("a history or signed extremes would") != std::string::npos);
  CHECK_FALSE(symmetry.p_value);
  CHECK(ledger_of({}, m.constants).entry(Assumption::spring).standing == Standing::untested);
}

namespace {

/// Is friction charged alone?
bool blames_friction_alone(const Ledger& ledger) {
  return std::ranges::any_of(ledger.departures, [](const std::vector<Assumption>& departure) {
    return std::ranges::all_of(departure, is_of_friction);
  });
}

bool holds_truth(const Ledger& ledger, double zeta, double F0) {
  REQUIRE(ledger.joint);
  REQUIRE(ledger.joint->interval95);
  const auto within = [](const Interval& interval, double value) {
    return interval[0] <= value && value <= interval[1];
  };
  return within(ledger.joint->interval95->zeta, zeta) && within(ledger.joint->interval95->F0, F0);
}

}  // namespace

TEST_CASE("A stiffness 2 % off is charged to the constants alone, and the fit that frees it holds the truth") {
  for (const Kind kind : {Kind::forced, Kind::decay, Kind::xy_phase}) {
    CAPTURE(name_of(kind));
    int held = 0;
    for (std::uint64_t seed = ledger_seed; seed < ledger_seed + 2; ++seed) {
      const Measured m = measured(kind, seed, nullptr, {.stiffness = 0.02});
      const Ledger ledger = ledger_of(m.record, m.constants);
      CHECK(ledger.is_violated(Assumption::constants));
      CHECK_FALSE(blames_friction_alone(ledger));
      held += ledger.joint && holds_truth(ledger, m.rig.zeta, m.rig.F0) ? 1 : 0;
    }
    CHECK(held >= 1);
  }
}

TEST_CASE("Constants and gains that are off by less than their stated uncertainties allow violate nothing") {
  for (const Kind kind : {Kind::xy_phase, Kind::response, Kind::forced, Kind::extremes}) {
    CAPTURE(name_of(kind));
    int certain = 0;
    int uncertain = 0;
    int too_sure = 0;
    constexpr int records = 1;
    for (int i = 0; i < records; ++i) {
      const Measured m = measured(kind, ledger_seed + static_cast<std::uint64_t>(i), nullptr,
                                  {.stiffness = 0.02, .gain = 0.01, .drive_gain = -0.01});
      const auto violated = [&](const ConstantUncertainties& uncertainties) {
        const Ledger ledger = ledger_of(m.record, m.constants, {.uncertainties = uncertainties});
        return ledger.departures.empty() ? 0 : 1;
      };
      certain += violated({});
      uncertain += violated({.stiffness = 0.02 * m.constants.stiffness, .gain_x = 0.01, .gain_force = 0.01});
      too_sure += violated({.stiffness = 0.002 * m.constants.stiffness});
    }
    CHECK(uncertain == 0);
    // The times show the wrong stiffness. It changes F0 by only just 2 %.
    if (kind != Kind::extremes) CHECK(certain == records);
    if (kind != Kind::extremes) CHECK(too_sure == records);
  }
}

TEST_CASE("A departure within the stated uncertainty is told, and its constant is freed in the joint estimate") {
  const Measured m = measured(Kind::response, 4, nullptr, {.stiffness = 0.02});
  const LedgerOptions options{.uncertainties = {.stiffness = 0.015 * m.constants.stiffness}};
  const Ledger ledger = ledger_of(m.record, m.constants, options);
  const LedgerEntry& constants = ledger.entry(Assumption::constants);
  CHECK(constants.standing == Standing::holds);
  CHECK(constants.p_value.value_or(1.0) < family_level);
  CHECK(constants.reason == "a departure is seen, and lies within the uncertainties that are stated");
  REQUIRE(ledger.joint);
  CHECK(ledger.joint->value.zeta == Approx(m.rig.zeta).epsilon(0.05));
}

TEST_CASE("A spring that hardens is charged to the spring where the fit can set it free") {
  const auto alter = [](Rig& rig) { rig.cubic = 0.06; };
  for (const Kind kind : {Kind::forced, Kind::extremes, Kind::xy_phase}) {
    CAPTURE(name_of(kind));
    const Measured m = measured(kind, ledger_seed, alter);
    const Ledger ledger = ledger_of(m.record, m.constants);
    CHECK(ledger.is_violated(Assumption::spring));
    CHECK_FALSE(ledger.is_violated(Assumption::friction_velocity));
    CHECK(holds_truth(ledger, m.rig.zeta, m.rig.F0));
  }
}

TEST_CASE("Where amplitudes alone show a departure, a spring that they cannot test is named beside friction") {
  const auto alter = [](Rig& rig) { rig.cubic = 0.03; };
  int rejected = 0;
  int blamed = 0;
  for (std::uint64_t seed = ledger_seed; seed < ledger_seed + 10; ++seed) {
    const Measured m = measured(Kind::xy, seed, alter);
    const Ledger ledger = ledger_of(m.record, m.constants);
    rejected += ledger.departures.empty() ? 0 : 1;
    blamed += blames_friction_alone(ledger) ? 1 : 0;
  }
  CHECK(rejected >= 3);
  CHECK(blamed <= 1);
}

TEST_CASE("Extremes with exact times show quadratic drag, and nothing where friction is plain") {
  constexpr double zeta = 0.005;
  const KnownConstants constants{1.0, 1000.0, unknown};
  const auto extremes = [&](double drag) {
    const double root = std::sqrt(1.0 - zeta * zeta);
    const double R = std::exp(-std::numbers::pi * zeta / root);
    constexpr double x_f = 1e-4;
    std::mt19937_64 random(7);
    std::normal_distribution noise(0.0, 0.1 * x_f);
    Record record;
    record.decay.emplace();
    double X = 100.0 * x_f;
    for (int i = 0; X > 3.0 * x_f; ++i) {
      record.decay->extremes.push_back((i % 2 == 0 ? X : -X) + noise(random));
      record.decay->times.push_back(i * std::numbers::pi / (std::sqrt(1000.0) * root));
      X = R * X - x_f * (1.0 + R) - drag * X * X / (100.0 * x_f);
    }
    return record;
  };
  CHECK(ledger_of(extremes(0.03), constants).is_violated(Assumption::friction_velocity));
  const auto model = decay_model(extremes(0.0), constants);
  REQUIRE(std::holds_alternative<JointModel>(model));
  const auto& joint = std::get<JointModel>(model);
  const RelaxationTests found = test_relaxations(joint);
  CHECK(found.departures.empty());
  // Noise of the extremes limits the test of friction over speed, however exact the times are.
  int checked = 0;
  for (const RelaxationTest& test : found.tests) {
    if (joint.relaxations[test.index].assumption != Assumption::friction_velocity) continue;
    CAPTURE(joint.relaxations[test.index].test);
    CHECK(test.zeta_blind > 1e-3 * joint.value.zeta);
    CHECK(test.zeta_blind < 1.0 * joint.value.zeta);
    ++checked;
  }
  CHECK(checked >= 1);
}

TEST_CASE("Times of a coarse clock are no departure, and still tell a stiffness that is far off") {
  const Off coarse{.noise = 0.1, .clock = 0.02};
  CHECK(ledgers(Kind::extremes, 12, Assumption::constants, nullptr, coarse).any <= 2);
  Off soft = coarse;
  soft.stiffness = 0.2;
  CHECK(ledgers(Kind::extremes, 6, Assumption::constants, nullptr, soft).named >= 5);
}

TEST_CASE("The noise of a coarse converter is that of its steps, though most differences are zero") {
  constexpr double step = 0.02;
  std::vector<double> coarse;
  std::vector<double> drive;
  for (int i = 0; i < 20'000; ++i) {
    coarse.push_back(step * std::round(std::sin(2e-4 * std::numbers::pi * i) / step));
    drive.push_back(i / 1000 % 2 == 0 ? 1.0 : -1.0);
  }
  CHECK(sensor_noise_of(coarse) == Approx(step / std::sqrt(12.0)).epsilon(1e-6));
  CHECK(sensor_noise_of(drive) == 0.0);  // a drive that switches: its step is not that of a converter
}

TEST_CASE("Where a term of friction is nearly seen the intervals reach over the estimate with it free") {
  const auto alter = [](Rig& rig) { rig.saturation = 0.3; };
  int near = 0;
  int answered = 0;
  for (std::uint64_t seed = ledger_seed; seed < ledger_seed + 24; ++seed) {
    const Measured m = measured(Kind::extremes, seed, alter);
    const Ledger ledger = ledger_of(m.record, m.constants);
    if (!ledger.joint || !ledger.joint->interval95) continue;
    ++answered;
    const bool noted =
        ledger.entry(Assumption::friction_velocity).reason.find("by itself rejects at 25 %") != std::string::npos;
    if (!noted) continue;
    ++near;
    // The standard error of the estimate with the term free is larger than half the distance of both estimates.
    const Interval& interval = ledger.joint->interval95->zeta;
    const double value = ledger.joint->value.zeta;
    const double sides = (interval[1] - value) / (value - interval[0]);
    CHECK(std::max(sides, 1.0 / sides) > 1.2);
  }
  CHECK(near > 0);
  CHECK(near <= answered);
}

TEST_CASE("Where the plain fit of a response ends without viscous friction the constants are still found") {
  for (const std::uint64_t seed : {300003u, 300023u}) {
    CAPTURE(seed);
    const Measured m = measured(Kind::response, seed, nullptr, {.stiffness = 0.02});
    const Ledger ledger = ledger_of(m.record, m.constants);
    CHECK(ledger.plain.zeta < 0.01 * m.rig.zeta);
    CHECK(ledger.is_violated(Assumption::constants));
    CHECK_FALSE(ledger.is_violated(Assumption::friction_velocity));
    CHECK_FALSE(ledger.is_violated(Assumption::friction_displacement));
    CHECK(holds_truth(ledger, m.rig.zeta, m.rig.F0));
  }
}

TEST_CASE("A contact that would make the rig softer is no explanation of a second mode") {
  const auto alter = [](Rig& rig) { rig.second_mass = 0.05; };
  for (std::uint64_t seed = 300000; seed < 300008; ++seed)
    CHECK_FALSE(ledger_for(Kind::response, seed, alter).is_violated(Assumption::friction_displacement));
}

TEST_CASE("Damping of its own in each direction is charged to symmetry, and the answer is the mean") {
  const auto alter = [](Rig& rig) { rig.asymmetry = 0.5; };
  int named = 0;
  int held = 0;
  constexpr int records = 8;
  for (std::uint64_t seed = ledger_seed; seed < ledger_seed + records; ++seed) {
    const Measured m = measured(Kind::extremes, seed, alter);
    const Ledger ledger = ledger_of(m.record, m.constants);
    named += ledger.is_violated(Assumption::symmetry) ? 1 : 0;
    held += ledger.joint && holds_truth(ledger, m.rig.zeta, m.rig.F0) ? 1 : 0;
  }
  CHECK(named >= records - 1);
  CHECK(held >= records - 2);
}

TEST_CASE("The rest after a vibration is left out, however long it was recorded") {
  constexpr double x_f = 1.0;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(10'000);
  for (Eigen::Index i = 0; i < 500; ++i)
    x[i] = (40.0 - 0.08 * static_cast<double>(i)) * std::cos(0.2 * static_cast<double>(i));
  const Eigen::Index moving = moving_rows({}, x, x_f);
  CHECK(moving > 400);
  CHECK(moving < 500);
  x *= 0.01;
  CHECK(moving_rows({}, x, x_f) == x.size());  // small from the start: all is used
}

TEST_CASE("Where friction drifts from sweep to sweep the answer is the mean over the sweeps") {
  int named = 0;
  int held = 0;
  constexpr int records = 6;
  for (std::uint64_t seed = ledger_seed; seed < ledger_seed + records; ++seed) {
    const Measured m = measured(Kind::xy_phase, seed, nullptr, {.sweep_drift = 0.3});
    const Ledger ledger = ledger_of(m.record, m.constants);
    named += ledger.is_violated(Assumption::stationarity) ? 1 : 0;
    CHECK_FALSE(blames_friction_alone(ledger));
    held += ledger.joint && holds_truth(ledger, m.rig.zeta, m.rig.F0) ? 1 : 0;
  }
  CHECK(named == records);
  CHECK(held >= records - 1);
}

TEST_CASE("At one frequency a wrong frequency and a further mode are named together") {
  // 6 Hz stated and 2 % off: zeta 0.08, F0 2.842 N.
  constexpr std::array<std::array<double, 3>, 8> states = {{{4.20000, 9.94881, 97.52683},
                                                            {4.67143, 12.69808, 98.14052},
                                                            {5.14286, 15.59183, 98.17389},
                                                            {5.61429, 18.40124, 98.46624},
                                                            {6.08571, 21.22873, 98.79030},
                                                            {6.55714, 24.05559, 99.06783},
                                                            {7.02857, 26.83917, 99.32368},
                                                            {7.50000, 29.69262, 99.59833}}};
  Record record;
  record.pairs.emplace();
  for (const auto& [Y, x, phase] : states) {
    Pair pair;
    pair.Y = 1e-3 * Y;
    pair.x = 1e-3 * x;
    pair.phase = phase * std::numbers::pi / 180.0;
    pair.number = static_cast<int>(record.pairs->pairs.size()) + 1;
    record.pairs->pairs.push_back(pair);
  }
  const Ledger ledger = ledger_of(record, {1.0, 1421.2230338, 12.0 * std::numbers::pi});
  CHECK(ledger.is_violated(Assumption::constants));
  CHECK(ledger.is_violated(Assumption::one_mode));
  CHECK(holds_truth(ledger, 0.08, 2.842));
}

TEST_CASE("A zero of x that is off by more than friction can differ is named alone, and the joint fit answers") {
  int held = 0;
  int named = 0;
  constexpr int records = 3;
  for (std::uint64_t seed = ledger_seed; seed < ledger_seed + records; ++seed) {
    Measured m = measured(Kind::decay, seed);
    for (double& x : m.record.histories[0].x) x += 3.0 * m.rig.x_f();
    const Ledger ledger = ledger_of(m.record, m.constants);
    CAPTURE(seed);
    CHECK_FALSE(ledger.is_violated(Assumption::symmetry));
    named += ledger.is_violated(Assumption::sensors) ? 1 : 0;
    if (!ledger.joint || !ledger.joint->interval95) continue;
    const ParameterIntervals& at = *ledger.joint->interval95;
    held += at.zeta[0] <= m.rig.zeta && m.rig.zeta <= at.zeta[1] && at.F0[0] <= m.rig.F0 && m.rig.F0 <= at.F0[1];
  }
  CHECK(named >= 1);  // where it moves zeta or F0 by 2 % or more
  CHECK(held >= records - 1);
}

TEST_CASE("A zero of x that drifts is charged to what drifts, neither to friction nor to the constants") {
  for (const Kind kind : {Kind::extremes, Kind::decay, Kind::forced}) {
    for (std::uint64_t seed = ledger_seed; seed < ledger_seed + 2; ++seed) {
      const Measured m = measured(kind, seed, nullptr, {.zero_drift = 3.0});
      const Ledger ledger = ledger_of(m.record, m.constants);
      CAPTURE(name_of(kind), seed);
      const LedgerEntry& drift = ledger.entry(Assumption::stationarity);
      CHECK(drift.test == "zero of x that drifts");
      CHECK(drift.p_value.value_or(1.0) < family_level);
      CHECK_FALSE(ledger.is_violated(Assumption::symmetry));
      CHECK_FALSE(ledger.is_violated(Assumption::friction_velocity));
      CHECK_FALSE(ledger.is_violated(Assumption::constants));
      CHECK(holds_truth(ledger, m.rig.zeta, m.rig.F0));
    }
  }
}

TEST_CASE("Of two departures of a history the one that explains more is charged first, not what hides the other") {
  // A zero that is off and drifts: a free mass explains nothing and must not be charged.
  Measured m = measured(Kind::decay, ledger_seed, nullptr, {.zero_drift = 2.0});
  for (double& x : m.record.histories[0].x) x += m.rig.x_f();
  const auto model = history_model(m.record, m.constants);
  const RelaxationTests tests = test_relaxations(std::get<JointModel>(model));
  REQUIRE(tests.departures.size() >= 2);
  const auto& relaxations = std::get<JointModel>(model).relaxations;
  for (const FoundDeparture& departure : tests.departures)
    for (const RelaxationTest& test : departure.explanations) {
      CAPTURE(relaxations[test.index].test);
      CHECK(relaxations[test.index].assumption != Assumption::constants);
    }
}

TEST_CASE("Constants that are 1 % higher move a joint fit that sets nothing else free, each by its own share") {
  const Measured m = measured(Kind::response, ledger_seed);
  const Ledger ledger = ledger_of(m.record, m.constants);
  REQUIRE(ledger.joint);
  CHECK(ledger.relaxed.empty());
  const Reader reader = [&](const Record& record, const KnownConstants& constants) {
    return joint_fit(record, constants, ledger.relaxed);
  };
  const std::vector<Sensitivity> found = sensitivities(reader, *ledger.joint, m.record, m.constants, {});
  const auto of = [&](const std::string& constant) {
    const auto at = std::ranges::find(found, constant, &Sensitivity::constant);
    REQUIRE(at != found.end());
    return *at;
  };
  // Lengths 1 % larger leave zeta and raise F0 by 1 %; so do a mass and a stiffness that are 1 % larger.
  for (const auto& [one, other] : {std::pair{"gain of x", "gain of y"}, {"mass", "stiffness"}}) {
    CAPTURE(one);
    CHECK(of(one).zeta_change + of(other).zeta_change == Approx(0.0).margin(0.01));
    CHECK(of(one).F0_change + of(other).F0_change == Approx(0.01).margin(0.01));
  }
  // A mass that is 1 % off makes the natural frequency half a percent wrong; the ledger would set the mass free.
  CHECK_FALSE(ledger_of(m.record, {1.01 * m.constants.mass, m.constants.stiffness, unknown}).departures.empty());
  // If the mass is free again, the answer with a mass 1 % off is that with the right mass.
  const Estimate freed = joint_fit(m.record, {1.01 * m.constants.mass, m.constants.stiffness, unknown},
                                   {"natural frequency free, stiffness as stated"});
  CHECK(freed.value.zeta == Approx(ledger.joint->value.zeta).epsilon(0.01));
  CHECK_FALSE(joint_fit(m.record, m.constants, {"no such test"}).outcome.ok());
}

TEST_CASE("Noise of the drive, which columns and residuals share, rejects no constant of a steady motion") {
  // One frequency, settled, with an unknown mass: a change of stiffness or gain changes the motion hardly more than
  // the noise of the drive does.
  int rejected = 0;
  constexpr int records = 8;
  for (int i = 0; i < records; ++i) {
    Measured m =
        measured(Kind::forced, ledger_seed + static_cast<std::uint64_t>(i), [](Rig& rig) { rig.zeta = 0.08; });
    History& history = m.record.histories.front();
    const auto settled = static_cast<std::ptrdiff_t>(history.x.size() / 2);
    history.x.erase(history.x.begin(), history.x.begin() + settled);
    history.force.erase(history.force.begin(), history.force.begin() + settled);
    m.constants.mass = unknown;
    rejected += ledger_of(m.record, m.constants).departures.empty() ? 0 : 1;
  }
  CHECK(rejected <= 1);
}
