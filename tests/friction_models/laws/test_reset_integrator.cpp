#include "friction_models/laws/reset_integrator.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Instant;
using friction::ResetIntegrator;

namespace {

sim::LawCase reset_integrator(double kinetic, double stiffness, double static_gain, double damping) {
  sim::LawCase c = sim::law_case(
      "reset_integrator",
      {{"kinetic", kinetic}, {"stiffness", stiffness}, {"static_gain", static_gain}, {"damping", damping}});
  c.stroke = 20.0 * std::max(kinetic, 0.1) / stiffness;
  c.scaled = [=](double factor) {
    return friction::Law(ResetIntegrator(factor * kinetic, stiffness, static_gain, damping));
  };
  return c;
}

}  // namespace

TEST_CASE("reset_integrator conforms to the law contract", "[friction][reset_integrator]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(reset_integrator(2.0, 1e3, 0.0, 0.0)) == none);
  CHECK(sim::nonconformities(reset_integrator(2.0, 1e3, 0.5, 0.0)) == none);
  CHECK(sim::nonconformities(reset_integrator(2.0, 1e3, 1.5, 20.0)) == none);
  CHECK(sim::nonconformities(reset_integrator(0.0, 1e6, 0.3, 0.0)) == none);
}

TEST_CASE("reset_integrator: the force falls at break-away and rises when the bond holds again",
          "[friction][reset_integrator]") {
  // z0 = 2 mm; the bond breaks at 1.5 * 2 N = 3 N.
  sim::LawHost host(friction::Law(ResetIntegrator(2.0, 1000.0, 0.5, 0.0)), {.x = 0.3});
  host.move_to(0.3015);
  CHECK(host.force() == Approx(1.5 * 1000.0 * 0.0015).epsilon(1e-12));
  host.move_to(0.310);
  CHECK(host.last_event().x == Approx(0.302).epsilon(1e-12));
  CHECK(host.force() == 2.0);
  host.change_direction(Direction::backward);
  CHECK(host.force() == Approx(3.0).epsilon(1e-12));
  host.move_to(0.308);
  CHECK(std::abs(host.force()) < 1e-10);
  host.move_to(0.300);
  CHECK(host.last_event().x == Approx(0.306).epsilon(1e-12));
  CHECK(host.force() == -2.0);
}

TEST_CASE("reset_integrator without static gain is contact_compliance", "[friction][reset_integrator]") {
  sim::LawHost bond(friction::Law(ResetIntegrator(2.0, 1000.0, 0.0, 0.0)), {});
  sim::LawHost contact(friction::Law(friction::ContactCompliance(2.0, 2.0, 1000.0, 0.0)), {});
  for (const double x : {0.001, -0.002, 0.01, 0.0071, 0.009, -0.03, 0.0}) {
    bond.move_to(x);
    contact.move_to(x);
    CHECK(std::abs(bond.force() - contact.force()) < 1e-12);
  }
}

TEST_CASE("reset_integrator: a loop takes 4 kinetic (A - z0)", "[friction][reset_integrator]") {
  // In stick the force runs from +(1 + a) kinetic to its negative and takes no work; it slips over 2 (A - z0).
  for (const double static_gain : {0.0, 0.5, 2.0}) {
    INFO(static_gain);
    const friction::Law law(ResetIntegrator(2.0, 1000.0, static_gain, 0.0));
    sim::LawHost host(law, {});
    host.move_to(-0.05);
    host.move_to(0.05);
    const double before = host.work();
    host.move_to(-0.05);
    host.move_to(0.05);
    CHECK(host.work() - before == Approx(8.0 * (0.05 - 0.002)).epsilon(1e-12));
    const test::SettledMotion motion = test::settled_motion(law);
    CHECK(motion.friction_work == Approx(8.0 * (motion.peak - 0.002)).epsilon(1e-11));
  }
}
