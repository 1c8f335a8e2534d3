#pragma once
/// An oscillator with Coulomb friction by Boost.Odeint: Runge-Kutta-Fehlberg 7(8) with fixed small steps, the sign
/// of the friction frozen between events, events by bisection within a step; 64 times smaller steps where the
/// velocity or the pull might cross its limit and return. It reads the model's numbers and shares no code with the
/// engines.

#include <vector>

#include "sim/interval.hpp"
#include "sim/model.hpp"

namespace dualdamp::test {

struct BruteEvent {
  double t = 0.0;
  sim::EventKind kind = sim::EventKind::reversal;
  double x = 0.0;
};

struct BruteForce {
  std::vector<BruteEvent> events;
  double x = 0.0;
  double v = 0.0;
};

/// `model.friction` is ignored: the levels are given. Steps of a 400th of the shortest period err by 1e-16 each.
[[nodiscard]] BruteForce follow_coulomb(const sim::Model& model, double kinetic, double static_level,
                                        double duration);

}  // namespace dualdamp::test
