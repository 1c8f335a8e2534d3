#include "identify/methods/any_law/any_law.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "identify/departures/departures.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/identify/methods/any_law/law_laboratory.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double mass = 1.042;
constexpr double stiffness = 1568.0;
const double natural = std::sqrt(stiffness / mass);
constexpr double zeta = 0.08;
constexpr double F0 = 3.0;
constexpr double X = 0.01;

const KnownConstants known{mass, stiffness, natural};

identify::departures::Truth truth() {
  identify::departures::Truth truth;
  truth.model.oscillator.mass = mass;
  truth.model.oscillator.stiffness = stiffness;
  truth.model.oscillator.damping = 2.0 * zeta * std::sqrt(mass * stiffness);
  truth.F0 = F0;
  return truth;
}

sim::Model departed(const identify::departures::Truth& truth, const char* law, double severity) {
  if (law == nullptr) return identify::departures::undisturbed(truth);
  const identify::departures::ReferenceMotion reference{
      .amplitude = X, .frequency = natural, .Y = 2.0 * zeta * X + 4.0 / std::numbers::pi * F0 / stiffness};
  return identify::departures::departed(*identify::departures::find_departure(law), truth, reference, severity);
}

/// Eight levels at resonance, with noise of 0.3 % of X and 0.003 rad.
Record states(const char* law, double severity, bool phases, Normal& normal) {
  constexpr double sigma = 0.003;
  Record record;
  record.pairs.emplace();
  for (int i = 0; i < 8; ++i) {
    identify::departures::Truth rig = truth();
    const double x = X * (0.5 + i / 7.0);
    rig.model.excitation = {.type = sim::ExcitationType::base_harmonic,
                            .amplitude = 2.0 * zeta * x + 4.0 / std::numbers::pi * F0 / stiffness,
                            .frequency = natural};
    const sim::SteadyState state = sim::steady_state(departed(rig, law, severity));
    REQUIRE(state.outcome.ok());
    Pair pair{.Y = rig.model.excitation.amplitude, .x = state.amplitude + sigma * X * normal(), .number = i + 1};
    pair.omega = natural;
    if (phases) pair.phase = state.phase + sigma * normal();
    record.pairs->pairs.push_back(pair);
  }
  return record;
}

const LawAnswer& law_of(const Estimate& estimate, const std::string& name) {
  REQUIRE(estimate.laws);
  const auto found = std::ranges::find(estimate.laws->laws, name, &LawAnswer::name);
  REQUIRE(found != estimate.laws->laws.end());
  return *found;
}

}  // namespace

TEST_CASE("any_law: under plain friction the hull holds the truth, and the plain region") {
  Normal normal(11);
  const Estimate estimate = any_law(states(nullptr, 0.0, true, normal), known);
  REQUIRE(estimate.outcome.ok());
  CHECK(estimate.usable);
  const LawAnswer& plain = law_of(estimate, "coulomb_viscous");
  CHECK_FALSE(plain.rejected);
  CHECK(plain.value.zeta == Approx(zeta).epsilon(0.02));
  CHECK(plain.value.F0 == Approx(F0).epsilon(0.03));
  CHECK(holds(estimate.interval95->zeta, zeta));
  CHECK(holds(estimate.interval95->F0, F0));
  CHECK(estimate.laws->zeta_hull[0] <= plain.zeta_interval95[0]);
  CHECK(estimate.laws->zeta_hull[1] >= plain.zeta_interval95[1]);
  // Friction that falls over position is a smaller damping, exactly, at one frequency.
  const LawAnswer& slope = law_of(estimate, "position_slope");
  CHECK_FALSE(slope.rejected);
  CHECK(width(slope.zeta_interval95) > 3.0 * width(plain.zeta_interval95));
  double weights = 0.0;
  for (const LawAnswer& law : estimate.laws->laws) weights += law.weight;
  CHECK(weights == Approx(1.0));
}

TEST_CASE("any_law: a compliant contact rejects plain friction, and the hull holds the truth that it misses") {
  Normal normal(12);
  const Estimate estimate = any_law(states("contact_compliance", 0.2, true, normal), known);
  REQUIRE(estimate.outcome.ok());
  const LawAnswer& plain = law_of(estimate, "coulomb_viscous");
  CHECK(plain.rejected);
  CHECK_FALSE(holds(plain.F0_interval95, F0));
  CHECK(holds(estimate.laws->F0_hull, F0));
  CHECK(holds(estimate.laws->zeta_hull, zeta));
  CHECK_FALSE(law_of(estimate, "contact_compliance").rejected);
  CHECK(law_of(estimate, "contact_compliance").severity == Approx(0.2).margin(0.08));
  CHECK(estimate.laws->inflation == 1.0);
  // A stated bound below the true severity contradicts the data.
  const Estimate bounded = any_law(states("contact_compliance", 0.2, true, normal), known,
                                   {.largest_severity = 0.02, .without = all_laws_but({"contact_compliance"})});
  REQUIRE(bounded.outcome.ok());
  CHECK(std::abs(law_of(bounded, "contact_compliance").severity) <= 0.02);
}

