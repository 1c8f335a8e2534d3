// The steady state is the one that the motion from the initial state reaches: against that motion itself,
// integrated for hundreds of periods. Subharmonic, asymmetric and aperiodic motions; unique orbits.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "friction_models/laws/attached_mass.hpp"
#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/free_play.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/growth.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/sim/orbits/range_of_motion.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace dualdamp;
using sim::testing::after;
using sim::testing::forcing_period;
using sim::testing::Range;

/// A hardening spring in the range of frequencies where two orbits attract.
sim::Model bistable() {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.148, .cubic_stiffness = 3.4};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.36, .frequency = 1.98};
  model.friction.emplace_back(friction::Coulomb(0.037, 0.037));
  model.initial = {-2.6, -1.2};
  return model;
}

/// Static friction four times the kinetic: after each stick the mass slips for many own periods.
sim::Model period_twelve() {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.097};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 0.459};
  model.friction.emplace_back(friction::Coulomb(0.11, 0.435));
  return model;
}

}  // namespace

TEST_CASE("where two orbits attract, the steady state is the one that the motion reaches") {
  const sim::SteadyState state = sim::steady_state(bistable());
  REQUIRE(state.outcome.ok());
  // exp(-c T/2) = 0.79 a period: rounding after 200.
  CHECK(state.peak == Approx(after(bistable(), 400, 2).peak).epsilon(1e-8));
  CHECK(state.peak == Approx(0.1211).epsilon(1e-3));
  CHECK(state.stable());
  REQUIRE(state.others.size() == 1);
  CHECK(state.others[0].peak == Approx(1.0877).epsilon(1e-4));
  CHECK_FALSE(state.warnings.empty());
}

TEST_CASE("beside a mass at rest both engines list both asymmetric motions that attract others") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.0776};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.8, .frequency = 0.459};
  model.friction.emplace_back(friction::Coulomb(0.1375, 0.87));
  for (const sim::SolverKind solver : {sim::SolverKind::automatic, sim::SolverKind::explicit_steps}) {
    model.solver.kind = solver;
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.amplitude == 0.0);
    REQUIRE(state.others.size() == 2);
    for (const sim::OtherState& other : state.others) {
      sim::Model there = model;
      there.initial.position = other.peak;
      const sim::SteadyState reached = sim::steady_state(there);
      CHECK(reached.peak - reached.trough == Approx(1.59407 + 0.91956).epsilon(1e-4));
    }
    CHECK(state.others[0].peak == Approx(-state.others[1].trough).epsilon(1e-6));
    CHECK(state.others[0].trough == Approx(-state.others[1].peak).epsilon(1e-6));
  }
}

TEST_CASE("the mirror image of a subharmonic motion is found from whichever of its periods leads there") {
  // The slider of the contact begins anew in the mirror image, which leads to another orbit from one of three
  // places.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.13};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 1.9188044401897117,
                      .frequency = 0.09532703465771306};
  model.friction = {test::law("contact_compliance", {{"kinetic", 0.15},
                                                     {"static", 0.485439289539661},
                                                     {"contact_stiffness", 6.258302601449795},
                                                     {"contact_damping", 0.005778106940294374}}),
                    test::law("coulomb", {{"kinetic", 0.06590412330603829}, {"static", 0.1543368414405835}})};
  for (const double tolerance : {1e-9, 1e-10, 1e-12, 1e-14}) {
    const sim::SteadyState state = sim::steady_state(model, {.tolerance = tolerance});
    REQUIRE(state.outcome.ok());
    CHECK(state.period_ratio == 3);
    CHECK(std::ranges::any_of(state.others, [&](const sim::OtherState& other) {
      return other.peak == Approx(-state.trough) && other.trough == Approx(-state.peak);
    }));
  }
}

