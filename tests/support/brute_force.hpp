#pragma once
/// An oscillator with plain friction by Boost.Odeint: Runge-Kutta-Fehlberg 7(8) with fixed small steps, the mode
/// frozen between events, events by bisection within a step; steps are 64 times smaller where a guard might cross
/// its limit and return. It uses the numbers of the model and shares no code with the engines.

#include <vector>

#include "sim/engine/interval.hpp"
#include "sim/model.hpp"
#include "tests/support/plain_friction.hpp"

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

/// `model.friction` is ignored; `friction` replaces it, in its initial state. Steps of a 400th of the shortest
/// period have an error of 1e-16 each.
[[nodiscard]] BruteForce follow(const sim::Model& model, const PlainFriction& friction, double duration);

}  // namespace dualdamp::test
