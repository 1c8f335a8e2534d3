#pragma once
/// The velocity of the past, for laws that see it with a delay.
///
/// Kept as polynomials of degree four, one a step, through the ends and three points between; before the first step
/// the velocity is that of the start. Time is local: shift() moves the origin when a forcing period ends.

#include <array>
#include <deque>

namespace dualdamp::sim {

class VelocityHistory {
 public:
  static constexpr int points = 5;
  using Values = std::array<double, points>;  ///< at 0, 1/4, ..., 1 of the step [m/s]

  /// `reach` [s]: how far back anybody looks.
  void clear(double v, double reach);
  void add(double begin, double duration, const Values& values);
  void shift(double period);

  /// m/s; beyond the last step its polynomial goes on.
  [[nodiscard]] double at(double t) const;

 private:
  struct Step {
    double begin;
    double duration;
    Values values;
  };
  double first_ = 0.0;
  double reach_ = 0.0;
  std::deque<Step> steps_;
};

}  // namespace dualdamp::sim
