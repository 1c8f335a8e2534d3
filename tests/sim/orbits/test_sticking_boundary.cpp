// The sticking boundary of the engine against Den Hartog's closed form, which shares no code with it.

#include "sim/orbits/sticking_boundary.hpp"

#include <catch2/catch.hpp>

#include "friction_models/laws/coulomb.hpp"

using namespace dualdamp;

namespace {

sim::Model model(double zeta, double kinetic, double holding) {
  sim::Model result;
  result.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 2.0 * zeta};
  result.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 1.0};
  result.friction.emplace_back(friction::Coulomb(kinetic, holding));
  return result;
}

}  // namespace

TEST_CASE("the engine's sticking boundary is Den Hartog's, from low frequencies to beyond resonance") {
  const std::vector<double> frequencies = {0.07, 0.11, 0.19, 0.31, 0.45, 0.62, 0.85, 1.0, 1.4, 2.3};
  for (const double zeta : {0.05, 0.2}) {
    for (const sim::BoundaryPoint& point : sim::sticking_boundary(model(zeta, 1.0, 1.0), frequencies)) {
      CAPTURE(zeta, point.omega, point.outcome.reason);
      REQUIRE(point.outcome.ok());
      REQUIRE(point.closed_form.has_value());
      CHECK(point.amplitude == Approx(*point.closed_form).epsilon(2e-11));
    }
  }
}

TEST_CASE("without damping the boundary at r = 3 is x_f/Y = 9/16 exactly") {
  const sim::BoundaryPoint point = sim::sticking_boundary(model(0.0, 1.0, 1.0), std::vector{3.0})[0];
  REQUIRE(point.outcome.ok());
  CHECK(1.0 / point.amplitude == Approx(9.0 / 16.0).epsilon(2e-11));
}

TEST_CASE("static friction above kinetic raises the boundary, and no closed form is claimed") {
  const std::vector<double> frequency = {0.6};
  const sim::BoundaryPoint equal = sim::sticking_boundary(model(0.05, 1.0, 1.0), frequency)[0];
  const sim::BoundaryPoint above = sim::sticking_boundary(model(0.05, 1.0, 1.5), frequency)[0];
  REQUIRE(above.outcome.ok());
  CHECK(above.amplitude > 1.01 * equal.amplitude);
  CHECK_FALSE(above.closed_form.has_value());
}
