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

}  // namespace dualdamp::sim
