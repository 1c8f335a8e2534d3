#pragma once
/// The response to a white acceleration, by brute force.

#include <cmath>

#include "tests/identify/histories.hpp"

namespace dualdamp::identify::testing {

/// x and v of the paper's bearing under white acceleration of intensity D [m^2/s^3]; eight Euler steps a sample,
/// the friction of each limited to what stops the mass.
inline History random_response(double c, double F0, double D, double duration, std::uint64_t seed) {
  constexpr int steps = 8;
  constexpr double rate = 500.0;
  constexpr double dt = 1.0 / (rate * steps);
  const double mass = bearing_constants.mass;
  const double stiffness = bearing_constants.stiffness;
  const double kick = std::sqrt(D * dt);
  const double brake = F0 / mass * dt;
  Normal normal(seed);
  History history;
  history.sample_rate = rate;
  double x = 0.0;
  double v = 0.0;
  const auto samples = static_cast<std::size_t>(duration * rate);
  for (std::size_t i = 0; i < samples; ++i) {
    history.x.push_back(x);
    history.v.push_back(v);
    for (int step = 0; step < steps; ++step) {
      v += dt * (-stiffness * x - c * v) / mass + kick * normal();
      v -= std::abs(v) > brake ? std::copysign(brake, v) : v;
      x += dt * v;
    }
  }
  return history;
}

}  // namespace dualdamp::identify::testing
