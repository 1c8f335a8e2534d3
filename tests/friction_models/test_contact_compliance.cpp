#include "friction_models/contact_compliance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/simulate.hpp"
#include "tests/support/law_conformance.hpp"

using namespace dualdamp;
using friction::Affine;
using friction::ContactCompliance;
using friction::Direction;
using friction::Instant;
using friction::Memory;

namespace {

test::LawCase contact(double kinetic, double static_level, double stiffness, double damping) {
  test::LawCase c = test::law_case("contact_compliance", {{"kinetic", kinetic},
                                                          {"static", static_level},
                                                          {"contact_stiffness", stiffness},
                                                          {"contact_damping", damping}});
  // Strokes of many times the travel to break-away visit all modes.
  c.stroke = 20.0 * std::max(static_level, 0.1) / stiffness;
  return c;
}

/// m = 1, k = 100, c = 4, base 0.1 m at 10 rad/s.
sim::Model standard_system(const friction::Law& law) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  model.friction = {law};
  return model;
}

struct Settled {
  double peak = 0.0;
  double friction_work = 0.0;
};

/// One period after the transient has decayed to rounding: exp(-zeta wn t) = exp(-2 t).
Settled settled(const friction::Law& law) {
  const double period = std::numbers::pi / 5.0;
  const sim::Model model = standard_system(law);
  const sim::History before = sim::simulate(model, {.duration = 60.0 * period});
  const sim::History after = sim::simulate(model, {.duration = 61.0 * period});
  REQUIRE(after.outcome.ok());
  Settled result;
  result.friction_work = after.energy.friction - before.energy.friction;
  for (const sim::Event& event : after.events) {
    if (event.t > 60.0 * period && event.kind == sim::EventKind::reversal)
      result.peak = std::max(result.peak, event.x);
  }
  return result;
}

}  // namespace

TEST_CASE("contact_compliance conforms to the law contract", "[friction][contact_compliance]") {
  const std::vector<std::string> none;
  CHECK(test::nonconformities(contact(2.0, 2.0, 1e3, 0.0)) == none);
  CHECK(test::nonconformities(contact(2.0, 3.0, 1e3, 0.0)) == none);
  CHECK(test::nonconformities(contact(2.0, 2.0, 1e3, 5.0)) == none);
  CHECK(test::nonconformities(contact(2.0, 3.0, 1e3, 500.0)) == none);
  CHECK(test::nonconformities(contact(0.0, 0.0, 1e7, 0.0)) == none);
}

TEST_CASE("contact_compliance: the slider jumps at break-away, the mass does not",
          "[friction][contact_compliance]") {
  const friction::Law law(ContactCompliance(2.0, 3.0, 1000.0, 0.0));
  Memory memory = law.start({.x = 0.5});
  CHECK(law.force(memory, {.x = 0.502}, Direction::forward) == Approx(2.0).epsilon(1e-13));
  const Instant broken{.x = 0.503, .v = 1.0};
  std::vector<double> guards;
  law.guards(memory, broken, Direction::forward, guards);
  REQUIRE(guards.size() == 2);
  CHECK(std::abs(guards[0]) < 1e-12);
  CHECK(guards[1] == Approx(6.0).epsilon(1e-13));
  law.jump(memory, {0}, broken, Direction::forward);
  CHECK(law.force(memory, broken, Direction::forward) == 2.0);
  // It re-sticks at the reversal with its spring stretched by kinetic/stiffness.
  const Instant turned{.x = 0.6};
  law.jump(memory, {}, turned, Direction::rest);
  CHECK(law.force(memory, turned, Direction::rest) == Approx(2.0).epsilon(1e-13));
  CHECK(law.force(memory, {.x = 0.597}, Direction::backward) == Approx(-1.0).epsilon(1e-13));
}

TEST_CASE("contact_compliance: a damped spring relaxes to kinetic/stiffness and stops before the mass",
          "[friction][contact_compliance]") {
  const double kinetic = 2.0;
  const double stiffness = 1000.0;
  const double damping = 20.0;
  const friction::Law law(ContactCompliance(kinetic, kinetic, stiffness, damping));
  Memory memory = law.start({});
  const Instant broken{.x = 0.001, .v = 0.05};  // 1 N in the spring, 1 N in the damper
  law.jump(memory, {0}, broken, Direction::forward);
  const double v = 0.05;
  const double t = 0.013;
  const Instant later{.t = t, .x = 0.001 + v * t, .v = v};
  law.advance(memory, broken, later, t, Direction::forward);
  const double u = kinetic / stiffness + (0.001 - kinetic / stiffness) * std::exp(-stiffness / damping * t);
  CHECK(memory.state[0] == Approx(u).epsilon(1e-14));
  std::vector<double> guards;
  law.guards(memory, later, Direction::forward, guards);
  REQUIRE(guards.size() == 1);
  CHECK(guards[0] == Approx(v - (kinetic - stiffness * u) / damping).epsilon(1e-12));
  // Where the slider stops the force is kinetic still: the spring takes over from the slider without a jump.
  const Instant stopped{.t = t, .x = later.x, .v = (kinetic - stiffness * u) / damping};
  law.jump(memory, {0}, stopped, Direction::forward);
  CHECK(law.force(memory, stopped, Direction::forward) == Approx(kinetic).epsilon(1e-13));
}

TEST_CASE("contact_compliance: under a growing limit the slider stops before the mass",
          "[friction][contact_compliance]") {
  // The spring of a sliding contact lengthens with the limit: a' = v - kinetic rate/stiffness.
  const ContactCompliance law(2.0, 2.0, 1000.0, 0.0);
  const Instant now{.x = 0.1, .v = 0.3, .modification = {.factor = 1.5, .factor_rate = 4.0}};
  Memory memory = law.start({});
  law.jump(memory, {0}, now, Direction::forward);
  std::vector<Affine> guards;
  law.affine_guards(memory, now, Direction::forward, guards);
  REQUIRE(guards.size() == 1);
  CHECK(friction::value(guards[0], now) == Approx(0.3 - 2.0 * 4.0 / 1000.0).epsilon(1e-14));
  law.jump(memory, {}, now, Direction::rest);
  CHECK(law.affine_force(memory, now, Direction::rest).rate == Approx(8.0).epsilon(1e-14));
  // A step of the limit halts the spring at its present force.
  law.jump(memory, {friction::Trigger::limit_change}, now, Direction::forward);
  CHECK(friction::value(law.affine_force(memory, now, Direction::forward), now) == Approx(3.0).epsilon(1e-13));
}

TEST_CASE("contact_compliance: peaks of the standard system", "[friction][contact_compliance]") {
  // Independent values of a calculation with 30 digits, rounded to 15; 60 periods leave exp(-75) of the transient.
  const struct {
    double stiffness;
    double peak;
  } known[] = {{1e3, 0.18715434612621097}, {1e4, 0.186333154800891}, {1e5, 0.186150328050063}};
  for (const auto& [stiffness, peak] : known) {
    INFO(stiffness);
    const Settled motion = settled(friction::Law(ContactCompliance(2.0, 2.0, stiffness, 0.0)));
    CHECK(std::abs(motion.peak - peak) < 1e-14);
    // The Jenkins loop of an amplitude A: 4 kinetic (A - kinetic/stiffness).
    CHECK(motion.friction_work == Approx(8.0 * (motion.peak - 2.0 / stiffness)).epsilon(1e-11));
  }
}
