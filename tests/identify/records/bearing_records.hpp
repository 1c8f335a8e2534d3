#pragma once
/// Histories of the paper's bearing with the soft spring: driven, and released.

#include <catch2/catch.hpp>
#include <cmath>

#include "friction_models/laws/coulomb.hpp"
#include "identify/record.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/identify/methods/histories/bearing.hpp"

namespace dualdamp::identify::testing {

constexpr double soft_zeta = 0.12;
constexpr double soft_x_f = bearing_F0 / stiffness;

inline sim::Model soft_bearing() {
  sim::Model model;
  model.oscillator = {mass, stiffness, 2.0 * soft_zeta * std::sqrt(mass * stiffness), sim::DamperTo::ground};
  model.friction.emplace_back(friction::Coulomb(bearing_F0, bearing_F0));
  return model;
}

inline History sampled_displacements(const sim::Model& model, double duration, double rate) {
  const sim::History motion = sim::simulate(model, {.duration = duration, .sample_rate = rate});
  REQUIRE(motion.outcome.ok());
  History history;
  history.sample_rate = rate;
  for (const sim::Sample& sample : motion.samples) {
    history.y.push_back(sample.y);
    history.x.push_back(sample.x);
  }
  return history;
}

inline History driven_bearing_at(double Y, double omega, double duration = 12.0) {
  sim::Model model = soft_bearing();
  model.excitation.type = sim::ExcitationType::base_harmonic;
  model.excitation.frequency = omega;
  model.excitation.amplitude = Y;
  model.excitation.phase = 0.3;
  return sampled_displacements(model, duration, 1000.0);
}

inline History released(double X, double duration, double rate) {
  sim::Model model = soft_bearing();
  model.initial = {X, 0.0};
  History history = sampled_displacements(model, duration, rate);
  history.y.clear();
  return history;
}

}  // namespace dualdamp::identify::testing