TEST_CASE("a model that is not symmetric has no mirror images of its steady states") {
  // Each was listed with a mirror image that no motion reaches.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 0.05, .frequency = 2.0 * std::numbers::pi};
  const friction::ParameterValues load{{"ratio", 0.3}, {"order", 1.0}, {"phase", 0.0}};
  model.friction = {
      test::law("coulomb", {{"kinetic", 1.0}, {"load_modulation", std::vector<friction::ParameterValues>{load}}})};
  const sim::SteadyState modulated = sim::steady_state(model);
  CHECK(modulated.peak == Approx(0.076016533).epsilon(1e-8));
  CHECK(modulated.trough == Approx(-0.0841291544).epsilon(1e-8));
  CHECK(modulated.others.empty());

  // A static friction of one direction that the motion meets late.
  model.oscillator.damping = 0.2;
  model.excitation = {
      .type = sim::ExcitationType::force_harmonic, .amplitude = 3.0, .frequency = 0.8 * std::numbers::pi};
  model.initial.position = 0.5;
  model.friction = {test::law("asymmetric_coulomb",
                              {{"kinetic_forward", 1.0}, {"kinetic_backward", 1.0}, {"static_forward", 2.5}})};
  const sim::SteadyState one_sided = sim::steady_state(model);
  CHECK(one_sided.trough == Approx(-0.025001312).epsilon(1e-6));
  CHECK(one_sided.others.empty());

  // A constant force, and a start at rest that does not show it.
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.05, .cubic_stiffness = 0.3};
  model.excitation = {
      .type = sim::ExcitationType::force_harmonic, .amplitude = 1.0, .frequency = 1.8, .offset = 0.5};
  model.initial.position = 0.0;
  model.friction = {friction::Law(friction::Coulomb(0.05, 2.0))};
  const sim::SteadyState offset = sim::steady_state(model);
  REQUIRE(offset.others.size() == 1);
  CHECK(offset.others[0].peak == Approx(3.5176652759).epsilon(1e-7));
}

TEST_CASE("24 starts of a bistable oscillator end where their motions do") {
  test::Random random(20261123);
  int large = 0;
  for (int i = 0; i < 24; ++i) {
    sim::Model model = bistable();
    model.excitation.frequency = 1.85;
    model.initial = {random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
    CAPTURE(i, model.initial.position, model.initial.velocity);
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.peak == Approx(after(model, 200, 2).peak).epsilon(1e-6));
    CHECK(state.others.size() == 1);
    large += state.peak > 0.5 ? 1 : 0;
  }
  CHECK(large > 2);
  CHECK(large < 22);
}

TEST_CASE("a motion of twelve forcing periods is a steady state of period twelve") {
  const sim::Model model = period_twelve();
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(state.period_ratio == 12);
  CHECK(state.period == Approx(12.0 * forcing_period(model)).epsilon(1e-15));
  CHECK(state.stable());
  const Range range = after(model, 4800, 12);
  CHECK(state.peak == Approx(range.peak).epsilon(1e-10));
  CHECK(state.trough == Approx(range.trough).epsilon(1e-10));
  // All results about a period refer to this one.
  CHECK(std::abs(state.energy.defect) < 1e-12 * state.energy.input);
  const std::vector<sim::Sample> orbit = sim::one_period(model, state, 1200);
  REQUIRE(orbit.size() == 1201);
  CHECK(orbit.back().x == Approx(orbit.front().x).margin(1e-10));
  CHECK(orbit[100].x != Approx(orbit.front().x).margin(1e-3));
  const auto largest = std::ranges::max_element(orbit, {}, &sim::Sample::x);
  CHECK(largest->x == Approx(state.peak).epsilon(1e-4));
  CHECK(state.transient_periods < 3000);
}

