/// Steady states found near a known one.

#include "sim/orbits/steady_state_near.hpp"

#include <catch2/catch.hpp>
#include <complex>
#include <string>
#include <vector>

#include "tests/support/make_law.hpp"
#include "tests/support/standard_system.hpp"

namespace {

using namespace dualdamp;
using friction::ParameterValues;
using test::law;

std::vector<sim::Model> models() {
  return {test::standard_system(law("coulomb", {{"kinetic", 2.0}})),
          test::standard_system(law("contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e3}})),
          test::standard_system(law("dahl", {{"kinetic", 2.0}, {"sigma0", 1e3}})),
          test::standard_system(law("stribeck", {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}}))};
}

}  // namespace

TEST_CASE("the orbit next to a known one is the steady state of its own numbers") {
  for (sim::Model model : models()) {
    const sim::KnownOrbit known = sim::known_orbit(model, sim::steady_state(model));
    for (const double change : {1e-4, 1e-2}) {
      model.excitation.amplitude = 0.1 * (1.0 + change);
      const sim::SteadyState near = sim::steady_state_near(known, model);
      const sim::SteadyState own = sim::steady_state(model);
      REQUIRE(near.outcome.ok());
      REQUIRE(own.outcome.ok());
      CHECK(near.transient_periods == 0);
      CHECK(near.amplitude == Approx(own.amplitude).epsilon(1e-9));
      CHECK(near.phase == Approx(own.phase).margin(1e-9));
      CHECK(near.stops_per_cycle == own.stops_per_cycle);
      CHECK(near.stable());
    }
  }
}

TEST_CASE("an orbit for a difference quotient takes fewer periods and errs by its share of the difference") {
  constexpr double share = 1e-3;
  for (sim::Model model : models()) {
    const sim::SteadyState before = sim::steady_state(model);
    const sim::KnownOrbit known = sim::known_orbit(model, before);
    model.excitation.amplitude *= 1.0 + 1e-4;
    const sim::SteadyState exact = sim::steady_state_near(known, model);
    const sim::SteadyState quick = sim::steady_state_near(known, model, {}, share);
    REQUIRE(quick.outcome.ok());
    CHECK(quick.newton_steps < exact.newton_steps);
    CHECK(std::abs(quick.amplitude - exact.amplitude) <=
          3.0 * share * std::abs(exact.amplitude - before.amplitude));
    CHECK(std::abs(quick.phase - exact.phase) <= 3.0 * share * std::abs(exact.phase - before.phase));
  }
}

TEST_CASE("an orbit with less detail has the same numbers and leaves out the others") {
  for (const sim::Model& model : models()) {
    const sim::SteadyState full = sim::steady_state(model);
    const sim::SteadyState phase = sim::steady_state(model, {.detail = sim::OrbitDetail::phase});
    const sim::SteadyState extremes = sim::steady_state(model, {.detail = sim::OrbitDetail::extremes});
    CHECK(phase.amplitude == Approx(full.amplitude).epsilon(1e-12));
    CHECK(phase.phase == Approx(full.phase).epsilon(1e-12));
    CHECK(phase.fundamental == Approx(full.fundamental).epsilon(1e-12));
    CHECK(full.energy.friction > 0.0);
    CHECK(phase.energy.friction == 0.0);
    CHECK(extremes.amplitude == Approx(full.amplitude).epsilon(1e-12));
    CHECK(extremes.fundamental == 0.0);
  }
}

TEST_CASE(
    "where a known orbit does not lead quickly to its neighbour the result is that of a search from nothing") {
  for (sim::Model model : models()) {
    const sim::KnownOrbit known = sim::known_orbit(model, sim::steady_state(model));
    model.excitation.amplitude = 0.035;  // sticks, or nearly
    const sim::SteadyState far = sim::steady_state_near(known, model);
    const sim::SteadyState own = sim::steady_state(model);
    REQUIRE(far.outcome.ok() == own.outcome.ok());
    CHECK(far.amplitude == Approx(own.amplitude).epsilon(1e-8));
  }
}

TEST_CASE("where the known derivative does not lead to a neighbour the neighbour's own does") {
  // I - M of the neighbour is 3.5 times that of the known orbit: by the known one each correction overshoots by 2.5
  // times what it removes.
  sim::Model model =
      test::standard_system(law("stribeck", {{"kinetic", 0.5}, {"static", 0.8}, {"stribeck_velocity", 0.05}}));
  model.oscillator.damping = 0.2;
  const sim::KnownOrbit known = sim::known_orbit(model, sim::steady_state(model));
  model.oscillator.damping = 0.8;
  const sim::SteadyState near = sim::steady_state_near(known, model);
  const sim::SteadyState own = sim::steady_state(model);
  REQUIRE(near.outcome.ok());
  REQUIRE(own.outcome.ok());
  CHECK(near.transient_periods == 0);
  CHECK(near.amplitude == Approx(own.amplitude).epsilon(1e-9));
  REQUIRE(near.multipliers.size() == own.multipliers.size());
  for (std::size_t i = 0; i < own.multipliers.size(); ++i)
    CHECK(std::abs(near.multipliers[i] - own.multipliers[i]) < 1e-6);
}

TEST_CASE("a search that leaves out other steady states finds the one of a full search") {
  // A hardening spring, on which another orbit attracts.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.05, .cubic_stiffness = 0.3};
  model.excitation = {
      .type = sim::ExcitationType::force_harmonic, .amplitude = 1.0, .frequency = 1.8, .offset = 0.5};
  model.friction = {law("coulomb", {{"kinetic", 0.05}, {"static", 2.0}})};
  const sim::SteadyState full = sim::steady_state(model);
  const sim::SteadyState alone = sim::steady_state(model, {.others = false});
  REQUIRE(full.outcome.ok());
  REQUIRE_FALSE(full.others.empty());
  CHECK(alone.others.empty());
  CHECK(alone.outcome.ok());
  CHECK(alone.amplitude == full.amplitude);
  CHECK(alone.start.x == full.start.x);
  CHECK(alone.start.v == full.start.v);
}

TEST_CASE("a known orbit of other laws is refused") {
  const std::vector<sim::Model> list = models();
  sim::Model two = list[0];
  two.friction.push_back(list[2].friction.front());
  const sim::KnownOrbit known = sim::known_orbit(list[0], sim::steady_state(list[0]));
  CHECK_THROWS(sim::steady_state_near(known, two));
}

TEST_CASE("a neighbour that takes more work than allowed is given up, with the reason") {
  for (sim::Model model : models()) {
    const sim::KnownOrbit known = sim::known_orbit(model, sim::steady_state(model));
    CHECK(known.work > 0);
    model.excitation.amplitude *= 2.0;
    CHECK(sim::steady_state_near(known, model, {.most_work = 100 * known.work}).outcome.ok());
    const sim::SteadyState given_up = sim::steady_state_near(known, model, {.most_work = known.work / 4});
    CHECK_FALSE(given_up.outcome.ok());
    CHECK_FALSE(given_up.outcome.reason.empty());
  }
}