TEST_CASE(
    "any_law: a law that fits best at the expected severity is followed on, and the hull holds a strong drag") {
  for (const bool phases : {false, true}) {
    Normal normal(12);
    // Twice the force of the damper at the reference speed.
    const Record record = states("quadratic_drag", 2.0, phases, normal);
    const std::vector<std::string> others = all_laws_but(
        {"contact_compliance", "film_beside_damper", "stribeck", "viscous_power", "viscous_saturating"});
    const Estimate estimate = any_law(record, known, {.without = others});
    REQUIRE(estimate.outcome.ok());
    CAPTURE(phases);
    CHECK(law_of(estimate, "coulomb_viscous").rejected);
    const LawAnswer& drag = law_of(estimate, "film_beside_damper");
    CHECK_FALSE(drag.rejected);
    // Severities of the library refer to the speed of the record, half of the reference speed.
    CHECK(drag.severity == Approx(-1.0).margin(0.4));
    CHECK(std::abs(drag.largest) > std::abs(drag.severity));
    CHECK(holds(estimate.laws->zeta_hull, zeta));
    CHECK(holds(estimate.laws->F0_hull, F0));
    // A severity that the user states is a bound; a warning names the laws that end there.
    const Estimate bounded =
        any_law(record, known, {.largest_severity = 0.3, .without = phases ? std::vector<std::string>() : others});
    REQUIRE(bounded.outcome.ok());
    for (const LawAnswer& law : bounded.laws->laws) CHECK(std::abs(law.severity) <= 0.3);
    CHECK_FALSE(bounded.warnings.empty());
  }
}

TEST_CASE("any_law: a law that the user leaves out is not in the library") {
  Normal normal(12);
  const Record record = states("contact_compliance", 0.2, true, normal);
  const Estimate estimate = any_law(record, known, {.without = {"contact_compliance", "dahl"}});
  REQUIRE(estimate.outcome.ok());
  for (const LawAnswer& law : estimate.laws->laws) CHECK((law.name != "contact_compliance" && law.name != "dahl"));
  // Other laws also yield before they slip.
  CHECK(law_of(estimate, "coulomb_viscous").rejected);
  CHECK(holds(estimate.laws->F0_hull, F0));
}

TEST_CASE("any_law: amplitudes alone allow more laws than amplitudes and phases") {
  const auto allowed = [](bool phases) {
    Normal normal(13);
    const Estimate estimate =
        any_law(states("contact_compliance", 0.15, phases, normal), known, {.without = slow_laws});
    REQUIRE(estimate.outcome.ok());
    CHECK(holds(estimate.laws->zeta_hull, zeta));
    CHECK_FALSE(estimate.laws->aliases.empty());
    return std::ranges::count_if(estimate.laws->laws, [](const LawAnswer& law) { return !law.rejected; });
  };
  CHECK(allowed(false) > allowed(true));
}

TEST_CASE("any_law: extremes of a free vibration") {
  Normal normal(14);
  identify::departures::Truth rig = truth();
  rig.F0 = 0.4;
  rig.model.oscillator.damping *= 0.25;
  rig.model.initial.position = 2.0 * X;
  constexpr double severity = 0.2;
  const identify::departures::ReferenceMotion reference{.amplitude = X, .frequency = natural, .Y = X};
  sim::Model model = identify::departures::departed(*identify::departures::find_departure("viscous_power"), rig,
                                                    reference, severity);
  const sim::FreeDecay motion = sim::free_decay(model, 14);
  Record record;
  record.decay.emplace();
  for (const sim::Extreme& peak : motion.extremes) record.decay->extremes.push_back(peak.x + 2e-5 * normal());
  REQUIRE(record.decay->extremes.size() >= 8);
  const Estimate estimate = any_law(record, {mass, stiffness});
  REQUIRE(estimate.outcome.ok());
  CHECK(holds(estimate.laws->zeta_hull, 0.25 * zeta));
  CHECK(holds(estimate.laws->F0_hull, rig.F0));
  // Without a drive there are no departures of the drive.
  CHECK(std::ranges::find(estimate.laws->laws, "base_distortion", &LawAnswer::name) == estimate.laws->laws.end());
}

