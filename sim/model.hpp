#pragma once
/// A model is everything that determines a motion: oscillator, excitation, friction laws in parallel, initial
/// state.

#include <string>
#include <string_view>
#include <vector>

#include "core/coordinate.hpp"
#include "friction_models/law.hpp"
#include "sim/excitation.hpp"
#include "sim/oscillator.hpp"

namespace dualdamp::sim {

/// The state at t = 0. The laws start unloaded, unless their memories are stated: one for each law, as left by a
/// motion that was in this direction (`law_host/loaded_contacts.hpp`).
struct InitialState {
  double position = 0.0;  ///< m
  double velocity = 0.0;  ///< m/s
  double travel = 0.0;    ///< path that has loaded the memories [m]
  std::vector<friction::Memory> memories{};
  friction::Direction direction = friction::Direction::none;
};

/// How the equation of motion is integrated.
enum class SolverKind {
  automatic,  ///< the exact engine if every law is affine; else explicit steps, implicit ones once the motion is
              ///< stiff
  explicit_steps,
  implicit_steps,
};

struct Solver {
  SolverKind kind = SolverKind::automatic;
  /// Local error of the smooth engine's steps, relative to the size of the motion.
  double tolerance = 1e-11;
};

struct Model {
  Oscillator oscillator;
  Excitation excitation;
  std::vector<friction::Law> friction;  ///< forces add
  InitialState initial;
  Solver solver{};

  /// The unit of a quantity in messages: `unit` is the one for a displacement.
  [[nodiscard]] std::string unit(std::string_view unit) const {
    return core::unit_for(oscillator.coordinate, unit);
  }
};

}  // namespace dualdamp::sim
