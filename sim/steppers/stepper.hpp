#pragma once
/// One step of x' = f(x, t): the interface of a one-step method for the smooth engine, and its two methods.
///
/// explicit  Dormand and Prince's method of order 8, DOP853, dense output of order 7 (stages by Boost.Odeint;
///           hairer1993, II.10);
/// implicit  Radau IIA with five stages: order 9, L-stable, stage order 5; for laws with a fast internal state
///           (hairer1996, IV.8).
///
/// The engine decides step sizes, restarts and events. The result of a stepper depends only on the arguments of
/// `step`, and smoothly on x; earlier steps only save time. (The implicit method solves its equations to a
/// thousandth of `allowed`, or to round-off if that is larger. Where other starts of
/// its iterations failed as well the last times, a step whose prediction fails is given up at once, until it is
/// tried again from the same time.)

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>

namespace dualdamp::sim {

/// The right-hand side of x' = f(x, t), analytic on the whole step because the branch is frozen.
class VectorField {
 public:
  virtual ~VectorField() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  virtual void evaluate(std::span<const double> x, double t, std::span<double> rates) const = 0;
  /// df_i/dx_j, column by column. It affects the speed of the implicit method, not the solution.
  virtual void jacobian(std::span<const double> x, double t, std::span<double> columns) const = 0;
  /// Both at once: differences start from the rates.
  virtual void linearize(std::span<const double> x, double t, std::span<double> rates,
                         std::span<double> columns) const {
    evaluate(x, t, rates);
    jacobian(x, t, columns);
  }
  /// The Jacobian as closely as the field is known: what a perturbation of the motion follows.
  virtual void close_jacobian(std::span<const double> x, double t, std::span<double> columns) const {
    jacobian(x, t, columns);
  }
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// One step of `h` [s] from x at t. `end`: the state at t + h; `error`: an estimate of its local error, with
  /// sign. `allowed` (> 0): the allowed local error of each component. The spans must not overlap. False: a value
  /// is not finite or the iteration does not converge; a shorter step is needed. Allocates at the first step and
  /// when the size of the field changes.
  [[nodiscard]] virtual bool step(const VectorField& field, std::span<const double> x, double t, double h,
                                  std::span<const double> allowed, std::span<double> end,
                                  std::span<double> error) = 0;

  /// The state at t + part h of the last step that returned true, 0 <= part <= 1. At the ends it is x and `end`,
  /// bit for bit.
  virtual void at(double part, std::span<double> x) const = 0;

  /// The rates at the end of the last step that returned true, as its polynomial has them. False: the method keeps
  /// none. Where the field is steep, the field of a state that is known to `allowed` alone says nothing of the
  /// motion's rates; the polynomial does.
  [[nodiscard]] virtual bool end_rates(std::span<double> /*rates*/) const { return false; }

  /// The error estimate falls as h^(order() + 1).
  [[nodiscard]] virtual int order() const = 0;

  /// h |lambda| of the fastest motion in the last step that returned true. If it stays above 6, stability limits
  /// the steps of DOP853 instead of accuracy (Hairer's test). 0: the method has no such limit.
  [[nodiscard]] virtual double stiffness() const = 0;

  /// Operations of linear algebra so far; evaluations of the field are not among them.
  [[nodiscard]] virtual long operations() const { return 0; }
};

/// Counts steps by their `stiffness`. Many explicit steps beyond 1 make a stiff problem: that is far below 6, the
/// boundary of stability, but under friction that turns over sharply explicit steps are short long before they meet
/// it. An implicit step costs about as much as an explicit one.
class StiffSteps {
 public:
  void add(double stiffness) {
    constexpr double stiff = 1.0;
    count_ = stiffness > stiff ? count_ + 1 : std::max(0, count_ - 1);
  }
  [[nodiscard]] bool are_many() const {
    constexpr int many = 15;
    return count_ > many;
  }

 private:
  int count_ = 0;
};

[[nodiscard]] std::unique_ptr<Stepper> make_explicit_stepper();
[[nodiscard]] std::unique_ptr<Stepper> make_implicit_stepper();

}  // namespace dualdamp::sim
