/// The smooth engine at the ends of its range: friction that falls steeply with speed, and a very strong dashpot.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "sim/engine/engine.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/standard_system.hpp"

namespace {

using namespace dualdamp;
using friction::ParameterValues;
using test::law;

friction::Law falling(const char* form, double exponent) {
  ParameterValues values{{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}, {"form", form}};
  if (exponent > 0.0) values.set("exponent", exponent);
  return law("stribeck", values);
}

}  // namespace

TEST_CASE("smooth steady states: the phase of the drive moves the orbit in time and changes nothing else") {
  // Newton's method displaces the state at the boundary of a period, at any place of the orbit.
  const std::vector<friction::Law> laws = {falling("exponential", 0.0), falling("gaussian", 1.5),
                                           falling("gaussian", 3.0)};
  for (const friction::Law& friction : laws) {
    sim::Model model = test::standard_system(friction);
    const sim::SteadyState orbit = sim::steady_state(model);
    REQUIRE(orbit.outcome.ok());
    constexpr int phases = 24;
    for (int i = 1; i < phases; ++i) {
      model.excitation.phase = 2.0 * std::numbers::pi * i / phases;
      const sim::SteadyState state = sim::steady_state(model);
      INFO("phase " << model.excitation.phase);
      REQUIRE(state.outcome.ok());
      CHECK(state.amplitude == Approx(orbit.amplitude).epsilon(1e-9));
      CHECK(state.phase == Approx(orbit.phase).margin(1e-8));
    }
  }
}

TEST_CASE("smooth steady states: a force that falls steeply under a hardening spring") {
  sim::Model model;
  model.oscillator = {.mass = 0.10805627988186074,
                      .stiffness = 300.03992463118817,
                      .damping = 10.695990318467024,
                      .cubic_stiffness = 36822.99763767936};
  model.friction = {law("stribeck", {{"kinetic", 0.030025957972239538},
                                     {"static", 0.06094258515821688},
                                     {"stribeck_velocity", 0.003744584971512497},
                                     {"exponent", 1.8616908677338526}})};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.003454686099972264,
                      .frequency = 10.08475041614982,
                      .phase = 2.575377206202411};
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  // The motion itself, after its transient.
  const sim::History motion = sim::simulate(model, {.duration = 40.0 * state.period});
  REQUIRE(motion.outcome.ok());
  CHECK(state.start.x == Approx(motion.final.x).epsilon(1e-8));
  CHECK(state.start.v == Approx(motion.final.v).epsilon(1e-8));
}

TEST_CASE("smooth engine: a motion that begins backward is the mirror image of one that begins forward") {
  sim::Model model = test::standard_system(falling("exponential", 0.0));
  model.initial = {.position = 0.05, .velocity = 1.5};
  const sim::History forward = sim::simulate(model, {.duration = 1.0});
  model.initial = {.position = -0.05, .velocity = -1.5};
  model.excitation.phase = std::numbers::pi;
  const sim::History backward = sim::simulate(model, {.duration = 1.0});
  REQUIRE(forward.outcome.ok());
  REQUIRE(backward.outcome.ok());
  CHECK(backward.final.x == Approx(-forward.final.x).margin(1e-12));
  CHECK(backward.final.v == Approx(-forward.final.v).margin(1e-11));
}

