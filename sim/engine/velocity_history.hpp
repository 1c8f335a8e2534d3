#pragma once
/// The past velocity, for laws that depend on it with a delay.
///
/// It is stored as one polynomial of degree four for each step, through both ends and three points between. Before
/// the first step the velocity is that of the start. Time is local: shift() moves the origin at the end of a
/// forcing period.

#include <array>
#include <deque>

namespace dualdamp::sim {

class VelocityHistory {
 public:
  static constexpr int points = 5;
  using Values = std::array<double, points>;  ///< at 0, 1/4, ..., 1 of the step [m/s]

  /// Starts with the velocity v [m/s]. `reach` [s]: the longest delay.
  void clear(double v, double reach);
  void add(double begin, double duration, const Values& values);
  /// Counts time anew from `period` [s] later: a new frame of time.
  void shift(double period);
  [[nodiscard]] long frame() const { return frame_; }

  /// The velocity [m/s] at t, counted in `frame`: the present frame or the one before. After the last step its
  /// polynomial is extrapolated.
  [[nodiscard]] double at(double t, long frame) const;

 private:
  struct Step {
    double begin;
    double duration;
    Values values;
  };
  double first_ = 0.0;
  double reach_ = 0.0;
  long frame_ = 0;
  double last_shift_ = 0.0;
  std::deque<Step> steps_;
};

}  // namespace dualdamp::sim
