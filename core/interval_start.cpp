#include "core/interval_start.hpp"

#include <array>
#include <cmath>

namespace dualdamp::core {

namespace {

/// Whether a Taylor coefficient stands out of rounding.
bool stands_out(const ExponentialBasis& basis, const ModeFunction& f, double value, double tolerance) {
  double sum = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(basis.size()); ++k)
    sum += std::abs(f.re[k]) + std::abs(f.im[k]);
  return std::abs(value) > guard_rounding * sum + tolerance;
}

/// How fast a tolerance grows from one derivative to the next.
double rate(const ExponentialBasis& basis) { return basis.fastest() > 0.0 ? basis.fastest() : 1.0; }

}  // namespace

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
