/// Free decays in which a stick is a pause, and those in which the mass sticks for good.

#include "sim/motion/free_decay.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "sim/motion/simulate.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using friction::Law;
using friction::ParameterValues;
using sim::EventKind;

namespace {

/// A machine of 41 kg with a natural period of 70 ms.
sim::Model machine(std::vector<Law> laws, double position) {
  sim::Model model;
  model.oscillator = {.mass = 41.0, .stiffness = 330'000.0, .damping = 2.0 * 0.004 * std::sqrt(330'000.0 * 41.0)};
  model.friction = std::move(laws);
  model.initial = {.position = position};
  return model;
}

Law coulomb_with(const char* modifier, double value) {
  return test::law("coulomb", {{"kinetic", 300.0}, {"static", 400.0}, {modifier, value}});
}

Law fluctuating(double ratio) {
  const ParameterValues record{{"ratio", ratio}, {"correlation_time", 0.3}, {"seed", 4.0}};
  return test::law("coulomb",
                   {{"kinetic", 300.0}, {"static", 310.0}, {"fluctuation", std::vector<ParameterValues>{record}}});
}

/// The turning points that `simulate` lists. A stop is one unless the mass goes on in the same direction.
std::vector<sim::Extreme> turns(const sim::Model& model, double duration) {
  const sim::History history = sim::simulate(model, {.duration = duration});
  std::vector<sim::Extreme> result = {{0.0, model.initial.position}};
  for (const sim::Event& event : history.events)
    if (event.kind == EventKind::reversal || event.kind == EventKind::stop) result.push_back({event.t, event.x});
  for (std::size_t i = 1; i + 1 < result.size();) {
    const bool goes_on = (result[i].x - result[i - 1].x) * (result[i + 1].x - result[i].x) > 0.0;
    if (goes_on) result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
    if (!goes_on) ++i;
  }
  return result;
}

void check_against_simulate(const sim::Model& model, const sim::FreeDecay& decay) {
  const std::vector<sim::Extreme> expected = turns(model, decay.extremes.back().t + 0.1);
  REQUIRE(expected.size() >= decay.extremes.size());
  for (std::size_t i = 0; i < decay.extremes.size(); ++i) {
    CAPTURE(i);
    CHECK(decay.extremes[i].t == Approx(expected[i].t).margin(1e-7));
    CHECK(decay.extremes[i].x == Approx(expected[i].x).margin(1e-10));
  }
}

}  // namespace

TEST_CASE("free decay: a stick under a falling force limit is a pause", "[sim][free_decay]") {
  const sim::Model model = machine({coulomb_with("drift", -0.4)}, 0.004);
  const sim::FreeDecay decay = sim::free_decay(model, 40);
  REQUIRE(decay.outcome.ok());
  // It first sticks after the third extreme. At 2.5 s the friction is gone and the mass swings on.
  REQUIRE(decay.extremes.size() == 40);
  CHECK_FALSE(decay.came_to_rest);
  CHECK_FALSE(decay.pauses);
  CHECK(decay.extremes.back().t > 2.5);
  check_against_simulate(model, decay);
}

TEST_CASE("free decay: where the mass pauses and goes on in the same direction is no extreme",
          "[sim][free_decay]") {
  // It is released between x_k and 2 x_k, so that it stops before it has passed the middle.
  const sim::Model model = machine({coulomb_with("drift", -0.4)}, -1.3e-3);
  const sim::History history = sim::simulate(model, {.duration = 2.4});
  long stops = 0;
  for (const sim::Event& event : history.events) stops += event.kind == EventKind::stop && event.x < 0.0 ? 1 : 0;
  CHECK(stops > 1);
  const sim::FreeDecay decay = sim::free_decay(model, 12);
  REQUIRE(decay.extremes.size() == 12);
  for (std::size_t i = 2; i < decay.extremes.size(); ++i) {
    const auto& x = decay.extremes;
    CHECK((x[i].x - x[i - 1].x) * (x[i - 1].x - x[i - 2].x) < 0.0);
  }
  check_against_simulate(model, decay);
}

TEST_CASE("free decay: an attached mass that swings on releases the mass again", "[sim][free_decay]") {
  const Law attached = test::law("attached_mass", {{"mass", 3.0}, {"stiffness", 8e4}, {"damping", 12.0}});
  const Law held = test::law("coulomb", {{"kinetic", 49.0}, {"static", 66.0}});
  long pauses = 0;
  for (const double position : {0.0022, 0.0025, 0.0028, 0.0031}) {
    const sim::Model model = machine({attached, held}, position);
    const sim::FreeDecay decay = sim::free_decay(model, 200);
    REQUIRE(decay.outcome.ok());
    check_against_simulate(model, decay);
    const sim::History history = sim::simulate(model, {.duration = decay.extremes.back().t + 0.1});
    for (const sim::Event& event : history.events)
      pauses += event.kind == EventKind::release && event.t < decay.extremes.back().t ? 1 : 0;
    CHECK(decay.came_to_rest);
    CHECK_FALSE(decay.pauses);
  }
  CHECK(pauses > 0);
}

