#include "core/crossing/guard.hpp"

#include <cmath>

namespace dualdamp::core {

void prepare(const ExponentialBasis& basis, Guard& guard) {
  differentiate(basis, guard.value, guard.slope);
  prepare_with_slope(basis, guard);
}

namespace {

/// Fills the bounds: sums of the moduli times powers of the rates.
template <class Modulus>
void measure(const ExponentialBasis& basis, Guard& guard, Modulus modulus_of) {
  guard.amplitude = guard.curvature_bound = guard.sixth_bound = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!takes_part(guard.value, i)) continue;
    const double modulus = modulus_of(guard.value.re[i], guard.value.im[i]);
    const double square = basis.relative_square(k);
    guard.amplitude += modulus;
    guard.curvature_bound += modulus * square;
    guard.sixth_bound += modulus * square * square * square;
  }
  guard.curvature_bound *= basis.fastest() * basis.fastest();
}

}  // namespace

void prepare_with_slope(const ExponentialBasis& basis, Guard& guard) {
  differentiate(basis, guard.slope, guard.curvature);
  measure(basis, guard, [](double re, double im) { return std::sqrt(re * re + im * im); });
  // Within this range no square overflows, and one that underflows is lost beside larger ones.
  if (!(guard.amplitude > 1e-140 && guard.amplitude < 1e140)) [[unlikely]]
    measure(basis, guard, modulus_bound);
  if (basis.even()) return;
  const double scale = basis.fastest() > 0.0 ? 1.0 / basis.fastest() : 1.0;
  ModeFunction other;
  assign(basis, scale * scale, guard.curvature, guard.sixth);
  for (int order = 3; order <= 6; ++order) {
    differentiate(basis, guard.sixth, other);
    assign(basis, scale, other, guard.sixth);
  }
}

}  // namespace dualdamp::core
