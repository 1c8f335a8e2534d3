#include "friction_models/laws/viscous_power.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::ViscousPower;

namespace {

sim::LawCase viscous_power(double coefficient, double velocity, double exponent) {
  sim::LawCase c = sim::law_case(
      "viscous_power", {{"coefficient", coefficient}, {"reference_velocity", velocity}, {"exponent", exponent}});
  c.scaled = [=](double factor) { return Law(ViscousPower(factor * coefficient, velocity, exponent)); };
  return c;
}

}  // namespace

TEST_CASE("viscous_power conforms to the law contract", "[friction][viscous_power]") {
  const std::vector<std::string> none;
  for (const double exponent : {0.3, 1.0, 1.7, 2.0, 3.0}) {
    INFO(exponent);
    CHECK(sim::nonconformities(viscous_power(2.0, 0.1, exponent)) == none);
  }
}

TEST_CASE("viscous_power: dashpot, drag, cube, root", "[friction][viscous_power]") {
  const auto force = [](double exponent, double v) {
    return Law(ViscousPower(3.0, 0.5, exponent))
        .force({}, {.v = v}, v < 0.0 ? Direction::backward : Direction::forward);
  };
  for (const double side : {-1.0, 1.0}) {
    CHECK(force(1.0, side * 2.0) == side * 12.0);
    CHECK(force(2.0, side * 2.0) == side * 48.0);
    CHECK(force(3.0, side * 2.0) == Approx(side * 192.0).epsilon(1e-15));
    CHECK(force(0.5, side * 2.0) == Approx(side * 6.0).epsilon(1e-15));
  }
  CHECK(Law(ViscousPower(3.0, 1.0, 2.0)).force({}, {}, Direction::none) == 0.0);
}

TEST_CASE("viscous_power: work of a period of a harmonic motion", "[friction][viscous_power]") {
  // jacobsen1930: the integral of C (A w |cos|)^n |cos| A w over a period is C A^(n+1) w^n 2 sqrt(pi) G(n/2 +
  // 1)/G(n/2 + 3/2), for n = 1 the pi C w A^2 of a dashpot. The host keeps the work to 1e-11 a step of its method.
  const double amplitude = 0.2;
  const double omega = 3.0;
  for (const double n : {0.5, 1.0, 1.5, 2.0, 3.0}) {
    INFO(n);
    const double quarter = std::numbers::pi / (2.0 * omega);
    // From x = A on: half a period backward, half a period forward.
    const auto path = [=](double t) {
      return Instant{.t = t, .x = amplitude * std::cos(omega * t), .v = -amplitude * omega * std::sin(omega * t)};
    };
    sim::LawHost host(Law(ViscousPower(3.0, 1.0, n)), path(0.0));
    host.change_direction(Direction::backward);
    host.move_along(2.0 * quarter, path);
    host.change_direction(Direction::forward);
    host.move_along(4.0 * quarter, path);
    const double known = 3.0 * std::pow(amplitude, n + 1.0) * std::pow(omega, n) * 2.0 *
                         std::sqrt(std::numbers::pi) * std::tgamma(n / 2.0 + 1.0) / std::tgamma(n / 2.0 + 1.5);
    CHECK(host.work() == Approx(known).epsilon(1e-9));
  }
}
