#pragma once
/// The derivative of a step: the variational equation along its dense output, by Radau IIA with five stages.
///
///   u' = J u           u: a perturbation of the state, J = df/dx on the motion
///   d' = J d + df/dt   d: change of the end by a later start, without the shift in time; d = 0 at the start
///
/// It is the derivative of the motion, not of the method that computed it: a perturbation that decays within an
/// explicit step decays here too. In a step by Radau IIA the nodes are the stages of the step.
///
/// The variational equation may need shorter steps than the motion. J alone may change sharply within a step, as at
/// v = 0 under a level that falls within a small part of the speed. Such a step is halved until each entry of J at
/// a stage agrees with a cubic through the other stages. A perturbation may also turn many times in a step although
/// the motion does not: the exponential of J then takes it through (`fast_turns.hpp`). Where J changes too much for
/// that, the step is halved until the perturbation turns by no more than 1 rad in each part.
///
/// Errors: order 9 in the length of a part; J is as exact as the field gives it. Cost of a part: five Jacobians,
/// ten evaluations of the field, LU factors of five times as many rows as the state has components that change;
/// eigenvalues of J if components act on each other within the part.

#include <memory>
#include <span>

#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

/// The last step of a stepper.
struct TakenStep {
  const Stepper& stepper;
  double t = 0.0;                 ///< its start [s]
  double h = 0.0;                 ///< its length [s]
  double increment = 0.0;         ///< time over which df/dt is a difference [s]
  std::span<const double> sizes;  ///< of the state's components
};

class Variation {
 public:
  virtual ~Variation() = default;
  /// `columns`: perturbations at the start of the step, one after the other; replaced by those at its end. `late`:
  /// d at the end. False: a value is not finite.
  [[nodiscard]] virtual bool pass(const VectorField& field, const TakenStep& step, std::span<double> columns,
                                  std::span<double> late) = 0;
  /// Number of parts passed so far, each with one linearisation.
  [[nodiscard]] virtual long parts() const = 0;
  /// Operations of linear algebra so far.
  [[nodiscard]] virtual long operations() const = 0;
};

/// For states of `size` components.
[[nodiscard]] std::unique_ptr<Variation> make_variation(std::size_t size);

}  // namespace dualdamp::sim
