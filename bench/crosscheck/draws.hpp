#pragma once
/// The random numbers of one case. They are a stream of their own, so that any case can be drawn again alone, or
/// the bytes of an input, through which a fuzzer controls the draws.

#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/constants.hpp"
#include "core/random.hpp"

namespace dualdamp::crosscheck {

class Draws {
 public:
  Draws(std::uint64_t seed, std::uint32_t index) : stream_{seed, index} {}
  /// Two bytes make a number; after their end all numbers are 0.
  explicit Draws(std::string_view bytes) : bytes_(bytes), is_led_(true) {}

  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * share(); }
  /// Uniform in the logarithm, in [low, high); low > 0.
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  /// 0 to count - 1.
  int pick(int count) { return static_cast<int>(uniform(0.0, count)); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  double angle() { return uniform(0.0, core::two_pi); }

 private:
  /// In [0, 1).
  double share() {
    const std::uint64_t number = next_++;
    if (!is_led_) return stream_.uniform(number);
    const auto byte = [&](std::uint64_t at) {
      return at < bytes_.size() ? static_cast<double>(static_cast<unsigned char>(bytes_[at])) : 0.0;
    };
    return (byte(2 * number) + byte(2 * number + 1) / 256.0) / 256.0;
  }

  core::RandomStream stream_;
  std::string_view bytes_;
  bool is_led_ = false;
  std::uint64_t next_ = 0;
};

}  // namespace dualdamp::crosscheck
