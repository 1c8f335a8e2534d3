#pragma once
/// A step of the smooth engine with its dense output, as those see it that judge steps.

#include <span>

#include "sim/engine/flow.hpp"
#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

/// Operations of linear algebra in a unit of work (Engine::work).
inline constexpr long operations_in_unit = 4000;

/// Valid until the next step. An interval that ends where it begins has a step of length 0, without dense output.
struct SmoothStep {
  const Flow& flow;  ///< frozen for the interval
  const Stepper& stepper;
  std::span<const double> begin;
  std::span<const double> end;
  double t = 0.0;        ///< local time of its start [s]
  double length = 0.0;   ///< s
  double longest = 0.0;  ///< the longest step there [s]

  /// Local time at a part of it [s].
  [[nodiscard]] double time(double part) const { return t + part * length; }
};

}  // namespace dualdamp::sim