TEST_CASE("any_law: what it cannot read is refused with a reason") {
  Normal normal(15);
  Record few = states(nullptr, 0.0, true, normal);
  few.pairs->pairs.resize(3);
  const auto reason = [](const Record& record, const KnownConstants& constants) {
    const Estimate estimate = any_law(record, constants);
    CHECK_FALSE(estimate.outcome.ok());
    return estimate.outcome.reason;
  };
  CHECK_THAT(reason(few, known), Catch::Contains("fewer than four steady states"));
  CHECK_THAT(reason({}, known), Catch::Contains("holds neither steady states nor extremes"));
  CHECK_THAT(reason(states(nullptr, 0.0, true, normal), {mass, unknown, natural}), Catch::Contains("stiffness"));
}

TEST_CASE("any_law: next to no Coulomb friction has a range that begins at zero") {
  // The straight line of viscous friction at resonance, x = Y/(2 zeta). Every other record fits with a negative F0.
  int given = 0;
  for (const std::uint64_t seed : {1, 3, 4}) {
    Normal normal(seed);
    Record record;
    record.pairs.emplace();
    for (int i = 0; i < 8; ++i) {
      const double x = X * (0.5 + i / 7.0);
      record.pairs->pairs.push_back({.Y = 2.0 * zeta * x, .x = x + 0.003 * X * normal(), .number = i + 1});
    }
    // One range over all laws: the more there are, the further it reaches above zero.
    const Estimate estimate =
        any_law(record, known, {.without = given == 0 ? std::vector<std::string>() : slow_laws});
    if (!estimate.outcome.ok()) continue;
    ++given;
    CHECK(holds(estimate.laws->zeta_hull, zeta));
    CHECK(estimate.laws->F0_hull[0] == 0.0);
    CHECK(estimate.laws->F0_hull[1] < 0.15 * F0);
  }
  CHECK(given >= 2);
}

TEST_CASE("any_law: readings that do not distinguish force from damping get no range") {
  // Without damping the amplitude grows beyond all bounds at one level: 4 F0/(pi k).
  Normal normal(17);
  Record record;
  record.pairs.emplace();
  for (int i = 0; i < 8; ++i) {
    const double x = X * (0.5 + i / 7.0);
    record.pairs->pairs.push_back(
        {.Y = 4.0 / std::numbers::pi * F0 / stiffness + 2e-9 * x, .x = x + 0.003 * X * normal(), .number = i + 1});
  }
  const Estimate estimate = any_law(record, known);
  CHECK_FALSE(estimate.outcome.ok());
  CHECK_THAT(estimate.outcome.reason, Catch::Contains("they do not distinguish its force from its damping"));
}

TEST_CASE("any_law: a level that sticks beside wild amplitudes ends with a statement, not in a crash") {
  // One amplitude has a digit too many, one input has lost its first.
  Record record;
  record.pairs.emplace();
  for (const auto& [Y, x] : {std::pair{4.4e-3, 5.786548e-3},
                             {4.8e-3, 7.454486e-3},
                             {5.2e-3, 9.122229e-3},
                             {5.6e-3, 10.7829818e-3},
                             {6.0e-3, 102.457284e-3},
                             {0.4e-3, 14.12465e-3}})
    record.pairs->pairs.push_back({.Y = Y, .x = x, .number = static_cast<int>(record.pairs->pairs.size()) + 1});
  const Estimate estimate = any_law(record, known);
  INFO(estimate.outcome.reason);
  REQUIRE(estimate.outcome.ok());
  // Friction with free play has amplitudes like these, where the small input does not reach its stops.
  const auto plain = std::ranges::find(estimate.laws->laws, "coulomb_viscous", &LawAnswer::name);
  CHECK((estimate.laws->inflation > 1.0 || plain->rejected));
}

TEST_CASE("any_law: uncertain constants widen its ranges, hull and average alike") {
  Estimate estimate;
  estimate.value = {0.1, 0.0, 0.0, 2.1};
  estimate.interval95 = {{0.097, 0.103}, {}, {}, {2.0, 2.2}};
  LawIntervals laws;
  laws.mean = estimate.value;
  laws.zeta_hull = laws.zeta_average = {0.097, 0.103};
  laws.F0_hull = laws.F0_average = {2.0, 2.2};
  estimate.laws = std::make_shared<const LawIntervals>(laws);
  constexpr double normal95 = 1.959963984540054;
  widen({.zeta = 0.004 / normal95, .F0 = 0.0}, estimate);
  for (const Interval& zeta : {estimate.interval95->zeta, estimate.laws->zeta_hull, estimate.laws->zeta_average}) {
    CHECK(zeta[1] - 0.1 == Approx(0.005));
    CHECK(0.1 - zeta[0] == Approx(0.005));
  }
  CHECK(estimate.interval95->F0[1] == Approx(2.2));
}