TEST_CASE("a motion of one forcing period beside a continuum is none of seventeen") {
  // Bristles beside sliders: the mass creeps, and over one period the orbit hardly attracts. The number of periods
  // had been 16 to 34 over two, from level to level of a smooth branch.
  for (const double level : {1.70, 1.75}) {
    CAPTURE(level);
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
    model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = level, .frequency = 2.0};
    model.initial = {.position = 0.1};
    for (friction::Law& law : test::laws_of("lugre", {{"kinetic", 1.1},
                                                      {"static", 2.2},
                                                      {"stribeck_velocity", 0.03},
                                                      {"sigma0", 4000.0},
                                                      {"sigma1", 28.0}}))
      model.friction.push_back(std::move(law));
    model.friction.emplace_back(friction::Coulomb(0.5, 1.5));
    for (friction::Law& law : test::laws_of("iwan", {{"limit", 2.0}, {"stiffness", 18000.0}, {"count", 3.0}}))
      model.friction.push_back(std::move(law));
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.period_ratio == 1);
    CHECK(state.stops_per_cycle == 2);
  }
}

TEST_CASE("a mass that goes from stop to stop in a moment is periodic within the rounding of its time") {
  // Negative damping throws it over the play within milliseconds, at 0.2 m/s; for the rest of a half period of
  // 2.4 s a stop holds it. The time of an event is known to 4e-16 s, so the motion of 38 um closes to 5e-12 at
  // best.
  sim::Model model;
  model.oscillator = {.mass = 0.24, .stiffness = 68000.0, .damping = -725.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.024, .frequency = 1.3};
  model.friction.emplace_back(friction::FreePlay(98000.0, 98000.0, 7.5e-5));
  const sim::SteadyState state = sim::steady_state(model);
  INFO(state.outcome.reason);
  REQUIRE(state.outcome.ok());
  CHECK(state.transient_periods < 100);
  CHECK_THAT(state.warnings.at(0), Catch::Contains("not unique"));
  const Range seen = after(model, 20, 2);
  CHECK(state.peak == Approx(seen.peak).epsilon(1e-9));
  CHECK(state.trough == Approx(seen.trough).epsilon(1e-9));
}

TEST_CASE("a linear oscillator with damping has exactly one steady state") {
  struct Case {
    double zeta, r;
  };
  for (const Case c : {Case{0.2, 1e5}, Case{0.2, 1e3}, Case{1e-8, 0.7}, Case{1e-8, 1.0}, Case{1e-8, 0.5},
                       Case{1e-5, 1.0 / 3.0}, Case{30.0, 1e4}, Case{0.01, 1e-3}}) {
    CAPTURE(c.zeta, c.r);
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 20.0 * c.zeta};
    model.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0 * c.r, .phase = 0.3};
    model.initial = {0.5, 1.0};
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.warnings.empty());
    CHECK(state.stable());
    const std::complex<double> response = 0.1 / std::complex<double>(1.0 - c.r * c.r, 2.0 * c.zeta * c.r);
    // The period map determines the orbit to the rounding of the map over 1 - exp(-2 pi zeta/r).
    CHECK(state.amplitude == Approx(std::abs(response)).epsilon(1e-9));
  }
}

TEST_CASE(
    "a linear oscillator beside an own motion that takes thousands of periods to decay has its steady state") {
  sim::Model model;
  model.oscillator = {.mass = 3.0, .stiffness = 80.0};
  constexpr double m = 0.04;
  constexpr double k = 5.669;
  constexpr double c = 0.06;
  model.friction.emplace_back(friction::AttachedMass(m, k, c));
  // Above resonance, where hardly anything is dissipated, the mass reverses at the start of each period.
  for (const double w : {3.0, 5.3, 8.0, 10.0, 11.5, 20.0}) {
    CAPTURE(w);
    model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.01, .frequency = w};
    const std::complex<double> bond(k, c * w);
    const std::complex<double> attached = -bond * m * w * w / (bond - m * w * w);
    const double x = std::abs(80.0 * 0.01 / (80.0 - 3.0 * w * w + attached));
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.amplitude == Approx(x).epsilon(1e-6));
  }
}

