#include "friction_models/laws/rate_state.hpp"

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
using friction::Memory;
using friction::RateState;

namespace {

using Evolution = RateState::Evolution;

/// Granite at 10 N in the laboratory.
RateState::Contact granite(Evolution evolution = Evolution::aging) {
  return {.normal_force = 10.0,
          .mu0 = 0.6,
          .a = 0.01,
          .b = 0.015,
          .slip_distance = 1e-5,
          .reference_velocity = 1e-6,
          .evolution = evolution};
}

sim::LawCase rate_state(const RateState::Contact& contact) {
  sim::LawCase c =
      sim::law_case("rate_state", {{"normal_force", contact.normal_force},
                                   {"mu0", contact.mu0},
                                   {"a", contact.a},
                                   {"b", contact.b},
                                   {"slip_distance", contact.slip_distance},
                                   {"reference_velocity", contact.reference_velocity},
                                   {"evolution", contact.evolution == Evolution::slip ? "slip" : "aging"}});
  c.stroke = 30.0 * contact.slip_distance;
  c.stroke_time = 10.0 * contact.slip_distance / contact.reference_velocity;
  c.scaled = [=](double factor) {
    RateState::Contact scaled = contact;
    scaled.normal_force *= factor;
    return Law(RateState(scaled));
  };
  return c;
}

}  // namespace

TEST_CASE("rate_state conforms to the law contract", "[friction][rate_state]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(rate_state(granite(Evolution::aging))) == none);
  CHECK(sim::nonconformities(rate_state(granite(Evolution::slip))) == none);
  // exp(mu0/a) = exp(1200) is no double.
  RateState::Contact sharp = granite();
  sharp.a = 0.0005;
  CHECK(sim::nonconformities(rate_state(sharp)) == none);
}

TEST_CASE("rate_state: steady sliding", "[friction][rate_state]") {
  // F = N (mu0 + (a - b) ln(v/V0)); 60 slip distances leave exp(-60) of the start. asinh y - ln 2y = 1/(4 y^2),
  // exp(-120).
  for (const Evolution evolution : {Evolution::aging, Evolution::slip}) {
    for (const double ratio : {-1e3, 1e-2, 1.0, 30.0, 1e4}) {
      INFO(ratio);
      const double v = ratio * 1e-6;
      sim::LawHost host(Law(RateState(granite(evolution))), {});
      host.change_direction(v < 0.0 ? Direction::backward : Direction::forward);
      test::go_on(host, v, 60.0 * 1e-5 / std::abs(v));
      const double known = 10.0 * (0.6 - 0.005 * std::log(std::abs(ratio)));
      CHECK(host.force() == Approx(std::copysign(known, v)).epsilon(1e-9));
    }
  }
}

TEST_CASE("rate_state: a step of the speed", "[friction][rate_state]") {
  // From V0 to r V0: at once + a N ln r; then psi falls to -ln r over the slip distance, by closed forms in the
  // slip d: slip psi = -ln r (1 - exp(-d/Dc)), aging exp(psi) = 1/r + (1 - 1/r) exp(-d/Dc).
  for (const Evolution evolution : {Evolution::aging, Evolution::slip}) {
    for (const double r : {0.1, 10.0}) {
      INFO(r);
      sim::LawHost host(Law(RateState(granite(evolution))), {});
      host.change_direction(Direction::forward);
      test::go_on(host, 1e-6, 1.0);
      const double before = host.force();
      CHECK(before == Approx(6.0).epsilon(1e-12));
      for (const double d : {0.0, 0.5, 1.0, 3.0}) {
        const double s = std::exp(-d);
        const double psi =
            evolution == Evolution::slip ? -std::log(r) * (1.0 - s) : std::log(1.0 / r + (1.0 - 1.0 / r) * s);
        sim::LawHost stepped = host;
        test::go_on(stepped, r * 1e-6, d * 1e-5 / (r * 1e-6) + 1e-12);
        CHECK(stepped.force() - before ==
              Approx(10.0 * (0.01 * std::log(r) + 0.015 * psi)).epsilon(1e-7).margin(1e-9));
      }
    }
  }
}

TEST_CASE("rate_state: contacts age at rest", "[friction][rate_state]") {
  // exp(psi) = 1 + V0 t/Dc by aging; by slip nothing changes.
  for (const Evolution evolution : {Evolution::aging, Evolution::slip}) {
    sim::LawHost host(Law(RateState(granite(evolution))), {});
    test::go_on(host, 0.0, 1e3);
    CHECK(host.memory().state[0] == Approx(evolution == Evolution::aging ? std::log(101.0) : 0.0).epsilon(1e-9));
    CHECK(host.force() == 0.0);
  }
}

TEST_CASE("rate_state: the critical stiffness", "[friction][rate_state]") {
  // rice1983: steady sliding at V is stable above k = N (b - a)/Dc (1 + m V^2/(N a Dc)). By Hurwitz's criterion for
  // the motion x' = v, m v' = -k x - F, psi' linearised with derivatives of the law by central differences, good to
  // 1e-7.
  for (const Evolution evolution : {Evolution::aging, Evolution::slip}) {
    for (const double mass : {1e-3, 10.0, 1e5}) {
      const RateState::Contact c = granite(evolution);
      const Law law{RateState(c)};
      const double v = 2e-5;
      const double psi = -std::log(v / c.reference_velocity);
      const auto response = [&](double dv, double dpsi) {
        std::array<double, 2> values{};
        values[0] = law.respond({.state = {psi + dpsi}}, {.v = v + dv}, Direction::forward, {&values[1], 1});
        return values;
      };
      const auto slope = [&](double dv, double dpsi, double h) {
        const std::array<double, 2> up = response(dv, dpsi);
        const std::array<double, 2> down = response(-dv, -dpsi);
        return std::array<double, 2>{(up[0] - down[0]) / (2.0 * h), (up[1] - down[1]) / (2.0 * h)};
      };
      const auto [force_v, rate_v] = slope(1e-5 * v, 0.0, 1e-5 * v);
      const auto [force_psi, rate_psi] = slope(0.0, 1e-5, 1e-5);
      // s^3 + p s^2 + q s + r, stable while p q > r.
      const auto is_stable = [&](double stiffness) {
        const double p = force_v / mass - rate_psi;
        const double q = (stiffness - force_v * rate_psi + force_psi * rate_v) / mass;
        const double r = -stiffness * rate_psi / mass;
        return p * q > r;
      };
      const double critical = c.normal_force * (c.b - c.a) / c.slip_distance *
                              (1.0 + mass * v * v / (c.normal_force * c.a * c.slip_distance));
      INFO(mass << " kg: " << critical << " N/m");
      CHECK(is_stable(1.00001 * critical));
      CHECK_FALSE(is_stable(0.99999 * critical));
    }
  }
}

TEST_CASE("rate_state: it warns of values whose reversal is too sharp", "[friction][rate_state]") {
  const auto warnings = [](double a) { return RateState::warnings({{"mu0", 0.6}, {"a", a}}); };
  CHECK(warnings(0.016).empty());
  CHECK(warnings(0.0145).size() == 1);
  REQUIRE(warnings(0.01).size() == 1);
  CHECK(warnings(0.01)[0].find("exp(-60)") != std::string::npos);
  CHECK(warnings(0.01)[0].find("the number of its reversals is uncertain") != std::string::npos);
}
