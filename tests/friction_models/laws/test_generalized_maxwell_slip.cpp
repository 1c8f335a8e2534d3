#include "friction_models/laws/generalized_maxwell_slip.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/iwan.hpp"
#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sliding.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::GeneralizedMaxwellSlip;
using friction::Law;
using friction::ParameterValues;
using friction::StribeckCurve;

namespace {

using Elements = std::vector<GeneralizedMaxwellSlip::Element>;

const Elements four{{4e4, 0.1}, {3e4, 0.2}, {2e4, 0.3}, {1e4, 0.4}};

ParameterValues maxwell_slip_values(const Elements& elements, double static_level, double attraction) {
  std::vector<ParameterValues> list;
  for (const auto& [stiffness, share] : elements) list.push_back({{"stiffness", stiffness}, {"share", share}});
  return {{"elements", list},
          {"kinetic", 2.0},
          {"static", static_level},
          {"stribeck_velocity", 0.01},
          {"attraction", attraction}};
}

Law maxwell_slip_law(const Elements& elements, double static_level, double attraction, double factor = 1.0) {
  return Law(
      GeneralizedMaxwellSlip(elements, StribeckCurve(2.0 * factor, factor * static_level, 0.01), attraction));
}

sim::LawCase maxwell_slip(const Elements& elements, double static_level, double attraction) {
  sim::LawCase c =
      sim::law_case("generalized_maxwell_slip", maxwell_slip_values(elements, static_level, attraction));
  c.stroke = 1e-3;
  c.passive = static_level == 2.0;
  c.scaled = [=](double factor) { return maxwell_slip_law(elements, static_level, attraction, factor); };
  return c;
}

/// Drags the law by `distance` at this speed, without a stop before.
void drag_on(sim::LawHost& host, double speed, double distance) {
  test::go_on(host, speed, distance / std::abs(speed));
}

}  // namespace

TEST_CASE("generalized_maxwell_slip conforms to the law contract", "[friction][generalized_maxwell_slip]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(maxwell_slip(four, 2.0, 10.0)) == none);
  CHECK(sim::nonconformities(maxwell_slip(four, 3.0, 10.0)) == none);
  CHECK(sim::nonconformities(maxwell_slip(four, 3.0, 1e3)) == none);
  CHECK(sim::nonconformities(maxwell_slip({{1e4, 1.0}}, 3.0, 1e3)) == none);
}

TEST_CASE("generalized_maxwell_slip: first loading, then the level of steady slip",
          "[friction][generalized_maxwell_slip]") {
  const Law law = maxwell_slip_law(four, 3.0, 100.0);
  for (const double v : {1e-4, 0.01, 0.05}) {
    INFO(v);
    sim::LawHost host(law, {});
    host.change_direction(Direction::forward);
    drag_on(host, v, 3e-6);
    CHECK(host.force() == Approx(1e5 * 3e-6).epsilon(1e-12));  // all stuck: below 0.1 x 2 N/4e4
    const double r = v / 0.01;
    drag_on(host, v, 1e-3 + 2.0 * v);  // the last one slips at 0.4 x 3 N/1e4 at most; 2 s relax as exp(-100/3 t)
    CHECK(host.events() == 4);
    CHECK(host.force() == Approx(2.0 + std::exp(-r * r)).epsilon(1e-9));
  }
}

TEST_CASE("generalized_maxwell_slip: a slipping element follows the level with a delay",
          "[friction][generalized_maxwell_slip]") {
  // From steady slip at v1 to v2: F_i' = C (share - F_i/s), so F = s2 + (s1 - s2) exp(-C t/s2) whatever the shares.
  const double attraction = 20.0;
  sim::LawHost host(maxwell_slip_law(four, 3.0, attraction), {});
  host.change_direction(Direction::forward);
  drag_on(host, 1e-3, 5e-3);
  const double s1 = 2.0 + std::exp(-0.01);
  REQUIRE(host.force() == Approx(s1).epsilon(1e-9));
  const double s2 = 2.0 + std::exp(-4.0);
  drag_on(host, 0.02, 0.02 * 0.07);
  CHECK(host.force() == Approx(s2 + (s1 - s2) * std::exp(-attraction * 0.07 / s2)).epsilon(1e-9));
}

TEST_CASE("generalized_maxwell_slip: with one level it is iwan, Masing's loops and all",
          "[friction][generalized_maxwell_slip]") {
  std::vector<friction::Iwan::Element> elements;
  for (const auto& [stiffness, share] : four) elements.push_back({stiffness, 2.0 * share});
  sim::LawHost iwan(Law(friction::Iwan(elements)), {});
  sim::LawHost maxwell(maxwell_slip_law(four, 2.0, 50.0), {});
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const double x = random.sign() * random.logarithmic(1e-6, 3e-4);
    iwan.move_to(x);
    maxwell.move_to(x);
    CHECK(std::abs(iwan.force() - maxwell.force()) < 1e-8);
  }
}

TEST_CASE("generalized_maxwell_slip: with static above kinetic a loop can give out work, and it says so",
          "[friction][generalized_maxwell_slip]") {
  // One element. Slipping fast at kinetic, it is slowed down until its force is static, at no distance; let down to
  // F = 0 it returns static^2/(2 k). Drawn back as fast as at first it takes kinetic^2/(2 k) and kinetic (static -
  // kinetic)/k: (static - kinetic)^2/(2 k) is won.
  const double k = 1e4;
  sim::LawHost host(maxwell_slip_law({{k, 1.0}}, 3.0, 1e4), {});
  host.change_direction(Direction::forward);
  drag_on(host, 1.0, 0.1);
  REQUIRE(host.force() == Approx(2.0).epsilon(1e-9));
  const double before = host.work();
  drag_on(host, 1e-9, 1e-11);
  CHECK(host.force() == Approx(3.0).epsilon(1e-9));
  host.change_direction(Direction::backward);
  drag_on(host, -1.0, 3.0 / k);
  CHECK(std::abs(host.force()) < 1e-9);
  host.change_direction(Direction::forward);
  drag_on(host, 1.0, 3.0 / k);
  CHECK(host.force() == Approx(2.0).epsilon(1e-9));
  CHECK(host.work() - before == Approx(-1.0 / (2.0 * k)).epsilon(1e-5));
  CHECK_FALSE(GeneralizedMaxwellSlip::warnings(maxwell_slip_values(four, 3.0, 1.0)).empty());
  CHECK(GeneralizedMaxwellSlip::warnings(maxwell_slip_values(four, 2.0, 1.0)).empty());
}

TEST_CASE("generalized_maxwell_slip: shares that do not add to 1 are refused",
          "[friction][generalized_maxwell_slip]") {
  const friction::LawEntry& entry = *friction::find_law("generalized_maxwell_slip");
  const auto faults = [&](const Elements& elements) {
    ParameterValues given = maxwell_slip_values(elements, 3.0, 10.0);
    return friction::complete(entry, given);
  };
  CHECK(faults(four).empty());
  CHECK(faults({{1e4, 0.333333333333}, {1e4, 0.333333333333}, {1e4, 0.333333333333}}).empty());
  const auto found = faults({{1e4, 0.5}, {1e4, 0.4}});
  REQUIRE(found.size() == 1);
  CHECK(found[0].name == "elements");
  CHECK(found[0].found == "a sum of 0.9");
}