TEST_CASE("smooth engine: creep far below all other speeds is followed") {
  // mu0/a = 20: after seconds the mass moves at 1e-9 of its first speed. Then the spring balances friction:
  // v = 2 V0 sinh(-k x/(a N)) exp(-(mu0 + b psi)/a), integrated here over the logarithm of time.
  constexpr double a = 0.01;
  constexpr double b = 0.015;
  constexpr double normal = 10.0;
  constexpr double pace = 0.01 / 1e-3;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.initial = {.position = 0.1};
  model.friction = {law("rate_state", {{"normal_force", normal},
                                       {"mu0", 0.2},
                                       {"a", a},
                                       {"b", b},
                                       {"slip_distance", 1e-3},
                                       {"reference_velocity", 0.01}})};
  const std::unique_ptr<sim::Engine> engine = sim::make_engine(model);
  constexpr double begin = 20.0;
  constexpr double end = 1500.0;
  while (engine->next(begin) != nullptr) {
  }
  REQUIRE(engine->outcome().ok());
  using Pair = std::array<double, 2>;  // x, psi
  const Pair start = {engine->position(), engine->state().memories[0].state[0]};
  while (engine->next(end) != nullptr) {
  }
  REQUIRE(engine->outcome().ok());

  const auto rate = [](double log_t, const Pair& at) {
    const double v = 2.0 * 0.01 * std::sinh(-100.0 * at[0] / (a * normal)) * std::exp(-(0.2 + b * at[1]) / a);
    return Pair{std::exp(log_t) * v, std::exp(log_t) * pace * (std::exp(-at[1]) - std::abs(v) / 0.01)};
  };
  constexpr int steps = 20'000;
  const double h = std::log(end / begin) / steps;
  Pair at = start;
  for (int i = 0; i < steps; ++i) {
    const double s = std::log(begin) + i * h;
    const auto ahead = [&](double part, const Pair& slope) {
      return Pair{at[0] + part * h * slope[0], at[1] + part * h * slope[1]};
    };
    const Pair k1 = rate(s, at);
    const Pair k2 = rate(s + 0.5 * h, ahead(0.5, k1));
    const Pair k3 = rate(s + 0.5 * h, ahead(0.5, k2));
    const Pair k4 = rate(s + h, ahead(1.0, k3));
    for (std::size_t k = 0; k < 2; ++k) at[k] += h / 6.0 * (k1[k] + 2.0 * k2[k] + 2.0 * k3[k] + k4[k]);
  }
  CHECK(engine->position() - start[0] == Approx(at[0] - start[0]).epsilon(1e-5));
  CHECK(engine->state().memories[0].state[0] == Approx(at[1]).epsilon(1e-6));
}

TEST_CASE("smooth engine: creep that reverses below the rounding of the velocity goes on") {
  // exp(-mu0/a) = exp(-20): the load stays below break-away, and the mass creeps by less than 1e-10 m.
  sim::Model model = test::standard_system(law("rate_state", {{"normal_force", 10.0},
                                                              {"mu0", 0.4},
                                                              {"a", 0.02},
                                                              {"b", 0.015},
                                                              {"slip_distance", 1e-3},
                                                              {"reference_velocity", 0.01}}));
  model.excitation.amplitude = 0.01;
  constexpr double period = std::numbers::pi / 5.0;
  const sim::History motion = sim::simulate(model, {.duration = 5.0 * period});
  REQUIRE(motion.outcome.ok());
  CHECK(motion.events.size() < 30);
  for (const sim::Event& event : motion.events) CHECK(std::abs(event.x) < 1e-9);
}

TEST_CASE("smooth engine: a rock that sticks and slips is followed, and a tighter tolerance changes nothing") {
  // exp(-mu0/a) = exp(-40), and the contacts age.
  sim::Model model = test::standard_system(law("rate_state", {{"normal_force", 5.0},
                                                              {"mu0", 0.6},
                                                              {"a", 0.015},
                                                              {"b", 0.0225},
                                                              {"slip_distance", 1e-4},
                                                              {"reference_velocity", 1e-3}}));
  model.excitation.amplitude = 0.035;
  constexpr double duration = 3.0 * std::numbers::pi / 5.0;
  const sim::History motion = sim::simulate(model, {.duration = duration});
  model.solver.tolerance = 1e-13;
  const sim::History tight = sim::simulate(model, {.duration = duration});
  REQUIRE(motion.outcome.ok());
  REQUIRE(tight.outcome.ok());
  CHECK(motion.final.x == Approx(tight.final.x).epsilon(1e-7));
}

TEST_CASE("smooth engine: a softening spring that pushes the mass away is named", "[sim][smooth]") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1, .cubic_stiffness = -1.0};
  model.initial = {.position = 1.5};
  const sim::History motion = sim::simulate(model, {.duration = 20.0});
  CHECK(motion.outcome.kind == core::OutcomeKind::not_finite);
  CHECK(motion.outcome.reason.find("from which a softening spring pushes outward") != std::string::npos);
}
