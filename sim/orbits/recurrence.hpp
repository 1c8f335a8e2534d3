#pragma once
/// The number of forcing periods after which a motion comes back, up to 64.

#include <array>
#include <cstddef>

#include "sim/engine/state.hpp"

namespace dualdamp::sim {

/// The longest period of a motion that is recognised, in forcing periods.
inline constexpr int longest_period = 64;

class Recurrence {
 public:
  explicit Recurrence(double omega) : omega_(omega) {}

  /// Takes the state at the end of a forcing period; `size`: of the motion in it [m].
  void add(const State& state, double size);
  /// Distance between the last state and the state `periods` ago, relative to the size of the motion; infinite if
  /// there is no such state yet.
  [[nodiscard]] double closure(int periods) const;
  /// The smallest number of periods, at least 1, after which the motion closes to `limit`; 0: none.
  [[nodiscard]] int shortest(double limit) const;

 private:
  static constexpr std::size_t kept = longest_period + 1;

  double omega_;
  double size_ = 0.0;  ///< of the last `longest_period` periods at least [m]
  std::array<double, kept> sizes_{};
  std::array<State, kept> states_{};
  long count_ = 0;
};

}  // namespace dualdamp::sim