TEST_CASE("any_law: constants that scale all forces move F0 and c by as much, whatever departs") {
  Normal normal(16);
  // If mass and stiffness have the same relative error, all forces over the mass stay the same.
  const Record record = states("contact_compliance", 0.2, true, normal);
  const double relative = 0.01;
  const Estimate by_mass = moved_by_constants(record, known, {.mass = relative * mass});
  const Estimate by_stiffness = moved_by_constants(record, known, {.stiffness = relative * stiffness});
  REQUIRE(by_mass.outcome.ok());
  REQUIRE(by_stiffness.outcome.ok());
  const auto both = [&](double factor) {
    const Estimate estimate =
        moved_by_constants(record, {mass * factor, stiffness * factor, natural}, {.mass = 1e-9 * mass});
    return estimate.value;
  };
  CHECK(both(1.0 + relative).F0 / both(1.0).F0 - 1.0 == Approx(relative).epsilon(0.01));
  CHECK(both(1.0 + relative).zeta == Approx(both(1.0).zeta).epsilon(1e-4));
  // The changes by the mass alone and by the stiffness alone, of either sign, add up to that by both together.
  const double together = relative * both(1.0).F0;
  const double apart = std::abs(by_mass.std->F0 - together);
  CHECK(apart == Approx(by_stiffness.std->F0).margin(0.02 * together));
  CHECK(by_mass.warnings.empty());
}

TEST_CASE("any_law: what constants do is never left out without a word") {
  Normal normal(16);
  const ConstantUncertainties uncertain{.mass = 0.01 * mass};
  const Estimate without_states = moved_by_constants({}, known, uncertain);
  const Estimate without_stiffness =
      moved_by_constants(states(nullptr, 0.0, true, normal), {mass, unknown, natural}, uncertain);
  for (const Estimate& estimate : {without_states, without_stiffness}) {
    CHECK_FALSE(estimate.outcome.ok());
    CHECK_FALSE(estimate.std.has_value());
    REQUIRE(estimate.warnings.size() == 1);
    CHECK_THAT(estimate.warnings.front(), Catch::Contains("are not in the ranges over laws"));
  }
}

TEST_CASE("any_law: small steps of a constant do not end in another valley") {
  // A mass stated 7.4 % too large and a spring stated 1.1 % too soft. If each fit began anew, it would find the
  // right spring with some masses, and strong friction without damping with others: F0 would change by four times
  // the share of the mass.
  Record record;
  record.pairs.emplace();
  for (const auto& [Y, x, phase] : {std::array<double, 3>{6.36136e-04, 2.50113e-03, 1.6020},
                                    std::array<double, 3>{6.92084e-04, 3.21061e-03, 1.5926},
                                    std::array<double, 3>{7.48032e-04, 3.92213e-03, 1.5853},
                                    std::array<double, 3>{8.03980e-04, 4.64603e-03, 1.5863},
                                    std::array<double, 3>{8.59929e-04, 5.35926e-03, 1.5837},
                                    std::array<double, 3>{9.15877e-04, 6.07190e-03, 1.5783},
                                    std::array<double, 3>{9.71825e-04, 6.78667e-03, 1.5786},
                                    std::array<double, 3>{1.02777e-03, 7.50291e-03, 1.5786}}) {
    Pair pair{.Y = Y, .x = x, .number = static_cast<int>(record.pairs->pairs.size()) + 1};
    pair.phase = phase;
    record.pairs->pairs.push_back(pair);
  }
  const KnownConstants constants{3.57352, 20220.31, 2.0 * std::numbers::pi * 12.47986};
  const Estimate moved = moved_by_constants(record, constants, {.mass = 0.03 * constants.mass});
  REQUIRE(moved.outcome.ok());
  // The phases determine k/m, so all forces are proportional to the mass, and c/(2 sqrt(k m)) with the stated k to
  // its square root.
  CHECK(moved.std->F0 / moved.value.F0 == Approx(0.03).epsilon(0.05));
  CHECK(moved.std->zeta / moved.value.zeta == Approx(0.015).epsilon(0.1));
}
