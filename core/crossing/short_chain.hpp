#pragma once
/// Divided differences of z -> exp(z s) over two exponents a, b and any number of zeros, for short times.
///
///     G_m(s) = [a, b, 0, ..., 0] exp(z s), m - 1 zeros,  = sum_k h_k s^(m+k)/(m+k)!,
///     h_0 = 1,  h_1 = p,  h_k = p h_(k-1) - q h_(k-2),   p = a + b,  q = a b.
///
/// The series gives the two highest G_m, and G_m = s^m/m! + p G_(m+1) - q G_(m+2) gives the others. The recursion
/// loses no digits while |a s| and |b s| are at most 1. If a and b are real or conjugate, all G_m are real: they
/// are the responses of an oscillator to powers of time. Cost: some ten products for each G_m, no exponential
/// function.

#include <array>
#include <complex>
#include <cstddef>

namespace dualdamp::core {

class ShortChain {
 public:
  /// G_1 to G_most.
  static constexpr std::size_t most = 5;

  ShortChain() = default;
  /// `count`: the number of G_m, 2 to most.
  ShortChain(double p, double q, std::size_t count) : p_(p), q_(q), count_(count) {}

  /// G_m(s) at index m - 1.
  [[nodiscard]] std::array<double, most> at(double s) const;
  /// exp(a s) from these G_m.
  [[nodiscard]] std::complex<double> exponential(std::complex<double> a, const std::array<double, most>& g) const {
    return 1.0 + a * g[0] - q_ * g[1];
  }

 private:
  double p_ = 0.0;
  double q_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace dualdamp::core