TEST_CASE("a contact that rings 6,500 times in each forcing period has its steady state after a few of them") {
  // It never slides: a linear oscillator with both springs, whose own motion loses 0.3 % of its amplitude in a
  // period.
  sim::Model model;
  model.oscillator = {.mass = 64.05, .stiffness = 85476.0, .damping = 0.0184};
  constexpr double contact = 2.788e8;
  constexpr double w = 0.319;
  model.friction.emplace_back(friction::ContactCompliance(484.0, 1902.0, contact, 0.0));
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 10.5, .frequency = w};
  const sim::SteadyState state = sim::steady_state(model);
  INFO(state.outcome.reason);
  REQUIRE(state.outcome.ok());
  CHECK(state.transient_periods < 12);
  const std::complex<double> stiffness(85476.0 + contact - 64.05 * w * w, 0.0184 * w);
  CHECK(state.amplitude == Approx(10.5 / std::abs(stiffness)).epsilon(1e-8));
}

TEST_CASE("a drive that barely moves the mass has one steady state from every start") {
  for (const double start : {0.0, 0.0005, -0.001, 0.4}) {
    CAPTURE(start);
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1};
    model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 0.7};
    model.friction.emplace_back(friction::Coulomb(0.999, 0.999));
    const sim::SteadyState centred = sim::steady_state(model);
    REQUIRE(centred.outcome.ok());
    CHECK(centred.amplitude > 0.0);
    model.initial.position = start;
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.warnings.empty());
    CHECK(state.peak == Approx(centred.peak).epsilon(1e-8));
    CHECK(state.trough == Approx(centred.trough).epsilon(1e-8));
  }
}

TEST_CASE("a motion far above resonance is periodic, although displacements from it drift for long") {
  // The spring, the damper and friction are 1e-4 of the inertial force and less: x = F/(m omega^2).
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 2.0};
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 4e5, .frequency = 1e5};
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(state.amplitude == Approx(4e-5).epsilon(1e-6));
  CHECK(state.stable());
}

TEST_CASE("an aperiodic motion is called so") {
  // Ueda's x'' + 0.05 x' + x^3 = 7.5 cos t is chaotic; the linear spring is negligible.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1e-6, .damping = 0.05, .cubic_stiffness = 1.0};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 7.5, .frequency = 1.0};
  model.initial = {2.5, 0.0};
  const sim::SteadyState state = sim::steady_state(model);
  CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
  CHECK(state.outcome.reason.find("aperiodic") != std::string::npos);
  CHECK(state.transient_periods < 1010);
}

TEST_CASE("contacts that age below their break-away are a creep, told within 64 forcing periods") {
  // psi = ln(1 + V0 t/D) while the mass hardly moves: the closure of psi falls like 1/(n ln n).
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.005, .frequency = 6.283};
  model.friction = {test::law("rate_state", {{"normal_force", 10.0},
                                             {"mu0", 0.2},
                                             {"a", 0.05},
                                             {"b", 0.075},
                                             {"slip_distance", 0.01},
                                             {"reference_velocity", 0.01}})};
  const sim::SteadyState state = sim::steady_state(model);
  CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
  INFO(state.outcome.reason);
  CHECK(state.outcome.reason.find("the motion creeps") != std::string::npos);
  CHECK(state.outcome.reason.find("after 32 forcing periods it still differs by 0.88 %") != std::string::npos);
  CHECK(state.outcome.reason.ends_with(" m of zero"));
  CHECK(state.transient_periods <= 64);
  model.oscillator.coordinate = core::Coordinate::angle;
  CHECK(sim::steady_state(model).outcome.reason.ends_with(" rad of zero"));
}

