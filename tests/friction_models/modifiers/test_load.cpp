// A load of the contact that varies with position or with the drive: load_gradient, load_modulation.

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/engine/engine.hpp"
#include "sim/law_host/law_host.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/friction_models/modifiers/modified_laws.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::Coulomb;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;
using friction::ParameterValues;
using test::coulomb_with;
using test::loop_work;

namespace {

ParameterValues modulation(double ratio, double order, double phase) {
  const ParameterValues record{{"ratio", ratio}, {"order", order}, {"phase", phase}};
  return {{"load_modulation", std::vector<ParameterValues>{record}}};
}

}  // namespace

TEST_CASE("load_gradient: laws under it conform to the law contract", "[friction][load]") {
  const std::vector<std::string> none;
  for (const double gradient : {3.0, -25.0}) {
    CHECK(sim::nonconformities(
              sim::law_case("coulomb", {{"kinetic", 2.0}, {"static", 3.0}, {"load_gradient", gradient}})) == none);
    CHECK(sim::nonconformities(
              sim::law_case("coulomb", {{"kinetic", 2.0}, {"load_gradient", gradient}, {"drift", -0.05}})) == none);
    CHECK(sim::nonconformities(sim::law_case(
              "contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e3}, {"load_gradient", gradient}})) ==
          none);
    CHECK(sim::nonconformities(sim::law_case(
              "stribeck",
              {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}, {"load_gradient", gradient}})) ==
          none);
  }
}

TEST_CASE("load_gradient: a warming contact has its guards also where its load is just gone, and at rest",
          "[friction][load]") {
  const ParameterValues warming{{"power", 1e-3}, {"time_constant", 1.0}};
  const Law law = friction::modified(Law(friction::ContactCompliance(2.0, 2.0, 1e3, 0.0)),
                                     {{"load_gradient", -100.0}, {"warming", std::vector{warming}}}, {2.0});
  Instant now{.v = 1.0};
  Memory memory = law.start(now);
  now.x = 0.002;
  law.jump(memory, {1}, now, Direction::forward);  // behind the guard of the load: slips forward
  const auto count = [&](double x, double v) {
    std::vector<double> guards;
    law.guards(memory, {.x = x, .v = v}, Direction::forward, guards);
    return guards.size();
  };
  REQUIRE(count(0.003, 1.0) == 2);  // of the load, and the slider's own
  CHECK(count(0.01, 1.0) == 2);
  CHECK(count(0.01 * (1.0 - 1e-15), 1.0) == 2);
  CHECK(count(0.003, 0.0) == 2);
}

TEST_CASE("load_gradient: the work of a loop is that of the load along the way", "[load]") {
  // Twice the integral of F (1 + g x) from low to high; below x = -1/g there is no load.
  const double F = 2.0;
  const double g = 4.0;
  const Law law = coulomb_with(F, F, {{"load_gradient", g}});
  const auto integral = [&](double low, double high) {
    return F * (high - low + 0.5 * g * (high * high - low * low));
  };
  CHECK(loop_work(law, -0.1, 0.2) == Approx(2.0 * integral(-0.1, 0.2)).epsilon(1e-11));
  CHECK(loop_work(law, -0.6, 0.2) == Approx(2.0 * integral(-0.25, 0.2)).epsilon(1e-11));
  CHECK(loop_work(law, -0.6, -0.3) == 0.0);
}

TEST_CASE("load_gradient: free half swings about a middle of their own, on a spring of their own", "[load]") {
  // Slipping in direction s the force s F (1 + g x) is a spring s F g and a constant s F: a swing from a ends at
  // 2 m - a with m = -s F/(k + s F g), after half a period of that spring.
  const double F = 2.0;
  const double g = 3.0;
  const double k = 100.0;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = k};
  model.friction = {coulomb_with(F, F, {{"load_gradient", g}})};
  model.initial = {.position = 0.25};
  const sim::History history = sim::simulate(model, {.duration = 20.0});
  REQUIRE(history.outcome.ok());
  double a = 0.25;
  double t = 0.0;
  int turns = 0;
  for (const sim::Event& event : history.events) {
    if (event.kind != sim::EventKind::reversal && event.kind != sim::EventKind::stop) continue;
    const double s = a > 0.0 ? -1.0 : 1.0;
    const double spring = k + s * F * g;
    a = -2.0 * s * F / spring - a;
    t += std::acos(-1.0) / std::sqrt(spring);
    CHECK(event.x == Approx(a).margin(1e-13));
    CHECK(event.t == Approx(t).epsilon(1e-13));
    ++turns;
  }
  CHECK(turns >= 5);
  CHECK(history.events.back().kind == sim::EventKind::stop);
  CHECK(k * std::abs(a) <= F * (1.0 + g * a));
}

