#include "sim/orbits/structural_damping.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/diagnostics.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/curves/curves.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/orbits/transient.hpp"

using namespace dualdamp;
using Complex = std::complex<double>;

namespace {

constexpr double k = 100.0;
constexpr double eta = 0.13;
const std::vector<double> frequencies = {0.5, 4.0, 9.7, 10.0, 11.0, 40.0};

sim::Model driven(sim::ExcitationType type, double damping = 0.0) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = k, .damping = damping, .loss_factor = eta};
  model.excitation = {.type = type, .amplitude = 0.4, .frequency = 3.0};
  return model;
}

/// Lag in [0, 2 pi).
double lag(Complex response) {
  const double angle = -std::arg(response);
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

}  // namespace

TEST_CASE("structural damping: the receptance is 1/(k (1 + i eta) - m w^2)", "[structural]") {
  for (const double c : {0.0, 1.3}) {
    const sim::Curve curve =
        sim::frequency_response(driven(sim::ExcitationType::force_harmonic, c), frequencies, {}, {});
    for (const sim::CurvePoint& point : curve.points) {
      const double w = point.omega;
      const Complex closed = 0.4 / (k * Complex(1.0, eta) + Complex(0.0, c * w) - w * w);
      CHECK(point.x == Approx(std::abs(closed)).epsilon(1e-11));
      CHECK(point.phase == Approx(lag(closed)).epsilon(1e-10));
    }
  }
}

TEST_CASE("structural damping acts on the elongation: transmissibility", "[structural]") {
  const sim::Curve curve = sim::frequency_response(driven(sim::ExcitationType::base_harmonic), frequencies, {}, {});
  for (const sim::CurvePoint& point : curve.points) {
    const Complex spring = k * Complex(1.0, eta);
    const Complex closed = 0.4 * spring / (spring - point.omega * point.omega);
    CHECK(point.x == Approx(std::abs(closed)).epsilon(1e-11));
    CHECK(point.phase == Approx(lag(closed)).epsilon(1e-10));
  }
}

TEST_CASE("structural damping takes pi eta k A^2 from a period at every frequency", "[structural]") {
  sim::Model model = driven(sim::ExcitationType::force_harmonic);
  for (const double w : frequencies) {
    model.excitation.frequency = w;
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    const double loss = std::numbers::pi * eta * k * state.amplitude * state.amplitude;
    CHECK(state.energy.viscous == Approx(loss).epsilon(1e-10));
    CHECK(std::abs(state.energy.defect) < 1e-12);
    CHECK(sim::follow_transient(model).peak == Approx(state.peak).epsilon(1e-9));
  }
}

TEST_CASE("structural damping beside Coulomb friction is the equivalent viscous damper", "[structural]") {
  sim::Model model = driven(sim::ExcitationType::base_harmonic);
  model.friction = {friction::Law(friction::Coulomb(5.0, 6.0))};
  model.excitation.frequency = 9.0;
  sim::Model viscous = model;
  viscous.oscillator.loss_factor = 0.0;
  viscous.oscillator.damping = eta * k / 9.0;
  viscous.oscillator.damper_to = sim::DamperTo::base;
  CHECK(sim::steady_state(model).peak == Approx(sim::steady_state(viscous).peak).epsilon(1e-13));
}

TEST_CASE("structural damping has no motion in time, and no place beside a second damper", "[structural]") {
  const sim::Model model = driven(sim::ExcitationType::force_harmonic);
  CHECK_THROWS_WITH(sim::simulate(model, {.duration = 1.0}), Catch::Contains("not causal"));
  CHECK_THROWS_WITH(sim::steady_state(driven(sim::ExcitationType::base_harmonic, 2.0)),
                    Catch::Contains("between mass and base"));
  sim::Model distorted = model;
  distorted.excitation.harmonics = {{.order = 3, .amplitude = 0.1}};
  CHECK_THROWS_WITH(sim::steady_state(distorted), Catch::Contains("one frequency"));
  sim::Model negative = model;
  negative.oscillator.loss_factor = -0.1;
  CHECK_THROWS_AS(sim::steady_state(negative), core::InputError);
}
