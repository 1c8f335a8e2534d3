#pragma once
/// Histories for the tests of identification: samples of simulated motions, as a laboratory would record them.

#include <cmath>

#include "friction_models/laws/coulomb.hpp"
#include "identify/record.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/identify/records.hpp"

namespace dualdamp::identify::testing {

/// The paper's bearing on its soft spring, driven by its base near resonance.
inline sim::Model driven_bearing(double c, double F0, double Y, double omega = 38.79) {
  sim::Model model;
  model.oscillator = {1.042, 1568.0, c, sim::DamperTo::ground};
  model.friction.emplace_back(friction::Coulomb(F0, F0));
  model.excitation.type = sim::ExcitationType::base_harmonic;
  model.excitation.frequency = omega;
  model.excitation.amplitude = Y;
  model.excitation.phase = 0.3;
  model.initial = {3e-3, 0.0};
  return model;
}

inline const KnownConstants bearing_constants{1.042, 1568.0};

/// All signals at `rate` [Hz] from `start` [s] on.
inline History sampled(const sim::Model& model, double duration, double rate, double start = 0.0) {
  sim::SimulateOptions options;
  options.duration = start + duration;
  options.sample_rate = rate;
  const bool forced = !model.excitation.moves_base() && model.excitation.type != sim::ExcitationType::none;
  History history;
  history.start = start;
  history.sample_rate = rate;
  for (const sim::Sample& sample : sim::simulate(model, options).samples) {
    if (sample.t < start) continue;
    history.y.push_back(sample.y);
    history.x.push_back(sample.x);
    history.v.push_back(sample.v);
    history.a.push_back(sample.a);
    if (forced) history.force.push_back(sample.external);
  }
  return history;
}

/// What a laboratory has: base motion and displacement, the latter with noise [m].
inline History displacement_only(History history, double noise, Normal& normal) {
  history.v.clear();
  history.a.clear();
  for (double& x : history.x) x += noise * normal();
  return history;
}

inline Record record_of(std::vector<History> histories) {
  Record record;
  record.histories = std::move(histories);
  return record;
}

/// Nearest multiple of a sensor's resolution.
inline double quantised(double value, double resolution) { return resolution * std::round(value / resolution); }

}  // namespace dualdamp::identify::testing
