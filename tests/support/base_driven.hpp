#pragma once
/// Oscillators on a base that moves as a cosine.

#include <utility>

#include "friction_models/laws/coulomb.hpp"
#include "sim/model.hpp"

namespace dualdamp::test {

/// m x'' + c x' + k x + friction = k Y cos(w t + phase)
struct BaseDriven {
  double m = 1.0;  ///< kg
  double k = 1.0;  ///< N/m
  double c = 0.0;  ///< N.s/m
  double Y = 1.0;  ///< m
  double w = 1.0;  ///< rad/s
  double phase = 0.0;
};

/// Without friction.
inline sim::Model base_driven(const BaseDriven& numbers) {
  sim::Model model;
  model.oscillator = {.mass = numbers.m, .stiffness = numbers.k, .damping = numbers.c};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = numbers.Y,
                      .frequency = numbers.w,
                      .phase = numbers.phase};
  return model;
}

inline sim::Model base_driven(const BaseDriven& numbers, friction::Law law) {
  sim::Model model = base_driven(numbers);
  model.friction.push_back(std::move(law));
  return model;
}

inline friction::Law coulomb(double kinetic, double static_level) {
  return friction::Law(friction::Coulomb(kinetic, static_level));
}
inline friction::Law coulomb(double level) { return coulomb(level, level); }

}  // namespace dualdamp::test