TEST_CASE("a closure that falls by a constant factor is no creep, one that falls like 1/n is") {
  for (double factor = 0.05; factor < 0.99999; factor += 0.5 * (1.0 - factor) * factor) {
    sim::Creep creep;
    double closure = 1.0;
    for (int n = 1; n < 5000; ++n) {
      creep.observe(closure *= factor, 1.0);
      INFO(factor << " " << n);
      REQUIRE(!creep.goes_on());
    }
  }
  sim::Creep creep;
  sim::Creep growing;
  sim::Creep winding;
  sim::Creep decaying;
  sim::Creep aging;
  for (int n = 1; n <= 32; ++n) {
    // rate_state below break-away, when the contact is about as old as the motion: its state is ln(1 + t V/L).
    const double age = 1.0 + 0.0209 * n;
    aging.observe(0.0209 / (age * std::log(age)), std::pow(age, -1.2));
    creep.observe(1.0 / n, 1.0);
    growing.observe(1.0 / n, n);
    decaying.observe(1.0 / n, 1.0 / n);
    winding.observe((n % 2 == 0 ? 1.0 : 0.5) / n, 1.0);
  }
  CHECK(creep.goes_on());
  CHECK(aging.goes_on());
  CHECK(!growing.goes_on());
  CHECK(!winding.goes_on());
  CHECK(!decaying.goes_on());
}

TEST_CASE("motions that cannot part are not called aperiodic") {
  // The force rises with speed by 1 % in each e-fold of it: the mass hardly moves, and rounding shakes it.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.015, .frequency = 10.0};
  model.friction = {test::law("viscous_power", {{"coefficient", 10.0}, {"exponent", 0.01}})};
  const sim::SteadyState state = sim::steady_state(model);
  CHECK(!state.outcome.ok());
  INFO(state.outcome.reason);
  CHECK(state.outcome.reason.find("aperiodic") == std::string::npos);
}

TEST_CASE("a motion that winds towards its orbit is not looked at anew in each period") {
  // The free motion rotates by 2/7 of a turn in a forcing period, so it nearly returns after 7 and after 25
  // periods, long before it does after one. Elements that never slip keep their Floquet multipliers at 1.
  const std::vector<friction::ParameterValues> elements{{{"stiffness", 20.0}, {"share", 0.5}},
                                                        {{"stiffness", 24.0}, {"share", 0.5}}};
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.2};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.5, .frequency = 42.0};
  model.friction = {test::law("generalized_maxwell_slip", {{"kinetic", 10.0},
                                                           {"static", 12.0},
                                                           {"stribeck_velocity", 1.0},
                                                           {"elements", elements},
                                                           {"attraction", 10.0}})};
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(state.transient_periods == 1334);
  // With a check of the orbit in each period there would be 611,144.
  CHECK(state.certificate.searches < 500'000);
}

TEST_CASE("a motion that turns slowly far from an orbit is not taken to approach it") {
  // The fast drive makes friction a dashpot of slow motions up to 0.1 m/s; beyond that the negative damping gives
  // more than friction takes, from an amplitude of 4 F/(pi |c| omega) = 6.4 m on. At each turning point of the slow
  // motion several forcing periods in a row agree with the dashpot.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = -0.01};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 5.0, .frequency = 50.0};
  const std::vector<friction::Law> laws = {
      test::law("coulomb", {{"kinetic", 0.05}}),
      test::law("stribeck", {{"kinetic", 0.05}, {"static", 0.051}, {"stribeck_velocity", 1.0}}),
      test::law(
          "lugre",
          {{"kinetic", 0.05}, {"static", 0.05}, {"stribeck_velocity", 0.1}, {"sigma0", 1000.0}, {"sigma1", 1.0}})};
  for (const friction::Law& law : laws) {
    model.friction = {law};
    model.initial = {.position = 10.0};
    const sim::SteadyState outside = sim::steady_state(model);
    CHECK(outside.outcome.reason.find("the amplitude still grows") != std::string::npos);
    model.initial = {.position = 0.1};
    const sim::SteadyState inside = sim::steady_state(model);
    CHECK(inside.outcome.ok());
    CHECK(inside.peak == Approx(0.002).epsilon(0.01));
  }
}
