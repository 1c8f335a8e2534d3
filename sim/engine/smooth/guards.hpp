#pragma once
/// The guards of one interval of the smooth engine, as functions of the state and of time. The interval ends where
/// one of them goes negative:
///
///   end of a slip     s v                           s: sign of the direction
///   end of a stick    limit - pull, limit + pull    if a law can hold the mass (sticking_gate.hpp)
///   mode of a law     its own guards
///
/// Direction and modes are those for which the flow is frozen, for every state.
///
/// Creep. Where friction is a dashpot so steep that it balances all other forces at a speed within the tolerance of
/// steps, or beyond zero within the rounding of the interval's largest speed, that speed is known to its sign at
/// best. The forces are known: the speed has the sign of the acceleration a0 with which they would drive the mass
/// off from v = 0, as it was one relaxation of the dashpot ago. So the end of such a slip is where a0 changes its
/// sign; a0/omega stands for the speed. Explicit steps resolve the relaxation instead, as far as they follow a
/// creep at all.

#include <span>
#include <vector>

#include "sim/engine/ending.hpp"
#include "sim/engine/flow.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

class Guards {
 public:
  /// Sums of forces within this part of their parts' sizes are equal.
  static constexpr double equal = 1e-12;
  /// The rate of a guard is a difference over this part of a step.
  static constexpr double part_of_rate = 1e-5;

  /// Both must outlive it.
  Guards(const Model& model, const Flow& flow);

  /// Lists the guards of the interval that begins at X and t [s], for which the flow is frozen.
  void list(std::span<const double> X, double t);
  [[nodiscard]] std::size_t size() const { return endings_.size(); }
  [[nodiscard]] const Ending& ending(std::size_t guard) const { return endings_[guard]; }

  /// Whether some law may have guards in some mode.
  [[nodiscard]] bool may_be_of_laws() const { return some_memory_; }

  /// Values of all guards, in the order of the list.
  void evaluate(std::span<const double> X, double t, std::vector<double>& values) const;
  /// One of them.
  [[nodiscard]] double value(std::size_t guard, std::span<const double> X, double t) const;
  /// The rate of a guard along the motion, by a central difference along the flow over a small part of `length`
  /// [s].
  [[nodiscard]] double rate(std::size_t guard, std::span<const double> X, double t, double length) const;

  /// Whether steps pass over the relaxation of a creep, as implicit ones do.
  void pass_over_relaxation(bool pass) { passes_over_ = pass; }
  /// A speed against the direction by up to `speed` [m/s] has not changed its sign.
  void resolve_speeds_to(double speed) { resolved_ = speed; }
  /// Whether the mass creeps: see above.
  [[nodiscard]] bool creeps(std::span<const double> X, double t) const;
  /// Whether it does so and has a speed against its direction, which is an error of steps then. It is less than
  /// they may err by, but on that side of zero the dashpot acts the other way, and steps would not come back.
  [[nodiscard]] bool creeps_backward(std::span<const double> X, double t) const;
  /// Whether it would do so under steps that pass over the relaxation.
  [[nodiscard]] bool would_creep(std::span<const double> X, double t) const;
  /// What stands for the speed of a mass that creeps at X, a0/omega, in the direction of the slip [m/s].
  [[nodiscard]] double forced_speed(std::span<const double> X, double t) const;

 private:
  [[nodiscard]] double acceleration_at(double speed, std::span<const double> X, double t) const;
  [[nodiscard]] double speed_in_direction(std::span<const double> X, double t) const;
  [[nodiscard]] double relaxation(std::span<const double> X, double t) const;

  const Model& model_;
  const Flow& flow_;
  std::vector<char> has_memory_;  ///< of each law
  bool some_memory_ = false;
  bool can_stick_ = false;  ///< some law has a static limit
  bool passes_over_ = false;
  double resolved_ = 0.0;  ///< m/s
  double omega_ = 0.0;     ///< natural frequency [rad/s]
  std::vector<Ending> endings_;
  // Scratch.
  mutable std::vector<double> displaced_;
  mutable std::vector<double> rates_;
  mutable std::vector<double> values_;
  mutable std::vector<double> slowed_;
  mutable std::vector<double> slowed_rates_;
};

}  // namespace dualdamp::sim
