#include "friction_models/laws/gap_spring.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/coulomb.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::GapSpring;
using friction::Law;

TEST_CASE("gap_spring conforms to the law contract", "[friction][gap_spring]") {
  const std::vector<std::string> none;
  for (const double gap : {0.0, 0.02})
    CHECK(sim::nonconformities(sim::law_case("gap_spring", {{"stiffness", 1e3}, {"gap", gap}})) == none);
}

TEST_CASE("gap_spring: period of a free vibration through the gap", "[gap_spring]") {
  // A quarter period: from 0 to the gap with the weak spring alone, then about (stiffness gap)/(k + stiffness).
  const double weak = 20.0;
  const double stiff = 380.0;
  const double gap = 0.05;
  const double amplitude = 0.2;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = weak};
  model.friction = {Law(GapSpring(stiff, gap))};
  model.initial = {.position = amplitude};
  const double slow = std::sqrt(weak);
  const double fast = std::sqrt(weak + stiff);
  const double middle = stiff * gap / (weak + stiff);
  const double beyond = std::acos((gap - middle) / (amplitude - middle)) / fast;
  const double speed = fast * std::sqrt(std::pow(amplitude - middle, 2) - std::pow(gap - middle, 2));
  const double within = std::atan2(slow * gap, speed) / slow;
  const double half = 2.0 * (beyond + within);
  const sim::History history = sim::simulate(model, {.duration = 10.0});
  REQUIRE(history.outcome.ok());
  int reversals = 0;
  for (const sim::Event& event : history.events) {
    if (event.kind != sim::EventKind::reversal) continue;
    ++reversals;
    CHECK(event.t == Approx(reversals * half).epsilon(1e-12));
    CHECK(std::abs(event.x) == Approx(amplitude).epsilon(1e-12));
  }
  CHECK(reversals == static_cast<int>(10.0 / half));
  CHECK(std::abs(history.energy.defect) < 1e-12);
}

TEST_CASE("gap_spring: without a gap it is a stiffer spring, beyond reach it is nothing", "[gap_spring]") {
  const Law coulomb(friction::Coulomb(2.0, 2.0));
  const double alone = sim::steady_state(test::standard_system(coulomb)).amplitude;
  sim::Model far = test::standard_system(coulomb);
  far.friction.emplace_back(GapSpring(1e4, 1.0));
  CHECK(sim::steady_state(far).amplitude == Approx(alone).epsilon(1e-12));

  // Driven by a force, so that the base does not tell the two springs apart.
  sim::Model split = test::standard_system(coulomb);
  split.excitation.type = sim::ExcitationType::force_harmonic;
  split.excitation.amplitude = 10.0;
  sim::Model whole = split;
  split.oscillator.stiffness = 60.0;
  split.friction.emplace_back(GapSpring(40.0, 0.0));
  CHECK(sim::steady_state(split).amplitude == Approx(sim::steady_state(whole).amplitude).epsilon(1e-12));
}

TEST_CASE("gap_spring: both engines agree on a motion against stops", "[gap_spring]") {
  sim::Model model = test::standard_system(Law(friction::Coulomb(1.0, 1.5)));
  model.friction.emplace_back(GapSpring(5e3, 0.1));
  const sim::SteadyState exact = sim::steady_state(model);
  model.solver = {.kind = sim::SolverKind::explicit_steps, .tolerance = 1e-12};
  const sim::SteadyState smooth = sim::steady_state(model);
  REQUIRE(exact.outcome.ok());
  REQUIRE(smooth.outcome.ok());
  CHECK(exact.peak > 0.1);
  CHECK(std::abs(exact.peak - smooth.peak) < 1e-9);
  CHECK(std::abs(exact.trough - smooth.trough) < 1e-9);
}
