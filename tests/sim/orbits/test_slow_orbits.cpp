// Orbits that attract slowly: far above the natural frequency a forcing period changes the motion by little, so
// that the errors of a period add up to a distance from the orbit. Orbits within that distance are one.

#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/orbits/newton.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/make_law.hpp"

namespace {

using namespace dualdamp;

/// m = 1 kg, k = 100 N/m, c = 4 N.s/m on a base that moves by 0.1 m.
sim::Model far_above_resonance(double frequency, friction::Law law) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = frequency};
  model.friction.push_back(std::move(law));
  return model;
}

}  // namespace

TEST_CASE("orbits that differ by less than their errors are one steady state") {
  struct Case {
    double frequency;
    friction::Law law;
  };
  const std::vector<Case> cases = {
      {3e4, test::law("stribeck", {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.1}})},
      {3e4, test::law("dahl", {{"kinetic", 2.0}, {"sigma0", 1000.0}})},
      {1e5, test::law("dahl", {{"kinetic", 2.0}, {"sigma0", 1000.0}})},
      {3e4, test::law("bouc_wen", {{"limit", 2.0}, {"stiffness", 1000.0}, {"exponent", 1.0}})},
  };
  for (const Case& c : cases) {
    CAPTURE(c.frequency, c.law.name());
    const sim::SteadyState state = sim::steady_state(far_above_resonance(c.frequency, c.law));
    REQUIRE(state.outcome.ok());
    CHECK(state.period_ratio == 1);
    CHECK(state.others.empty());
    CHECK(state.peak == Approx(-state.trough).epsilon(2e-5));
    for (const std::string& warning : state.warnings) CHECK_THAT(warning, Catch::StartsWith("hardly attracts"));
  }
}

TEST_CASE("a Floquet multiplier that is below 1 by more than its rounding is not called one on the unit circle") {
  const sim::SteadyState near =
      sim::steady_state(far_above_resonance(1e5, friction::Law(friction::Coulomb(2.0, 3.0))));
  REQUIRE(near.outcome.ok());
  REQUIRE(near.warnings.size() == 1);
  CHECK_THAT(near.warnings.front(), Catch::StartsWith("hardly attracts"));
  const sim::SteadyState beyond =
      sim::steady_state(far_above_resonance(1e6, friction::Law(friction::Coulomb(2.0, 3.0))));
  CHECK(beyond.outcome.kind == core::OutcomeKind::no_steady_state);
  CHECK_THAT(beyond.outcome.reason, Catch::Contains("too slowly"));
}

TEST_CASE("the error of an orbit is its closure over what a period takes from a distance") {
  sim::ForcingPeriod period{.begin = {.x = 1.0}, .end = {.x = 1.0}, .size = 1.0};
  period.monodromy = Eigen::Vector2d(0.999, 0.5).asDiagonal();
  CHECK(sim::error_of_orbit(period, 1.0, 1e-9) == Approx(1e-6).epsilon(1e-5));
  period.monodromy = Eigen::Vector2d(1.0 - 1e-12, 0.5).asDiagonal();
  CHECK(sim::error_of_orbit(period, 1.0, 1e-9) == 1e-2);
}

TEST_CASE("the steady state of Coulomb friction does not depend on the phase of the drive") {
  // Undamped between two sticks, the distance of two motions turns by cos(w0 T) in a slide of duration T: here
  // nearly -1, a slow attraction. A period that begins in a slide has starts that lie on a curve.
  struct Case {
    double frequency;  // rad/s
    double amplitude;  // m
    double damping;    // N.s/m
    double peak;       // m, of a start in a stick
  };
  const std::vector<Case> cases = {{2.2624524864456745, 0.3726654141458458, 0.0, 0.3884033077},
                                   {2.2624524864456745, 0.3726654141458458, 2e-4, 0.3884020475},
                                   {1.3959785200511394, 1.0573534141608174, 0.0, 1.0434653301}};
  for (const Case& c : cases) {
    for (int degrees = 0; degrees < 360; degrees += 15) {
      CAPTURE(c.frequency, c.damping, degrees);
      sim::Model model;
      model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = c.damping};
      model.excitation = {.type = sim::ExcitationType::base_harmonic,
                          .amplitude = c.amplitude,
                          .frequency = c.frequency,
                          .phase = core::two_pi * degrees / 360.0};
      model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
      const sim::SteadyState state = sim::steady_state(model);
      REQUIRE(state.outcome.ok());
      CHECK(state.peak == Approx(c.peak).epsilon(2e-8));
      CHECK(state.transient_periods < 10);
    }
  }
}
