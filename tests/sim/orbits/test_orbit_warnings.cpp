// How exactly a steady state under smooth laws was found.

#include <catch2/catch.hpp>

#include "sim/orbits/steady_state.hpp"
#include "sim/validate.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;

TEST_CASE("steady states under smooth laws are found at the least tolerance that is allowed") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1000.0, .damping = 3.0};
  model.friction = {test::law("dahl", {{"kinetic", 1.0}, {"sigma0", 1e5}})};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 5e-3, .frequency = 25.0};
  const sim::SteadyState usual = sim::steady_state(model);
  model.solver.tolerance = sim::least_tolerance;
  const sim::SteadyState finest = sim::steady_state(model);
  REQUIRE(usual.outcome.ok());
  REQUIRE(finest.outcome.ok());
  CHECK(finest.peak == Approx(usual.peak).epsilon(1e-9));
  CHECK(finest.warnings.empty());
}
