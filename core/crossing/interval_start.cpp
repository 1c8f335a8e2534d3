#include "core/crossing/interval_start.hpp"

#include <array>
#include <cmath>

namespace dualdamp::core {

namespace {

/// Whether a Taylor coefficient is clear of rounding.
bool stands_out(const ExponentialBasis& basis, const ModeFunction& f, double value, double tolerance) {
  return std::abs(value) > guard_rounding * start_amplitude(basis, f) + tolerance;
}

/// Factor of the tolerance from one derivative to the next [1/s].
double rate(const ExponentialBasis& basis) { return basis.fastest() > 0.0 ? basis.fastest() : 1.0; }

}  // namespace

double start_amplitude(const ExponentialBasis& basis, const ModeFunction& f) {
  double sum = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    double part = std::abs(f.re[i]) + std::abs(f.im[i]);
    if (part == 0.0) continue;
    for (int above = basis.parent(k); above != ExponentialBasis::no_parent; above = basis.parent(above))
      part /= rate(basis);
    sum += part;
  }
  return sum;
}

Germ germ(const ExponentialBasis& basis, const Guard& guard, double tolerance, int from) {
  constexpr int examined = 4;
  ModeFunction third;
  const std::array<const ModeFunction*, examined> derivatives = {&guard.value, &guard.slope, &guard.curvature,
                                                                 &third};
  for (int order = 0; order < from; ++order) tolerance *= rate(basis);
  for (int order = from; order < examined; ++order) {
    const ModeFunction& f = *derivatives[static_cast<std::size_t>(order)];
    if (order == examined - 1) differentiate(basis, guard.curvature, third);
    const double value = at_start(basis, f);
    if (stands_out(basis, f, value, tolerance)) return {value > 0.0 ? 1 : -1, order};
    tolerance *= rate(basis);
  }
  return {0, examined};
}

Germ germ(const ExponentialBasis& basis, const ModeFunction& f, double tolerance) {
  Guard guard;
  guard.value = f;
  prepare(basis, guard);
  return germ(basis, guard, tolerance);
}

}  // namespace dualdamp::core
