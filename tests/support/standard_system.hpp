#pragma once
/// The standard system with a law, and its settled motion.

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "sim/motion/simulate.hpp"

namespace dualdamp::test {

inline constexpr double standard_stiffness = 100.0;  ///< N/m

/// m = 1 kg, k = 100 N/m, c = 4 N.s/m on a base that moves by 0.1 m at 10 rad/s.
inline sim::Model standard_system(const friction::Law& law) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = standard_stiffness, .damping = 4.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  model.friction = {law};
  return model;
}

struct SettledMotion {
  double peak = 0.0;           ///< m
  double trough = 0.0;         ///< m
  double friction_work = 0.0;  ///< J per period
};

/// Integrates until the transient has decayed to rounding: exp(-2 t) after 60 periods is exp(-75). The mass must
/// not stick on the orbit.
inline SettledMotion settled_motion(const friction::Law& law) {
  const double period = std::numbers::pi / 5.0;
  const sim::Model model = standard_system(law);
  const sim::History before = sim::simulate(model, {.duration = 60.0 * period});
  const sim::History after = sim::simulate(model, {.duration = 61.0 * period});
  REQUIRE(after.outcome.ok());
  SettledMotion motion;
  motion.friction_work = after.energy.friction - before.energy.friction;
  for (const sim::Event& event : after.events) {
    if (event.t < 60.0 * period || event.kind != sim::EventKind::reversal) continue;
    motion.peak = std::max(motion.peak, event.x);
    motion.trough = std::min(motion.trough, event.x);
  }
  return motion;
}

}  // namespace dualdamp::test
