#pragma once
/// After how many forcing periods a motion comes back: to where it was up to 64 periods ago.

#include <array>
#include <cstddef>
#include <limits>

#include "sim/engine/state.hpp"

namespace dualdamp::sim {

/// The longest period of a motion that is looked for, in forcing periods.
inline constexpr int longest_period = 64;

class Recurrence {
 public:
  explicit Recurrence(double omega) : omega_(omega) {}

  /// The state at the end of a forcing period; `size` [m] of the motion in it.
  void add(const State& state, double size);
  /// Distance of the last state and that `periods` ago, relative to the size of the motion; infinite before there
  /// is one.
  [[nodiscard]] double closure(int periods) const;
  /// The smallest number of periods, from 1 on, after which the motion closes to `limit`; 0: none.
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
