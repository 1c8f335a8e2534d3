// The event-driven engine and the closed forms are independent of each other, and must agree.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/analytic/den_hartog.hpp"
#include "sim/analytic/free_decay.hpp"
#include "sim/curves/curves.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/base_driven.hpp"

using namespace dualdamp;
using namespace dualdamp::sim;

namespace {

/// wn = 1, lengths in metres, F0 = x_f.
Model unit_system(double zeta, double r, double x_f) {
  return test::base_driven({.c = 2.0 * zeta, .w = r}, test::coulomb(x_f));
}

}  // namespace

TEST_CASE("Den Hartog's steady state is the engine's, amplitude, phase and sticking alike") {
  // Both are exact up to rounding. The engine's orbit closes to 1e-14 of its size, and the error of a closed orbit
  // is that over the distance of its Floquet multipliers from 1, here 1 - exp(-2 pi zeta/r) > 0.03.
  std::mt19937 random(101);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int sliding = 0;
  int sticking = 0;
  for (int i = 0; i < 150; ++i) {
    const double zeta = 0.01 + 0.39 * uniform(random);
    const double r = 0.3 + 1.7 * uniform(random);
    const analytic::DenHartog d = analytic::den_hartog(zeta, r);
    const double boundary = analytic::non_sticking_boundary(d);
    const double x_f = boundary * (0.4 + 0.9 * uniform(random));
    if (std::abs(x_f / boundary - 1.0) < 1e-3) continue;
    CAPTURE(zeta, r, x_f, boundary);
    const SteadyState engine = steady_state(unit_system(zeta, r, x_f));
    REQUIRE(engine.outcome.ok());
    const auto exact = analytic::non_sticking_state(d, 1.0, x_f);
    CHECK(exact.has_value() == (x_f < boundary));
    CHECK(exact.has_value() == (engine.stops_per_cycle == 0));
    if (!exact) {
      ++sticking;
      continue;
    }
    ++sliding;
    CHECK(engine.amplitude == Approx(exact->amplitude).epsilon(1e-12));
    CHECK(std::abs(std::remainder(engine.phase - exact->phase, 2.0 * std::numbers::pi)) < 1e-11);
  }
  CHECK(sliding > 60);
  CHECK(sticking > 20);
}

TEST_CASE("The engine's free decay is the decrement law, to the last extreme") {
  for (const double zeta : {0.0, 0.03, 0.0819, 0.4}) {
    for (const double x_f : {0.0, 0.012, 0.3}) {
      Model model = unit_system(zeta, 1.0, x_f);
      model.excitation = {};
      model.initial.position = -1.0;
      const FreeDecay decay = free_decay(model, 12);
      REQUIRE(decay.outcome.ok());
      const auto expected = analytic::free_decay_extremes(zeta, x_f, -1.0, 12);
      CAPTURE(zeta, x_f);
      REQUIRE(decay.extremes.size() == expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(decay.extremes[i].x == Approx(expected[i]).margin(1e-14));
        const double half_swing = std::numbers::pi / std::sqrt(1.0 - zeta * zeta);
        CHECK(decay.extremes[i].t == Approx(static_cast<double>(i) * half_swing).margin(1e-12));
      }
    }
  }
}
