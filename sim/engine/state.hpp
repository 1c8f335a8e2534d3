#pragma once
/// All that the motion after an instant depends on, apart from the phase of the excitation.

#include <memory>
#include <vector>

#include "friction_models/law.hpp"

namespace dualdamp::sim {

class VelocityHistory;

struct State {
  double x = 0.0;  ///< m
  double v = 0.0;  ///< m/s
  friction::Direction direction = friction::Direction::none;
  std::vector<friction::Memory> memories{};  ///< of each law
  /// The velocity before, where a law sees it; else none.
  std::shared_ptr<const VelocityHistory> past{};
  /// A reversal here would change no force and nothing that a law remembers: the direction is no part of the mode.
  bool turns_freely = false;
};

/// Both lie in the same mode, so that their difference is one of continuous states. Where both turn freely that
/// holds for slips in both directions.
[[nodiscard]] bool same_mode(const State& a, const State& b);
/// The same, or slips in both directions: their difference is one of continuous states too, but of a map with a
/// kink.
[[nodiscard]] bool are_comparable(const State& a, const State& b);

}  // namespace dualdamp::sim
