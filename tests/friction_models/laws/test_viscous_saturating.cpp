#include "friction_models/laws/viscous_saturating.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "sim/conformance/law_conformance.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Law;
using friction::ViscousSaturating;

namespace {

sim::LawCase viscous_saturating(double coefficient, double velocity) {
  sim::LawCase c =
      sim::law_case("viscous_saturating", {{"coefficient", coefficient}, {"saturation_velocity", velocity}});
  c.scaled = [=](double factor) { return Law(ViscousSaturating(factor * coefficient, velocity)); };
  return c;
}

}  // namespace

TEST_CASE("viscous_saturating conforms to the law contract", "[friction][viscous_saturating]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(viscous_saturating(4.0, 0.5)) == none);
  CHECK(sim::nonconformities(viscous_saturating(2000.0, 1e-3)) == none);
  CHECK(sim::nonconformities(viscous_saturating(0.0, 1.0)) == none);
}

TEST_CASE("viscous_saturating: dashpot at low speed, constant at high speed", "[friction][viscous_saturating]") {
  const Law law(ViscousSaturating(4.0, 0.5));
  const auto force = [&](double v) {
    return law.force({}, {.v = v}, v < 0.0 ? Direction::backward : Direction::forward);
  };
  CHECK(force(0.5) == 1.0);
  CHECK(force(-0.5) == -1.0);
  CHECK(force(1.5) == 1.5);
  // Off by |v|/v0 = 2e-9 and by v0/|v| = 5e-9, relative.
  CHECK(force(1e-9) == Approx(4e-9).epsilon(3e-9));
  CHECK(force(-1e8) == Approx(-2.0).epsilon(6e-9));
  CHECK_FALSE(law.holds_mass());
}

TEST_CASE("viscous_saturating: a step that overruns the reversal meets no pole", "[friction][viscous_saturating]") {
  // Frozen forward, -v0 would be one. The formula rises with v throughout.
  const Law law(ViscousSaturating(4.0, 0.5));
  double before = law.force({}, {.v = -2.0}, Direction::forward);
  for (double v = -1.99; v < 2.0; v += 0.01) {
    const double force = law.force({}, {.v = v}, Direction::forward);
    CHECK(force > before);
    before = force;
  }
}
