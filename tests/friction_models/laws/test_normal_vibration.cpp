#include "friction_models/laws/normal_vibration.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/sliding.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Law;
using friction::NormalVibration;

namespace {

constexpr NormalVibration::Rider rider = {.mu = 0.1,
                                          .mu_static = 0.15,
                                          .weight = 20.0,
                                          .normal_mass = 0.1,
                                          .static_approach = 1e-4,
                                          .normal_damping_ratio = 0.1,
                                          .lift = 20.0,
                                          .lift_velocity = 0.5};

friction::ParameterValues named(const NormalVibration::Rider& r) {
  return {{"mu", r.mu},
          {"mu_static", r.mu_static},
          {"weight", r.weight},
          {"normal_mass", r.normal_mass},
          {"static_approach", r.static_approach},
          {"normal_damping_ratio", r.normal_damping_ratio},
          {"lift", r.lift},
          {"lift_velocity", r.lift_velocity}};
}

sim::LawCase vibrating(const NormalVibration::Rider& r) {
  sim::LawCase c = sim::law_case("normal_vibration", named(r));
  c.stroke_time = 0.05;
  c.scaled = [=](double factor) {
    NormalVibration::Rider scaled = r;
    scaled.mu *= factor;
    scaled.mu_static *= factor;
    return Law(NormalVibration(scaled));
  };
  return c;
}

NormalVibration::Rider jumping() {
  NormalVibration::Rider r = rider;
  r.lift = 100.0;
  r.normal_damping_ratio = 0.0;
  return r;
}

}  // namespace

TEST_CASE("normal_vibration conforms to the law contract", "[friction][normal_vibration]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(vibrating(rider)) == none);
  CHECK(sim::nonconformities(vibrating(jumping())) == none);
}

TEST_CASE("normal_vibration: without lift it is coulomb exactly", "[friction][normal_vibration]") {
  NormalVibration::Rider r = rider;
  r.lift = 0.0;
  sim::LawHost host(Law(NormalVibration(r)), {});
  for (const double speed : {0.3, -2.0, 1e-6, 0.0}) {
    test::slide(host, speed, 0.1);
    CHECK(host.force() == (speed > 0.0 ? 2.0 : speed < 0.0 ? -2.0 : 0.0));
    CHECK(host.law().static_limit(host.memory(), host.now()) == Approx(3.0).epsilon(1e-15));
  }
  CHECK(host.memory().state == std::vector<double>{0.0, 0.0});
}

TEST_CASE("normal_vibration: friction falls with the speed of steady slip", "[friction][normal_vibration]") {
  // N = weight - lift; 0.2 s leave exp(-0.1 2000 0.2) of the start. The states are kept to 1e-11.
  for (const double speed : {0.05, -0.5, 1.0}) {
    INFO(speed);
    sim::LawHost host(Law(NormalVibration(rider)), {});
    test::slide(host, speed, 0.2);
    const double lift = 20.0 * std::abs(speed) / (1.0 + std::abs(speed) / 0.5);
    CHECK(host.force() == Approx(std::copysign(0.1 * (20.0 - lift), speed)).epsilon(1e-8));
  }
}

TEST_CASE("normal_vibration: the stiffness of small vibrations", "[friction][normal_vibration]") {
  // y'' = -(2 weight/(h0 m)) y - 2 ratio w y', w = sqrt(4e6); the square of y/h0 = 1e-7 is left out.
  const Law law{NormalVibration(rider)};
  std::array<double, 2> rates{};
  law.rates({.state = {1e-11, 0.0}}, {}, Direction::none, rates);
  CHECK(rates[1] == Approx(-4e6 * 1e-11).epsilon(1e-6));
  law.rates({.state = {0.0, 1e-3}}, {}, Direction::none, rates);
  CHECK(rates[0] == 1e-3);
  CHECK(rates[1] == Approx(-2.0 * 0.1 * 2e3 * 1e-3).epsilon(1e-12));
}

TEST_CASE("normal_vibration: the contact opens and closes", "[friction][normal_vibration]") {
  // Undamped, lifted for 1.5 ms by 33 N, then thrown: y'^2 m/2 + weight (y + h0/3 (1 - y/h0)^3) stays, without the
  // last term while open.
  sim::LawHost host(Law(NormalVibration(jumping())), {});
  test::slide(host, 1.0, 1.5e-3);
  REQUIRE(host.memory().mode == 1);
  CHECK(host.force() == 0.0);
  const auto energy = [&] {
    const double y = host.memory().state[0];
    const double w = host.memory().state[1];
    const double spring = host.memory().mode == 1 ? 0.0 : 1e-4 / 3.0 * std::pow(1.0 - y / 1e-4, 3.0);
    return 0.05 * w * w + 20.0 * (y + spring);
  };
  const double thrown = energy();
  int landings = 0;
  for (int i = 0; i < 200; ++i) {
    const int before = host.memory().mode;
    test::slide(host, 0.0, 1e-4);
    CHECK(energy() == Approx(thrown).epsilon(1e-8));
    const double limit = host.law().static_limit(host.memory(), host.now());
    CHECK((limit > 0.0) == (host.memory().mode == 0));
    if (before == 1 && host.memory().mode == 0) ++landings;
  }
  CHECK(landings >= 3);
}

TEST_CASE("normal_vibration: it warns of a lift beyond the weight", "[friction][normal_vibration]") {
  CHECK(NormalVibration::warnings(named(rider)).empty());
  const std::vector<std::string> warnings = NormalVibration::warnings(named(jumping()));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("50 N, the weight is 20 N") != std::string::npos);
}
