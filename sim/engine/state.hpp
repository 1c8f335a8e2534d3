#pragma once
/// Everything on which the motion after an instant depends, apart from the phase of the excitation.

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
  /// The past velocity, if a law depends on it; else none.
  std::shared_ptr<const VelocityHistory> past{};
  /// A reversal here would change no force and no law's memory: the direction is not part of the mode.
  bool turns_freely = false;
};

/// Whether both are in the same mode, so that only continuous states differ. If both turn freely, slips in opposite
/// directions are in the same mode.
[[nodiscard]] bool same_mode(const State& a, const State& b);
/// Whether both are in the same mode, or are slips in opposite directions: then, too, only continuous states
/// differ, but the map has a kink between them.
[[nodiscard]] bool are_comparable(const State& a, const State& b);

}  // namespace dualdamp::sim
