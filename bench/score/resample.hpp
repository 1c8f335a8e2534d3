#pragma once
/// Resamples of a stress test: how often each departure, rig and case counts.
///
/// Departures are drawn with replacement within their family, rigs among all, and each case counts a Poisson number
/// of times with mean 1; the weight of a case is the product (the pigeonhole bootstrap of crossed factors,
/// owen2007pigeonhole). Resample 0 is the stress test itself: everything counts once. All methods share the
/// resamples, so that the standard errors of their differences can be computed.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/grid.hpp"

namespace dualdamp::bench {

inline constexpr std::size_t resamples = 200;

class Resample {
 public:
  Resample(const Grid& grid, std::size_t number);

  /// Weights of all cases, by number, without the weights of their departures.
  [[nodiscard]] std::vector<double> case_weights(const Grid& grid) const;
  /// Weight of a departure, in the order of the question; the truth counts once.
  [[nodiscard]] double departure_weight(std::size_t departure) const { return departures_[departure]; }

 private:
  [[nodiscard]] double times(std::size_t number) const;

  std::size_t number_;
  std::uint64_t seed_;
  std::vector<double> rigs_;
  std::vector<double> departures_;
};

}  // namespace dualdamp::bench
