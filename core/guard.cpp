#include "core/guard.hpp"

#include <cmath>

namespace dualdamp::core {

void prepare(const ExponentialBasis& basis, Guard& guard) {
  differentiate(basis, guard.value, guard.slope);
  prepare_with_slope(basis, guard);
}

void prepare_with_slope(const ExponentialBasis& basis, Guard& guard) {
  differentiate(basis, guard.slope, guard.curvature);
  guard.amplitude = guard.curvature_bound = guard.sixth_bound = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (guard.value.re[i] == 0.0 && guard.value.im[i] == 0.0) continue;
    const double modulus = std::sqrt(guard.value.re[i] * guard.value.re[i] + guard.value.im[i] * guard.value.im[i]);
    const double square = basis.square(k);
    guard.amplitude += modulus;
    guard.curvature_bound += modulus * square;
    guard.sixth_bound += modulus * square * square * square;
  }
  if (basis.even()) return;
  ModeFunction third;
  ModeFunction fourth;
  differentiate(basis, guard.curvature, third);
  differentiate(basis, third, fourth);
  differentiate(basis, fourth, third);
  differentiate(basis, third, guard.sixth);
}

}  // namespace dualdamp::core
