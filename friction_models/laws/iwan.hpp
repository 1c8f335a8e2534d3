#pragma once
/// Iwan's parallel-series model: elements in parallel, each a spring of stiffness k_i in series with a slider that
/// slides at f_i.
///
///   F = sum over stuck elements of k_i (x - a_i) + s sum over sliding elements of f_i     [N]
///
/// s is the direction of slip, a_i the position of slider i. While the mass moves in one direction the elements
/// start to slide one after the other, in the order of their slip distances d_i = f_i/k_i. When the mass reverses
/// at x_r, all elements stick; those that slid in direction s then have a_i = x_r - s d_i. So the positions of all
/// sliders follow from the reversal points that are still remembered. They are kept as a stack of segments: a
/// segment is a range of elements that stuck at the same reversal, and the latest reversal, with the smallest slip
/// distances, is on top.
///
/// This gives Masing's rule and return-point memory. After a reversal an element that slid before slides again, in
/// the other direction, at a distance of 2 d_i. When the mass returns to an earlier reversal point of the same
/// direction, the loop closes and all elements of that segment slide together.
///
/// The springs start unstretched. Source: iwan1966, masing1926 in `docs/refs.bib`. Exact engine. Cost: one event
/// for each element and stroke; the cost of an event grows with the number of open loops, not with that of
/// elements.

#include <span>
#include <string_view>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class Iwan {
 public:
  static constexpr bool remembers_path = true;
  struct Element {
    double stiffness = 0.0;  ///< k_i > 0 [N/m]
    double limit = 0.0;      ///< f_i > 0 [N]
  };

  static const std::vector<Parameter>& parameters();
  /// From the values of `elements`, or of `stiffness`, `limit` and `count`.
  [[nodiscard]] static std::vector<Element> elements(const ParameterValues& values);
  /// Slip distances spread evenly from 0 to 2 limit/stiffness: k_i = stiffness/n, f_i = 2 limit (i + 1/2)/n^2.
  [[nodiscard]] static std::vector<Element> uniform(double stiffness, double limit, int count);

  /// The modifiers that elements in parallel take.
  [[nodiscard]] static std::vector<std::string_view> modifiers() { return {"drift", "fluctuation"}; }
  /// The elements as one law. With modifiers among `values` each element is a law of its own, since varying limits
  /// change the order in which the elements slide.
  [[nodiscard]] static std::vector<Law> laws(std::vector<Element> elements, const ParameterValues& values);

  /// At least one element, in any order.
  explicit Iwan(std::vector<Element> elements);

  [[nodiscard]] Memory start(const Instant& now) const;
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction) const;
  void affine_guards(const Memory& memory, const Instant& now, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const;
  void rates(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const;
  /// The smallest slip distance, for every state.
  void scales(const Memory& memory, std::span<double> scales) const;

 private:
  [[nodiscard]] int count() const { return static_cast<int>(slip_distance_.size()); }

  // Elements in the order of their slip distances, those of equal distance merged.
  std::vector<double> slip_distance_;    ///< d_i [m]
  std::vector<double> stiffness_below_;  ///< sum of k_j, j < i [N/m]
  std::vector<double> limit_below_;      ///< sum of f_j, j < i [N]
};

}  // namespace dualdamp::friction
