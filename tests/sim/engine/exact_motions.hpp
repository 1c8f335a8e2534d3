#pragma once
/// Systems with Coulomb friction for the tests of the exact engine, their events, and the linear motion in 50
/// digits.

#include <complex>
#include <cstddef>
#include <vector>

#include "sim/engine/exact_engine.hpp"
#include "tests/support/base_driven.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/oracle.hpp"

namespace dualdamp::test {

struct EngineEvent {
  double t = 0.0;
  sim::EventKind kind = sim::EventKind::reversal;
  double x = 0.0;
};

/// Events until `duration`, at most `count` of them.
inline std::vector<EngineEvent> events_of(sim::ExactEngine& engine, double duration,
                                          std::size_t count = 1'000'000) {
  std::vector<EngineEvent> events;
  while (events.size() < count) {
    const sim::Interval* interval = engine.next(duration);
    if (interval == nullptr) break;
    if (interval->ending) events.push_back({interval->end(), *interval->ending, engine.position()});
  }
  return events;
}

inline std::vector<EngineEvent> events_of(const sim::Model& model, double duration, std::size_t count = 1'000'000) {
  sim::ExactEngine engine(model);
  return events_of(engine, duration, count);
}

inline sim::Model ramped(double m, double k, double c, sim::ExcitationType type, double slope) {
  sim::Model model;
  model.oscillator = {m, k, c, sim::DamperTo::ground};
  model.excitation = {.type = type, .slope = slope};
  return model;
}

/// The seed system of the paper: m = 1 kg, k = 100 N/m, c = 4 N.s/m, w = 10 rad/s, Y = 0.1 m, F = 2 N.
inline sim::Model standard(double kinetic = 2.0, double static_level = 2.0) {
  sim::Model model = base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = 10.0});
  model.friction.push_back(coulomb(kinetic, static_level));
  return model;
}

/// x and v of the linear oscillator in 50 digits.
inline oracle::State linear(const sim::Model& model, double t) {
  const sim::Oscillator& o = model.oscillator;
  oracle::LinearProblem problem{.mass = o.mass,
                                .damping = o.damping,
                                .stiffness = o.stiffness,
                                .x0 = model.initial.position,
                                .v0 = model.initial.velocity};
  const sim::Excitation& e = model.excitation;
  const double c = o.damper_to == sim::DamperTo::base ? o.damping : 0.0;
  const bool base = e.type == sim::ExcitationType::base_harmonic;
  const auto add = [&](int order, double amplitude, double phase) {
    const double w = order * e.frequency;
    const oracle::Complex gain = base ? oracle::Complex(o.stiffness, c * w) : oracle::Complex(1.0);
    problem.harmonics.push_back({w, gain * std::polar(amplitude, phase)});
  };
  if (e.is_harmonic()) {
    add(1, e.amplitude, e.phase);
    for (const sim::Harmonic& h : e.harmonics) add(h.order, h.amplitude, h.phase);
  }
  if (e.type == sim::ExcitationType::force_harmonic) problem.constant = e.offset;
  return oracle::solve(problem, t);
}

}  // namespace dualdamp::test
