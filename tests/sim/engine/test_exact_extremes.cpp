/// The exact engine at the ends of its range: many exponentials, rates far apart, tiny amplitudes, growth.

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "sim/engine/exact_engine.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/sim/engine/exact_motions.hpp"

using namespace dualdamp;
using namespace dualdamp::sim;
using namespace dualdamp::test;

namespace {

/// The final state by the smooth engine.
History stepped(Model model, double duration) {
  model.solver = {.kind = SolverKind::explicit_steps, .tolerance = 1e-12};
  return simulate(model, {.duration = duration});
}

}  // namespace

TEST_CASE("Any number of damped contacts, beside an own exponent and with eight harmonics", "[exact]") {
  // Own exponents -5 and -20; the contacts' rates kt/ct lie around 5.
  for (const int contacts : {4, 12, 16}) {
    Model model = base_driven({.k = 100.0, .c = 25.0, .Y = 0.5, .w = 10.0});
    for (int i = 0; i < contacts; ++i) {
      model.friction.push_back(friction::Law(
          friction::ContactCompliance(1.6 / contacts, 1.6 / contacts, 500.0, 100.0 * (1.0 - 2e-4 * i))));
    }
    for (int order = 2; order <= 8; ++order)
      model.excitation.harmonics.push_back({.order = order, .amplitude = 0.02});
    CAPTURE(contacts);
    const History exact = simulate(model, {.duration = 1.0});
    const History reference = stepped(model, 1.0);
    REQUIRE(exact.outcome.ok());
    REQUIRE(reference.outcome.ok());
    CHECK(std::abs(exact.final.x - reference.final.x) < 1e-8);
    CHECK(std::abs(exact.final.v - reference.final.v) < 1e-7);
    CHECK(std::abs(exact.energy.defect) < 1e-10 * exact.energy.input);
  }
}

TEST_CASE("Searches take few panels however heavy the damping or light the mass", "[exact]") {
  struct Case {
    double mass, damping, stiffness;
  };
  std::vector<Case> cases = {{1e-9, 4.0, 100.0}, {3e-9, 4.0, 100.0}, {1e-6, 4.0, 100.0}, {1e-9, 1e5, 1e-3}};
  for (const double damping : {1.0, 20.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8}) cases.push_back({1.0, damping, 100.0});
  for (const Case& c : cases) {
    Model model = base_driven({.m = c.mass, .k = c.stiffness, .c = c.damping, .Y = 0.1, .w = 10.0});
    model.friction.push_back(coulomb(0.02 * c.stiffness, 0.02 * c.stiffness));
    ExactEngine engine(model);
    const double duration = 50.0 * 2.0 * pi / model.excitation.frequency;
    while (engine.next(duration) != nullptr) {
    }
    CAPTURE(c.mass, c.damping, c.stiffness);
    CHECK(engine.outcome().ok());
    CHECK(engine.count().panels + engine.count().splits < 15 * engine.count().searches);
  }
}

TEST_CASE("Under heavy damping the motion is that of the smooth engine, and its energy is accounted for",
          "[exact]") {
  for (const double damping : {50.0, 300.0, 2000.0}) {
    Model model = base_driven({.k = 100.0, .c = damping, .Y = 0.1, .w = 10.0});
    model.friction.push_back(coulomb(2.0, 2.5));
    model.initial.velocity = 0.3;
    CAPTURE(damping);
    const History exact = simulate(model, {.duration = 2.0});
    const History reference = stepped(model, 2.0);
    REQUIRE(exact.outcome.ok());
    REQUIRE(reference.outcome.ok());
    CHECK(exact.events.size() == reference.events.size());
    CHECK(std::abs(exact.final.x - reference.final.x) < 1e-11);
    const double scale = exact.energy.friction + exact.energy.viscous;
    CHECK(std::abs(exact.energy.friction - reference.energy.friction) < 1e-9 * scale);
    CHECK(std::abs(exact.energy.defect) < 1e-12 * scale);
  }
  for (const double damping : {1e4, 1e6, 1e8}) {
    Model model = base_driven({.k = 100.0, .c = damping, .Y = 0.1, .w = 10.0});
    model.friction.push_back(coulomb(2.0, 2.5));
    const History exact = simulate(model, {.duration = 2.0});
    CAPTURE(damping);
    CHECK(std::abs(exact.energy.defect) < 1e-14 * model.oscillator.stiffness * 0.1 * 0.1);
  }
}

TEST_CASE("Amplitudes of 1e-200 move like those of 1", "[exact]") {
  for (const double static_level : {2.0, 6.5}) {
    const auto events = [&](double unit) {
      Model model = base_driven({.k = 100.0, .c = 4.0, .Y = 0.1 * unit, .w = 4.0});
      model.friction.push_back(coulomb(2.0 * unit, static_level * unit));
      return events_of(model, 5.0);
    };
    const std::vector<test::EngineEvent> here = events(1.0);
    for (const int power : {-1000, -665, -500, -100, 100, 500}) {
      const std::vector<test::EngineEvent> there = events(std::ldexp(1.0, power));
      CAPTURE(static_level, power);
      REQUIRE(there.size() == here.size());
      for (std::size_t i = 0; i < here.size(); ++i) {
        CHECK(there[i].kind == here[i].kind);
        CHECK(std::abs(there[i].t - here[i].t) < 1e-13 * here[i].t);
        CHECK(std::abs(std::ldexp(there[i].x, -power) - here[i].x) < 1e-12);
      }
    }
  }
}

TEST_CASE("Floquet multipliers and the largest speed do not depend on the unit of length", "[exact]") {
  for (const bool with_contact : {false, true}) {
    const auto state = [&](double unit) {
      Model model = base_driven({.k = 100.0, .c = 4.0, .Y = 0.1 * unit, .w = 7.0});
      if (with_contact) {
        model.friction.emplace_back(friction::ContactCompliance(2.0 * unit, 2.0 * unit, 1000.0, 0.0));
      } else {
        model.friction.push_back(coulomb(2.0 * unit, 3.0 * unit));
      }
      return steady_state(model);
    };
    const SteadyState here = state(1.0);
    REQUIRE(here.outcome.ok());
    for (const int power : {-900, -570, -40, 40, 53, 180, 430}) {
      const SteadyState there = state(std::ldexp(1.0, power));
      CAPTURE(with_contact, power);
      REQUIRE(there.outcome.ok());
      CHECK(std::abs(std::ldexp(there.max_speed, -power) - here.max_speed) < 1e-12);
      REQUIRE(there.multipliers.size() == here.multipliers.size());
      for (std::size_t i = 0; i < here.multipliers.size(); ++i)
        CHECK(std::abs(there.multipliers[i] - here.multipliers[i]) < 1e-11);
    }
  }
}

TEST_CASE("A growing own motion disturbs no release of a sticking mass", "[exact]") {
  // The base moves at 1e-5 m/s until 100 N/m reach 2 N; the free motion would have grown by e^12000.
  Model model = ramped(1.0, 100.0, -12.0, ExcitationType::base_ramp, 1e-5);
  model.friction.push_back(coulomb(2.0, 2.0));
  const std::vector<test::EngineEvent> events = events_of(model, 2100.0, 1);
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == EventKind::release);
  CHECK(events[0].t == Approx(2000.0).epsilon(1e-14));
}
