// A mass that nothing drives and nothing holds: its motion dies away, and never closes relative to its own size.

#include <catch2/catch.hpp>

#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/viscous_saturating.hpp"
#include "sim/orbits/steady_state.hpp"

using namespace dualdamp;

TEST_CASE("without a drive and without a force that holds it, the mass ends at the middle") {
  const auto check = [](sim::Model model) {
    for (const double start : {0.0, 1.0}) {
      model.initial.position = start;
      const sim::SteadyState state = sim::steady_state(model);
      CAPTURE(start, state.outcome.reason);
      REQUIRE(state.outcome.ok());
      CHECK(state.peak == 0.0);
      CHECK(state.trough == 0.0);
      CHECK(state.stick_count == 0);
      CHECK(state.warnings.empty());
      for (const auto& multiplier : state.multipliers) CHECK(std::abs(multiplier) < 1.0);
      REQUIRE(state.start.memories.size() == model.friction.size());
      for (const sim::Sample& sample : sim::one_period(model, state, 10)) CHECK(sample.x == 0.0);
    }
  };
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.0, .frequency = 7.0};
  model.friction.emplace_back(friction::Coulomb(0.0, 0.0));
  check(model);
  model.friction.clear();
  check(model);
  model.friction.emplace_back(friction::ViscousSaturating(2.0, 0.5));
  check(model);
}
