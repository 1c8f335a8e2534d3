#pragma once
/// Random draws for tests: the same with every standard library. The order of draws within one statement depends on
/// the compiler.

#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace dualdamp::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  /// Uniform in the logarithm, in [low, high); low > 0.
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  /// 0 to count - 1.
  int pick(int count) { return static_cast<int>(uniform(0.0, count)); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  double angle() { return uniform(-3.14159, 3.14159); }
  /// Of a modulus uniform in the logarithm, and any angle.
  std::complex<double> phasor(double low, double high) {
    const double modulus = logarithmic(low, high);
    return std::polar(modulus, angle());
  }

 private:
  std::mt19937_64 bits_;
};

/// Number of random cases: the variable `name` of the environment, otherwise `standard`.
inline long case_count(const char* name, long standard) {
  const char* text = std::getenv(name);
  return text == nullptr ? standard : std::strtol(text, nullptr, 10);
}

}  // namespace dualdamp::test
