#include "friction_models/laws/dahl.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"

using namespace dualdamp;
using friction::Dahl;
using friction::Law;

namespace {

sim::LawCase dahl(double kinetic, double sigma0, double exponent) {
  sim::LawCase c = sim::law_case("dahl", {{"kinetic", kinetic}, {"sigma0", sigma0}, {"exponent", exponent}});
  c.stroke = 20.0 * kinetic / sigma0;
  c.scaled = [=](double factor) {
    // The distance kinetic/sigma0 over which friction builds up is the limit over a stiffness that stays.
    return Law(Dahl(factor * kinetic, sigma0, exponent));
  };
  return c;
}

}  // namespace

TEST_CASE("dahl conforms to the law contract", "[friction][dahl]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(dahl(2.0, 1e3, 1.0)) == none);
  CHECK(sim::nonconformities(dahl(2.0, 1e5, 1.5)) == none);
  CHECK(sim::nonconformities(dahl(2.0, 1e5, 2.0)) == none);
}

TEST_CASE("dahl: first loading in closed form", "[friction][dahl]") {
  // dF/dx = sigma0 (1 - F/Fc)^i: 1 - F/Fc = exp(-a) for i = 1, (1 + (i - 1) a)^(-1/(i - 1)) else, a = sigma0 x/Fc.
  // The host integrates with a tolerance of 1e-11 of Fc/sigma0 a step.
  for (const double exponent : {1.0, 1.5, 2.0, 3.0}) {
    sim::LawHost host(Law(Dahl(2.0, 1e4, exponent)), {.x = 0.3});
    for (const double a : {0.01, 0.5, 3.0, 20.0}) {
      INFO(exponent << " " << a);
      host.move_to(0.3 + a * 2e-4);
      const double room =
          exponent == 1.0 ? std::exp(-a) : std::pow(1.0 + (exponent - 1.0) * a, -1.0 / (exponent - 1.0));
      CHECK(std::abs(host.force() - 2.0 * (1.0 - room)) < 1e-9);
    }
  }
}

TEST_CASE("dahl: bristles far stiffer than the path is long take few steps", "[friction][dahl]") {
  // They relax within 1e-10 of the way: explicit steps would be billions.
  sim::LawHost host(Law(Dahl(1e-3, 1e7, 1.0)), {});
  for (const double x : {1.0, 0.0}) {
    host.move_to(x);
    CHECK(!host.broken());
    CHECK(host.force() == Approx(std::copysign(1e-3, x - 0.5)).epsilon(1e-9));
  }
  CHECK(host.steps() < 2000);
  sim::LawHost limited(Law(Dahl(1e-3, 1e7, 1.0)), {});
  limited.limit_steps(10);
  limited.move_to(1.0);
  CHECK(limited.broken());
  CHECK(limited.steps() < 200);
}

TEST_CASE("dahl: peak force and work of a loop", "[friction][dahl]") {
  // Fmax = Fc tanh a, W = 4 Fc A (1 - tanh(a)/a). Loops tend to it as exp(-2 a) each: 40 leave nothing for a >=
  // 0.5.
  const double kinetic = 2.0;
  for (const double sigma0 : {1e3, 1e4, 1e6}) {
    const double amplitude = 1e-3;
    const double a = sigma0 * amplitude / kinetic;
    INFO(a);
    sim::LawHost host(Law(Dahl(kinetic, sigma0, 1.0)), {});
    for (int i = 0; i < 40; ++i) host.move_to(i % 2 == 0 ? amplitude : -amplitude);
    const double before = host.work();
    const double heat_before = host.heat();
    host.move_to(amplitude);
    CHECK(host.force() == Approx(kinetic * std::tanh(a)).epsilon(1e-9));
    host.move_to(-amplitude);
    CHECK(host.force() == Approx(-kinetic * std::tanh(a)).epsilon(1e-9));
    const double work = 4.0 * kinetic * amplitude * (1.0 - std::tanh(a) / a);
    CHECK(host.work() - before == Approx(work).epsilon(1e-8));
    // In a closed loop nothing is left in the bristles.
    CHECK(host.heat() - heat_before == Approx(work).epsilon(1e-8));
  }
}

TEST_CASE("dahl: under a step of its limit downward the bristles let go to the new level", "[friction][dahl]") {
  const Law law(Dahl(2.0, 1e4, 1.0));
  sim::LawHost host(law, {});
  host.change_direction(friction::Direction::forward);
  const auto path = [](double factor) {
    return [=](double t) {
      return friction::Instant{.t = t, .x = 0.01 * t, .v = 0.01, .modification = {.factor = factor}};
    };
  };
  host.move_along(1.0, path(1.0));
  CHECK(host.force() == Approx(2.0).epsilon(1e-9));
  host.move_along(2.0, path(0.5));
  CHECK(host.force() == Approx(1.0).epsilon(1e-9));
}
