#pragma once
/// The derivative of a step: the variational equation along its dense output, by Radau IIA with five stages.
///
///   u' = J u           u: a perturbation of the state, J = df/dx on the motion
///   d' = J d + df/dt   d: what a later begin changes beside the shift in time, d = 0 at the begin
///
/// It is the derivative of the motion, not of the method that computed it: a perturbation that decays within an
/// explicit step decays here too. The nodes of a step by Radau IIA are its own stages.
///
/// A step that the motion takes lightly may hide a place where J alone changes sharply, as at v = 0 under a level
/// that falls within a small part of the speed: such a step is passed in parts, halved until a cubic through the
/// other stages tells J in each of them. So is one in which a perturbation turns by more than 1 rad, where the
/// motion does not turn with it.
///
/// Errors: order 9 in the part; J is as exact as the field gives it. Cost of a part: five Jacobians, ten
/// evaluations of the field, LU factors of five times as many rows as the state has; eigenvalues of J where
/// components act on each other within the part.

#include <memory>
#include <span>

#include "sim/engine/stepper.hpp"

namespace dualdamp::sim {

/// A step that a stepper has taken last.
struct TakenStep {
  const Stepper& stepper;
  double t = 0.0;                 ///< its begin [s]
  double h = 0.0;                 ///< its length [s]
  double increment = 0.0;         ///< over which df/dt is a difference [s]
  std::span<const double> sizes;  ///< of the state's components
};

class Variation {
 public:
  virtual ~Variation() = default;
  /// `columns`: perturbations at the begin of the step, one after the other; become those at its end. `late`: d at
  /// its end. False: a value is not finite.
  [[nodiscard]] virtual bool pass(const VectorField& field, const TakenStep& step, std::span<double> columns,
                                  std::span<double> late) = 0;
  /// So many times the equation has been linearised so far.
  [[nodiscard]] virtual long parts() const = 0;
};

/// For states of `size` components.
[[nodiscard]] std::unique_ptr<Variation> make_variation(std::size_t size);

}  // namespace dualdamp::sim
