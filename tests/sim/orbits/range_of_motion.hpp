#pragma once
/// The extremes of a motion that is integrated for many periods: what a steady state has to agree with.

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "sim/motion/simulate.hpp"

namespace dualdamp::sim::testing {

inline double forcing_period(const Model& model) { return 2.0 * std::numbers::pi / model.excitation.frequency; }

struct Range {
  double peak = 0.0;
  double trough = 0.0;
};

/// Extremes over `periods` forcing periods after `settle` of them.
inline Range after(const Model& model, int settle, int periods) {
  const double period = forcing_period(model);
  const History history = simulate(model, {.duration = (settle + periods) * period});
  REQUIRE(history.outcome.ok());
  Range range{-1e300, 1e300};
  for (const Event& event : history.events) {
    if (event.t < settle * period) continue;
    range.peak = std::max(range.peak, event.x);
    range.trough = std::min(range.trough, event.x);
  }
  return range;
}

}  // namespace dualdamp::sim::testing
