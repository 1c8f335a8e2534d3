#pragma once
/// Time histories: a motion from its initial state, with its events, samples and energy account.

#include <span>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "core/outcome.hpp"
#include "sim/engine/interval.hpp"
#include "sim/model.hpp"
#include "sim/motion/energy.hpp"

namespace dualdamp::sim {

struct Event {
  double t = 0.0;  ///< s
  EventKind kind = EventKind::reversal;
  double x = 0.0;  ///< m
  double v = 0.0;  ///< m/s
};

struct History {
  core::Outcome outcome;
  std::vector<Event> events;
  std::vector<Sample> samples;  ///< at 0, 1/sample_rate, ... or at given times
  Sample final;
  Energy energy;
  core::SearchCount certificate;  ///< of the searches for events
};

struct SimulateOptions {
  double duration = 0.0;     ///< s
  double sample_rate = 0.0;  ///< Hz; 0: no samples, or those at `times`
  /// Ascending times of the samples, >= 0 [s]; those after the end are ignored.
  std::span<const double> times = {};
  long max_events = 10'000'000;
};

[[nodiscard]] History simulate(const Model& model, const SimulateOptions& options);

/// An extreme of a free vibration: a turning point of x.
struct Extreme {
  double t = 0.0;  ///< s
  double x = 0.0;  ///< m, signed
};

struct FreeDecay {
  core::Outcome outcome;
  std::vector<Extreme> extremes;  ///< the initial position is the first if the mass is released from rest
  bool came_to_rest = false;      ///< fewer than requested because the mass sticks
  bool creeps = false;            ///< fewer because the motion has no turning point within 100 natural periods
  double accuracy = 0.0;          ///< error of the engine, relative to the motion
  long work = 0;                  ///< `Engine::work`
};

/// Successive extremes of the motion from `model.initial`; at most `count` of them. The excitation must be `none`.
[[nodiscard]] FreeDecay free_decay(const Model& model, int count);

}  // namespace dualdamp::sim
