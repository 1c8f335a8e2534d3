// A rig in C++: exact steady states at five input amplitudes, and what the line through them says of the rig.
#include <cmath>
#include <cstdio>

#include "friction_models/laws/coulomb.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "sim/orbits/steady_state.hpp"

using namespace dualdamp;

int main() {
  const double omega = std::sqrt(1568.0 / 1.042);
  sim::Model model;
  model.oscillator = {.mass = 1.042, .stiffness = 1568.0, .damping = 8.0};
  model.friction = {friction::Law(friction::Coulomb(4.4, 4.4))};

  identify::Record record;
  record.pairs.emplace();
  for (const double Y : {4.5e-3, 5.0e-3, 5.5e-3, 6.0e-3, 6.5e-3}) {
    model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = Y, .frequency = omega};
    const sim::SteadyState state = sim::steady_state(model);
    if (!state.outcome.ok()) return 1;
    record.pairs->pairs.push_back({.Y = Y, .x = state.amplitude, .sweep = {}});
  }
  const identify::Estimate estimate =
      identify::resonance_least_squares(record, {.mass = 1.042, .stiffness = 1568.0, .frequency = omega});
  std::printf("zeta = %.4f, F0 = %.3f N\n", estimate.value.zeta, estimate.value.F0);
  return estimate.outcome.ok() && std::abs(estimate.value.F0 - 4.4) < 0.05 ? 0 : 1;
}
