#pragma once
/// One step of x' = f(x, t): what the smooth engine needs from a one-step method, and the two methods it has.
///
/// explicit  Dormand and Prince's method of order 8, DOP853, dense output of order 7 (stages by Boost.Odeint;
///           hairer1993, II.10);
/// implicit  Radau IIA with five stages: order 9, L-stable, stage order 5; for laws with a fast internal state
///           (hairer1996, IV.8).
///
/// A stepper chooses nothing: step sizes, restarts and events are the engine's. Its result is a function of the
/// arguments of `step` alone, smooth in x: earlier steps only make it quicker. (The implicit method solves its
/// equations to a thousandth of `allowed`, or to round-off where that is more.)

#include <cstddef>
#include <memory>
#include <span>

namespace dualdamp::sim {

/// The right side of x' = f(x, t), analytic on the whole step (branches frozen).
class VectorField {
 public:
  virtual ~VectorField() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  virtual void evaluate(std::span<const double> x, double t, std::span<double> rates) const = 0;
  /// df_i/dx_j, column by column. The solution does not depend on it, the speed of the implicit method does.
  virtual void jacobian(std::span<const double> x, double t, std::span<double> columns) const = 0;
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// One step of `h` [s] from x at t. `end`: the state at t + h; `error`: an estimate of its local error, with
  /// sign. `allowed` (> 0): the local error allowed in each component. The spans must not overlap. False: a value
  /// is not finite or the iteration does not converge; a shorter step is needed. Allocates at the first step and
  /// where the size of the field changes.
  [[nodiscard]] virtual bool step(const VectorField& field, std::span<const double> x, double t, double h,
                                  std::span<const double> allowed, std::span<double> end,
                                  std::span<double> error) = 0;

  /// The state at t + part h of the last step that returned true, 0 <= part <= 1; its x and `end`, bit for bit, at
  /// the ends.
  virtual void at(double part, std::span<double> x) const = 0;

  /// The error estimate falls as h^(order() + 1).
  [[nodiscard]] virtual int order() const = 0;

  /// h |lambda| of the fastest motion in the last step that returned true; an explicit method is limited by its
  /// stability instead of its accuracy where this stays above 6 (DOP853; Hairer's test). 0: no such limit.
  [[nodiscard]] virtual double stiffness() const = 0;
};

[[nodiscard]] std::unique_ptr<Stepper> make_explicit_stepper();
[[nodiscard]] std::unique_ptr<Stepper> make_implicit_stepper();

}  // namespace dualdamp::sim