TEST_CASE("free decay: whether an attached mass without a damper releases the mass later is not known",
          "[sim][free_decay]") {
  const Law attached = test::law("attached_mass", {{"mass", 3.0}, {"stiffness", 8e4}});
  const Law held = test::law("coulomb", {{"kinetic", 49.0}, {"static", 66.0}});
  const sim::FreeDecay decay = sim::free_decay(machine({attached, held}, 0.0028), 200);
  CHECK(decay.pauses);
  CHECK_FALSE(decay.came_to_rest);
}

namespace {

/// A rider whose normal vibration, of 36 ms, is fast beside the oscillator's 650 ms.
sim::Model ridden(double normal_damping_ratio, double position, ParameterValues more = {}) {
  for (const auto& [name, value] : std::vector<std::pair<const char*, double>>{{"mu", 0.2},
                                                                               {"mu_static", 0.3},
                                                                               {"weight", 12.0},
                                                                               {"normal_mass", 0.4},
                                                                               {"static_approach", 0.002},
                                                                               {"lift", 60.0},
                                                                               {"lift_velocity", 0.2}})
    more.set(name, value);
  more.set("normal_damping_ratio", normal_damping_ratio);
  sim::Model model;
  model.oscillator = {.mass = 1.3, .stiffness = 120.0};
  model.friction = {test::law("normal_vibration", more)};
  model.initial = {.position = position};
  return model;
}

}  // namespace

TEST_CASE("free decay: a normal load that vibrates fast releases the mass again", "[sim][free_decay]") {
  for (const auto& [ratio, position] : {std::pair{0.0, 0.21}, {0.002, 0.3}}) {
    CAPTURE(ratio);
    const sim::Model model = ridden(ratio, position);
    const sim::FreeDecay decay = sim::free_decay(model, 40);
    REQUIRE(decay.outcome.ok());
    check_against_simulate(model, decay);
    CHECK(decay.extremes.size() == turns(model, 20.0).size());
    CHECK(decay.came_to_rest == (ratio > 0.0));
    CHECK(decay.pauses == (ratio == 0.0));
    // The mean static limit holds it there.
    CHECK(120.0 * std::abs(decay.extremes.back().x) < 0.3 * 12.0);
  }
}

TEST_CASE("free decay: a normal vibration dies out, also of a contact that cools", "[sim][free_decay]") {
  const ParameterValues warming{{"power", 2.0}, {"time_constant", 500.0}};
  const ParameterValues warm{{"warming", std::vector<ParameterValues>{warming}}};
  for (const double ratio : {0.02, 0.5, 1.0, 2.0})
    for (const ParameterValues& more : {ParameterValues{}, warm}) {
      CAPTURE(ratio);
      const sim::Model model = ridden(ratio, 0.3, more);
      const sim::FreeDecay decay = sim::free_decay(model, 60);
      REQUIRE(decay.outcome.ok());
      CHECK(decay.came_to_rest);
      CHECK(decay.extremes.size() == turns(model, 20.0).size());
      check_against_simulate(model, decay);
    }
}

TEST_CASE("free decay: under a fluctuation without end a stick of 100 natural periods ends it",
          "[sim][free_decay]") {
  const sim::Model model = machine({fluctuating(0.4)}, 0.004);
  const sim::FreeDecay decay = sim::free_decay(model, 60);
  REQUIRE(decay.outcome.ok());
  CHECK(decay.pauses);
  CHECK_FALSE(decay.came_to_rest);
  // It first sticks at 0.07 s, and is held for 7 s only after 16.8 s.
  CHECK(decay.extremes.size() == 8);
  check_against_simulate(model, decay);
}

TEST_CASE("free decay: where nothing weakens what holds the mass, it sticks for good at once",
          "[sim][free_decay]") {
  const ParameterValues warming{{"power", 50.0}, {"time_constant", 30.0}};
  const ParameterValues lag{{"kinetic", 300.0}, {"static", 400.0}, {"stribeck_velocity", 0.01}, {"lag", 0.002}};
  ParameterValues delay = lag;
  delay.set("delay", true);
  const std::vector<Law> laws = {
      test::law("coulomb", {{"kinetic", 300.0}, {"static", 400.0}}),
      test::law("coulomb", {{"kinetic", 300.0}, {"warming", std::vector<ParameterValues>{warming}}}),
      coulomb_with("drift", 0.1),
      test::law("asymmetric_coulomb", {{"kinetic_forward", 300.0}, {"kinetic_backward", 200.0}}),
      test::law("stribeck", {{"kinetic", 300.0}, {"static", 400.0}, {"stribeck_velocity", 0.01}}),
      test::law("friction_lag", lag),
      test::law("friction_lag", delay)};
  for (std::size_t i = 0; i < laws.size(); ++i) {
    CAPTURE(i);
    const sim::Model model = machine({laws[i]}, 0.004);
    const sim::FreeDecay decay = sim::free_decay(model, 60);
    REQUIRE(decay.outcome.ok());
    CHECK(decay.came_to_rest);
    CHECK_FALSE(decay.pauses);
    check_against_simulate(model, decay);
  }
}