TEST_CASE("load_gradient: both engines agree where the load is lost in each period", "[load]") {
  sim::Model model = test::standard_system(coulomb_with(3.0, 4.5, {{"load_gradient", 12.0}}));
  model.friction.push_back(friction::modified(Law(friction::ContactCompliance(2.0, 2.0, 800.0, 0.0)),
                                              {{"load_gradient", -14.0}}, {2.0}));
  const sim::SteadyState exact = sim::steady_state(model);
  model.solver = {.kind = sim::SolverKind::explicit_steps, .tolerance = 1e-12};
  const sim::SteadyState smooth = sim::steady_state(model);
  REQUIRE(exact.outcome.ok());
  REQUIRE(smooth.outcome.ok());
  CHECK(exact.trough < -1.0 / 12.0);
  CHECK(exact.peak > 1.0 / 14.0);
  CHECK(std::abs(exact.peak - smooth.peak) < 1e-9);
  CHECK(std::abs(exact.trough - smooth.trough) < 1e-9);
  CHECK(std::abs(exact.energy.friction - smooth.energy.friction) < 1e-9);
}

TEST_CASE("load_modulation: within a slip it is a harmonic force, which the exact engine computes", "[load]") {
  // s F (1 + r cos(n w t + p)) is Coulomb friction and the force -s F r cos(n w t + p) beside the drive.
  const double F = 3.0;
  const double ratio = 0.6;
  for (const int order : {1, 3}) {
    for (const double s : {1.0, -1.0}) {
      const double phase = 0.7;
      sim::Model model;
      model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 2.0};
      model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 5.0, .frequency = 7.0};
      model.initial = {.velocity = 4.0 * s};
      sim::Model equivalent = model;
      model.friction = {coulomb_with(F, F, modulation(ratio, order, phase))};
      equivalent.friction = {Law(Coulomb(F, F))};
      // Orders count from 2: the fundamental becomes one of half the frequency without amplitude.
      equivalent.excitation.amplitude = 0.0;
      equivalent.excitation.frequency = 7.0 / 2.0;
      equivalent.excitation.harmonics = {
          {.order = 2, .amplitude = 5.0, .phase = 0.0},
          {.order = 2 * order, .amplitude = F * ratio, .phase = phase + (s > 0.0 ? std::acos(-1.0) : 0.0)}};
      REQUIRE_FALSE(sim::is_exact(model));
      const auto first_turn = [](const sim::Model& m) {
        return sim::simulate(m, {.duration = 1.0}).events.front();
      };
      const sim::Event one = first_turn(model);
      const sim::Event other = first_turn(equivalent);
      CHECK(one.t > 0.1);
      CHECK(one.t == Approx(other.t).epsilon(1e-9));
      CHECK(one.x == Approx(other.x).epsilon(1e-9));
    }
  }
}

TEST_CASE("load_modulation follows the phase of the drive over many periods", "[load]") {
  // A motion shifted by whole periods is the same motion; and a drive of another phase with the load shifted alike.
  sim::Model model = test::standard_system(coulomb_with(2.0, 3.0, modulation(0.8, 2, 0.4)));
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(std::abs(state.energy.defect) < 1e-9);
  const double period = state.period;
  const sim::History history = sim::simulate(model, {.duration = 40.0 * period, .sample_rate = 64.0 / period});
  REQUIRE(history.outcome.ok());
  double peak = -1.0;
  for (std::size_t i = history.samples.size() - 128; i < history.samples.size(); ++i)
    peak = std::max(peak, history.samples[i].x);
  CHECK(peak == Approx(state.peak).epsilon(2e-3));
  const double plain = sim::steady_state(test::standard_system(Law(Coulomb(2.0, 3.0)))).amplitude;
  CHECK(std::abs(state.amplitude / plain - 1.0) > 1e-4);
}

TEST_CASE("load_modulation: the mass sticks up to the limit of the moment", "[load]") {
  // A constant push of 2 N against a limit of 3 (1 + 0.5 cos w t): the mass lets go where the limit falls to 2.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0};
  model.excitation = {
      .type = sim::ExcitationType::force_harmonic, .amplitude = 0.0, .frequency = 5.0, .offset = 2.0};
  model.friction = {coulomb_with(3.0, 3.0, modulation(0.5, 1, 0.0))};
  const sim::History history = sim::simulate(model, {.duration = 1.0});
  REQUIRE(history.outcome.ok());
  const auto release = std::ranges::find(history.events, sim::EventKind::release, &sim::Event::kind);
  REQUIRE(release != history.events.end());
  CHECK(release->t == Approx(std::acos(-2.0 / 3.0) / 5.0).epsilon(1e-9));
}
