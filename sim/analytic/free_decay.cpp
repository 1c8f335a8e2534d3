#include "sim/analytic/free_decay.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace dualdamp::sim::analytic {

namespace {

/// -ln R
double decrement(double zeta) {
  assert(zeta >= 0.0 && zeta < 1.0);
  return std::numbers::pi * zeta / std::sqrt((1.0 - zeta) * (1.0 + zeta));
}

}  // namespace

double half_swing_decay(double zeta) { return std::exp(-decrement(zeta)); }

double decrement_amplitude(double zeta, double x_f, double X_0, int n) {
  assert(n >= 0);
  const double L = decrement(zeta);
  // 1 + R + ... + R^(n-1); the quotient of two differences from 1 keeps its digits for small zeta.
  const double swings = L == 0.0 ? n : std::expm1(-n * L) / std::expm1(-L);
  return X_0 * std::exp(-n * L) - x_f * (1.0 + std::exp(-L)) * swings;
}

std::vector<double> free_decay_extremes(double zeta, double x_f, double x_0, int count) {
  std::vector<double> extremes;
  double magnitude = std::abs(x_0);
  double side = std::copysign(1.0, x_0);
  for (int n = 0; n < count; ++n) {
    extremes.push_back(side * magnitude);
    if (!(magnitude > x_f)) break;
    magnitude = decrement_amplitude(zeta, x_f, std::abs(x_0), n + 1);
    side = -side;
  }
  return extremes;
}

}  // namespace dualdamp::sim::analytic
