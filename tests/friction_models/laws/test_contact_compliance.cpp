#include "friction_models/laws/contact_compliance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/analytic/contact.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::Affine;
using friction::ContactCompliance;
using friction::Direction;
using friction::Instant;
using friction::Memory;

namespace {

sim::LawCase contact(double kinetic, double static_level, double stiffness, double damping) {
  sim::LawCase c = sim::law_case("contact_compliance", {{"kinetic", kinetic},
                                                        {"static", static_level},
                                                        {"contact_stiffness", stiffness},
                                                        {"contact_damping", damping}});
  // Strokes of many times the travel to break-away visit all modes.
  c.stroke = 20.0 * std::max(static_level, 0.1) / stiffness;
  c.scaled = [=](double factor) {
    return friction::Law(ContactCompliance(factor * kinetic, factor * static_level, stiffness, damping));
  };
  return c;
}

}  // namespace

TEST_CASE("contact_compliance conforms to the law contract", "[friction][contact_compliance]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(contact(2.0, 2.0, 1e3, 0.0)) == none);
  CHECK(sim::nonconformities(contact(2.0, 3.0, 1e3, 0.0)) == none);
  CHECK(sim::nonconformities(contact(2.0, 2.0, 1e3, 5.0)) == none);
  CHECK(sim::nonconformities(contact(2.0, 3.0, 1e3, 500.0)) == none);
  CHECK(sim::nonconformities(contact(0.0, 0.0, 1e7, 0.0)) == none);
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
  law.jump(memory, {}, turned, Direction::none);
  CHECK(law.force(memory, turned, Direction::none) == Approx(2.0).epsilon(1e-13));
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
  CHECK(memory.state[0] == Approx((kinetic - stiffness * u) / damping).epsilon(1e-13));
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
  law.jump(memory, {}, now, Direction::none);
  CHECK(law.affine_force(memory, now, Direction::none).rate == Approx(8.0).epsilon(1e-14));
  // A step of the limit halts the spring at its present force.
  law.jump(memory, {friction::Trigger::limit_change}, now, Direction::forward);
  CHECK(friction::value(law.affine_force(memory, now, Direction::forward), now) == Approx(3.0).epsilon(1e-13));
}

TEST_CASE("contact_compliance: peaks of the standard system", "[friction][contact_compliance]") {
  // Independent values of a calculation with 30 digits, rounded to 15.
  const struct {
    double stiffness;
    double peak;
  } known[] = {{1e3, 0.18715434612621097}, {1e4, 0.186333154800891}, {1e5, 0.186150328050063}};
  for (const auto& [stiffness, peak] : known) {
    INFO(stiffness);
    const test::SettledMotion motion =
        test::settled_motion(friction::Law(ContactCompliance(2.0, 2.0, stiffness, 0.0)));
    CHECK(std::abs(motion.peak - peak) < 1e-14);
    // The Jenkins loop of an amplitude A: 4 kinetic (A - kinetic/stiffness).
    CHECK(motion.friction_work == Approx(8.0 * (motion.peak - 2.0 / stiffness)).epsilon(1e-11));
  }
}

TEST_CASE("contact_compliance: the Jenkins loop of any amplitude", "[friction][contact_compliance]") {
  // W = 4 kinetic (A - kinetic/stiffness) when A > kinetic/stiffness, else nothing. With static > kinetic the
  // spring is drawn to static/stiffness before it lets go: the difference of both stored energies is lost, twice a
  // loop.
  const double stiffness = 1000.0;
  for (const double static_level : {2.0, 3.0}) {
    for (const double amplitude : {0.0009, 0.0035, 0.01, 1.0}) {
      INFO(static_level << " N, " << amplitude << " m");
      sim::LawHost host(friction::Law(ContactCompliance(2.0, static_level, stiffness, 0.0)), {});
      for (int i = 0; i < 4; ++i) host.move_to(i % 2 == 0 ? amplitude : -amplitude);
      const double before = host.work();
      host.move_to(amplitude);
      host.move_to(-amplitude);
      const double lost = (static_level * static_level - 4.0) / (2.0 * stiffness);
      const double travel = 2.0 * amplitude - (2.0 + static_level) / stiffness;
      const double loop = travel > 0.0 ? 2.0 * (2.0 * travel + lost) : 0.0;
      CHECK(std::abs(host.work() - before - loop) < 1e-12 * (loop + 4.0 * amplitude));
    }
  }
}

TEST_CASE("contact_compliance: sliding sets in at the speed of Eq (18)", "[friction][contact_compliance]") {
  // Exact for harmonic x: the mass reverses at X and comes back along X cos wt.
  const double omega = 38.5;
  const double X = 4.25e-3;
  const double kinetic = 3.5;
  for (const double stiffness : {11.6e4, 1.2e4, 1.7e3}) {
    INFO(stiffness);
    sim::LawHost host(friction::Law(ContactCompliance(kinetic, kinetic, stiffness, 0.0)), {.x = -X});
    host.move_to(X);
    const double turned = host.now().t;
    const sim::Path back = [&](double t) {
      const double angle = omega * (t - turned);
      return Instant{t, X * std::cos(angle), -X * omega * std::sin(angle)};
    };
    host.change_direction(Direction::backward);
    host.move_along(turned + 3.14 / omega, back);
    const std::optional<double> speed = sim::analytic::transition_velocity(omega, X, kinetic, stiffness);
    REQUIRE(speed.has_value());
    // Bisection finds the break to rounding of the time, 1 s, of a motion that takes 1/omega.
    CHECK(std::abs(-host.last_event().v - *speed) < 1e-12 * *speed);
  }
}