TEST_CASE("free decay: a mass that no law can hold rests where all forces cancel", "[sim][free_decay]") {
  const ParameterValues element{{"stiffness", 1000.0}, {"share", 1.0}};
  const ParameterValues lugre{
      {"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.1}, {"sigma0", 1000.0}, {"sigma1", 30.0}};
  ParameterValues elasto_plastic = lugre;
  elasto_plastic.set("elastic_limit", 1e-4);
  const std::vector<Law> laws = {
      test::law("dahl", {{"kinetic", 2.0}, {"sigma0", 1000.0}}),
      test::law("bouc_wen", {{"limit", 2.0}, {"stiffness", 1000.0}, {"exponent", 1.5}, {"ratio", 0.1}}),
      test::law("lugre", lugre),
      test::law("elasto_plastic", elasto_plastic),
      test::law("generalized_maxwell_slip", {{"kinetic", 2.0},
                                             {"stribeck_velocity", 0.1},
                                             {"elements", std::vector<ParameterValues>{element}},
                                             {"attraction", 10.0}}),
      test::law("rate_state", {{"normal_force", 10.0},
                               {"mu0", 0.2},
                               {"a", 0.02},
                               {"b", 0.015},
                               {"slip_distance", 1e-3},
                               {"reference_velocity", 0.01}}),
      test::law("viscous_power", {{"coefficient", 3.0}, {"exponent", 0.5}}),
      test::law("viscous_saturating", {{"coefficient", 3.0}, {"saturation_velocity", 0.1}}),
      test::law("attached_mass", {{"mass", 3.0}, {"stiffness", 8e4}})};
  for (std::size_t i = 0; i < laws.size(); ++i) {
    CAPTURE(i);
    const sim::FreeDecay decay = sim::free_decay(machine({laws[i]}, 0.0), 5);
    REQUIRE(decay.outcome.ok());
    CHECK(decay.came_to_rest);
    CHECK_FALSE(decay.creeps);
    CHECK(decay.extremes.size() == 1);
    CHECK_FALSE(sim::free_decay(machine({laws[i]}, 1e-18), 5).came_to_rest);
  }
}

TEST_CASE("simulate: every stop is followed by a release or by the end, in both engines", "[sim][free_decay]") {
  for (const sim::SolverKind solver : {sim::SolverKind::automatic, sim::SolverKind::implicit_steps})
    for (const Law& law : {fluctuating(0.6), coulomb_with("drift", -0.4)}) {
      sim::Model model = machine({law}, 0.004);
      model.solver.kind = solver;
      const sim::History history = sim::simulate(model, {.duration = 4.0});
      REQUIRE(history.outcome.ok());
      bool is_held = false;
      long releases = 0;
      for (const sim::Event& event : history.events) {
        if (event.kind != EventKind::stop && event.kind != EventKind::release) continue;
        CAPTURE(event.t);
        CHECK((event.kind == EventKind::release) == is_held);
        is_held = event.kind == EventKind::stop;
        releases += is_held ? 0 : 1;
      }
      CHECK(releases > 2);
    }
}

namespace {

/// A force that begins at 1 s, of a law that does not hold the mass.
struct LateForce {
  [[nodiscard]] static friction::Memory start(const friction::Instant&) { return {}; }
  [[nodiscard]] static friction::Affine affine_force(const friction::Memory& memory, const friction::Instant&,
                                                     friction::Direction) {
    return {.constant = memory.mode == 1 ? 2.0 : 0.0};
  }
  static void jump(friction::Memory& memory, friction::Trigger trigger, const friction::Instant&,
                   friction::Direction) {
    if (trigger.cause == friction::Trigger::scheduled) memory.mode = 1;
  }
  [[nodiscard]] static double next_change(const friction::Memory& memory) {
    return memory.mode == 0 ? 1.0 : std::numeric_limits<double>::infinity();
  }
};

}  // namespace

TEST_CASE("simulate: a law that begins to push a mass at rest releases it", "[sim][free_decay]") {
  const sim::Model model = machine({Law(LateForce{})}, 0.0);
  const sim::History history = sim::simulate(model, {.duration = 1.01});
  REQUIRE(history.outcome.ok());
  REQUIRE(history.events.size() == 1);
  CHECK(history.events.front().kind == EventKind::release);
  CHECK(history.events.front().t == 1.0);
  CHECK(history.final.x < 0.0);
}
