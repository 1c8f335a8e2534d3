#include "friction_models/laws/attached_mass.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/laws/coulomb.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::AttachedMass;
using friction::Coulomb;
using friction::Law;

TEST_CASE("attached_mass conforms to the law contract", "[friction][attached_mass]") {
  const std::vector<std::string> none;
  for (const double damping : {0.0, 0.5})
    CHECK(sim::nonconformities(
              sim::law_case("attached_mass", {{"mass", 0.3}, {"stiffness", 40.0}, {"damping", damping}})) == none);
}

TEST_CASE("attached_mass: steady vibrations of two linear masses, below, between and above both modes",
          "[attached_mass]") {
  // (k + k2 + i w (c + c2) - m w^2) x - (k2 + i w c2) z = k Y and (k2 + i w c2) (z - x) = m2 w^2 z, by Cramer's
  // rule.
  using Complex = std::complex<double>;
  const double m2 = 0.2;
  const double k2 = 80.0;
  const double c2 = 0.7;
  for (const double w : {3.0, 8.6, 9.3, 15.0, 24.0}) {
    CAPTURE(w);
    sim::Model model = test::standard_system(Law(AttachedMass(m2, k2, c2)));
    model.excitation.frequency = w;
    const Complex link(k2, w * c2);
    const Complex a11 = Complex(100.0, 4.0 * w) - 1.0 * w * w + link;
    const Complex a22 = link - m2 * w * w;
    const Complex x = 10.0 * a22 / (a11 * a22 - link * link);
    const Complex z = x * link / a22;
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.stable());
    CHECK(state.amplitude == Approx(std::abs(x)).epsilon(1e-10));
    CHECK(std::remainder(state.phase + std::arg(x), 2.0 * std::numbers::pi) == Approx(0.0).margin(1e-10));
    // Heat of the damper in a period: pi c2 w |x - z|^2. Below both modes x and z are nearly the same.
    CHECK(state.energy.friction ==
          Approx(std::numbers::pi * c2 * w * std::norm(x - z)).epsilon(1e-9).margin(1e-10));
  }
}

TEST_CASE("attached_mass: a free vibration is a sum of both modes", "[attached_mass]") {
  // det(K - w^2 M) = 0 for K = [k + k2, -k2; -k2, k2], M = diag(m, m2). A mode has z = r x, r = k2/(k2 - m2 w^2).
  // The attached mass starts beside the mass with its velocity: x and z are both x0, and both v0.
  const double k = 100.0;
  const double m2 = 0.25;
  const double k2 = 60.0;
  const double sum = (k + k2) / 1.0 + k2 / m2;
  const double root = std::sqrt(sum * sum / 4.0 - k * k2 / m2);
  const double slow = std::sqrt(sum / 2.0 - root);
  const double fast = std::sqrt(sum / 2.0 + root);
  const double r_slow = k2 / (k2 - m2 * slow * slow);
  const double r_fast = k2 / (k2 - m2 * fast * fast);
  const double share = (1.0 - r_fast) / (r_slow - r_fast);  // of the slow mode
  const double x0 = 0.1;
  const double v0 = -0.6;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = k};
  model.friction = {Law(AttachedMass(m2, k2, 0.0))};
  model.initial = {.position = x0, .velocity = v0};
  const sim::History history = sim::simulate(model, {.duration = 6.0, .sample_rate = 50.0});
  REQUIRE(history.outcome.ok());
  REQUIRE(history.samples.size() == 301);
  for (const sim::Sample& sample : history.samples) {
    const double a = slow * sample.t;
    const double b = fast * sample.t;
    const double position = share * (x0 * std::cos(a) + v0 / slow * std::sin(a)) +
                            (1.0 - share) * (x0 * std::cos(b) + v0 / fast * std::sin(b));
    CHECK(sample.x == Approx(position).margin(1e-9));
  }
  CHECK(std::abs(history.energy.defect) < 1e-10);
}

TEST_CASE("attached_mass: on a stiff spring it is part of the mass, also where the mass sticks",
          "[attached_mass]") {
  // The attached mass is x w^2 m2/k2 off, 2e-5 of x; and so is the amplitude.
  for (const double level : {2.0, 7.0}) {
    sim::Model apart = test::standard_system(Law(Coulomb(level, level)));
    const sim::SteadyState whole = sim::steady_state(apart);
    apart.oscillator.mass = 0.8;
    apart.friction.emplace_back(AttachedMass(0.2, 1e6, 20.0));
    const sim::SteadyState parts = sim::steady_state(apart);
    REQUIRE(parts.outcome.ok());
    CHECK(parts.amplitude == Approx(whole.amplitude).epsilon(1e-3));
    CHECK(parts.amplitude != whole.amplitude);
    CHECK(parts.sticks.empty() == whole.sticks.empty());
  }
}

TEST_CASE("attached_mass: a light one that nothing damps is given up with its own frequency and the mass that does",
          "[attached_mass]") {
  // sqrt(1e3/1e-9) = 1e6 rad/s swings 100,000 times in a forcing period of 2 pi/10 s; 1,000 can be followed.
  const sim::Model model = test::standard_system(Law(AttachedMass(1e-9, 1e3, 0.0)));
  const sim::SteadyState state = sim::steady_state(model);
  CHECK(state.outcome.kind == core::OutcomeKind::event_limit);
  INFO(state.outcome.reason);
  CHECK(state.outcome.reason.find("a second vibration at 1e+06 rad/s") != std::string::npos);
  CHECK(state.outcome.reason.find("its mass 1e+04 times as heavy") != std::string::npos);
  CHECK(sim::steady_state(test::standard_system(Law(AttachedMass(1e-5, 1e3, 0.0)))).outcome.ok());
}
