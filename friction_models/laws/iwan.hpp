#pragma once
/// Iwan's parallel-series model: elements in parallel, each a spring of stiffness k_i in series with a slider that
/// slides at f_i.
///
///   F = sum over stuck elements of k_i (x - a_i) + s sum over sliding elements of f_i     [N]
///
/// s is the direction of motion, a_i where slider i stands. While the mass moves on one way the elements slide one
/// after the other in the order of their slip distances d_i = f_i/k_i; when it turns all stick, with a_i = x_r - s
/// d_i after sliding in direction s up to x_r. So the places of all sliders are known from the turning points that
/// are still remembered, each for the elements from one slip distance to another: a stack of segments, the most
/// recent turn on top with the smallest distances. This is Masing's rule and return-point memory at work: moving in
/// direction s from a turn after sliding to the other side an element slides again at a distance of 2 d_i, and when
/// the mass comes back to an earlier turning point on its own side the loop closes and the whole segment slides at
/// once.
///
/// The springs start unstretched. Source: iwan1966, masing1926 in `docs/refs.bib`. Exact engine. Cost: an event for
/// each element and stroke; an event costs no more with more elements, only with more loops open at the time.

#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class Iwan {
 public:
  struct Element {
    double stiffness = 0.0;  ///< k_i > 0 [N/m]
    double limit = 0.0;      ///< f_i > 0 [N]
  };

  static const std::vector<Parameter>& parameters();
  /// From `elements`, or else `stiffness`, `limit`, `count`.
  [[nodiscard]] static std::vector<Element> elements(const ParameterValues& values);
  /// Slip distances spread evenly from 0 to 2 limit/stiffness: k_i = stiffness/n, f_i = 2 limit (i + 1/2)/n^2.
  [[nodiscard]] static std::vector<Element> uniform(double stiffness, double limit, int count);

  /// At least one element, in any order.
  explicit Iwan(std::vector<Element> elements);

  [[nodiscard]] Memory start(const Instant& now) const;
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction) const;
  void affine_guards(const Memory& memory, const Instant& now, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const;

 private:
  [[nodiscard]] int count() const { return static_cast<int>(slip_distance_.size()); }

  // Elements in the order of their slip distances, those of equal distance merged.
  std::vector<double> slip_distance_;    ///< d_i [m]
  std::vector<double> stiffness_below_;  ///< sum of k_j, j < i [N/m]
  std::vector<double> limit_below_;      ///< sum of f_j, j < i [N]
};

}  // namespace dualdamp::friction
