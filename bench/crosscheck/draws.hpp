#pragma once
/// The random numbers of one case: a stream of its own, so that any case can be drawn again alone.

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/random.hpp"

namespace dualdamp::crosscheck {

class Draws {
 public:
  Draws(std::uint64_t seed, std::uint32_t index) : stream_{seed, index} {}

  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * stream_.uniform(next_++); }
  /// Uniform in the logarithm, in [low, high); low > 0.
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  /// 0 to count - 1.
  int pick(int count) { return static_cast<int>(uniform(0.0, count)); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  double angle() { return uniform(0.0, 2.0 * std::numbers::pi); }

 private:
  core::RandomStream stream_;
  std::uint64_t next_ = 0;
};

}  // namespace dualdamp::crosscheck
