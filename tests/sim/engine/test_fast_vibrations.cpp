// A vibration far faster than the drive: the answers name it, and its frequency does not drown in the units.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>

#include "friction_models/laws/attached_mass.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/engine/eigenvalues.hpp"
#include "sim/engine/engine.hpp"
#include "sim/orbits/steady_state.hpp"

using namespace dualdamp;

namespace {

/// A mass of 1 kg on 100 N/m under Coulomb friction, with an attached mass; the base moves at 8 rad/s.
sim::Model with_attached(double mass, double stiffness, double damping_ratio) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 8.0};
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  model.friction.emplace_back(
      friction::AttachedMass(mass, stiffness, 2.0 * damping_ratio * std::sqrt(stiffness * mass)));
  return model;
}

}  // namespace

TEST_CASE("eigenvalues keep their digits where entries differ by the units of time") {
  // x, v and z, w of two masses, 1 kg on 100 N/m with 1 N.s/m, and 1e-6 kg on 1e11 N/m: entries from 1 to 1e17.
  // The fast pair is i sqrt(k2/m2 + k2/m1) but for 1e-15. Unscaled, the solver finds no vibration near it.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(4, 4);
  const double k2 = 1e11;
  const double m2 = 1e-6;
  matrix(0, 1) = matrix(2, 3) = 1.0;
  matrix(1, 0) = -(100.0 + k2);
  matrix(1, 1) = -1.0;
  matrix(1, 2) = k2;
  matrix(3, 0) = k2 / m2;
  matrix(3, 2) = -k2 / m2;
  double fastest = 0.0;
  double decay = 0.0;
  for (const std::complex<double>& value : sim::eigenvalues_of(matrix)) {
    if (std::abs(value.imag()) <= fastest) continue;
    fastest = std::abs(value.imag());
    decay = std::abs(value.real());
  }
  CHECK(fastest == Approx(std::sqrt(k2 / m2 + k2)).epsilon(1e-13));
  CHECK(decay < 1e-13 * fastest);
}

TEST_CASE("a second vibration that is too fast is named, also where rounding of the positions is far above it") {
  const sim::SteadyState state = sim::steady_state(with_attached(1e-6, 1e11, 0.0));
  INFO(state.outcome.reason);
  CHECK(state.outcome.kind == core::OutcomeKind::event_limit);
  CHECK(state.outcome.reason.find("a second vibration at 3.16e+08 rad/s") != std::string::npos);
}

TEST_CASE("an engine names a vibration that costs most of its work, and no other") {
  const auto named = [](const sim::Model& model) {
    const std::unique_ptr<sim::Engine> engine = sim::make_engine(model);
    CHECK(engine->fast_vibration().empty());  // before the motion begins
    REQUIRE(engine->next_in_period() != nullptr);
    return engine->fast_vibration();
  };
  CHECK(named(with_attached(0.01, 1e8, 1e-3)).find("a second vibration at 1") == 0);
  CHECK(named(with_attached(0.01, 1e8, 0.02)).empty());
  CHECK(named(with_attached(0.01, 1e4, 1e-3)).empty());
  sim::Model alone = with_attached(0.01, 1e8, 1e-3);
  alone.friction.pop_back();
  CHECK(named(alone).empty());
}
