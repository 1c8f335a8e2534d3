#pragma once
/// Formulas shared by smooth laws. They stay finite and smooth a little beyond the interval for which the direction
/// of slip is frozen.

#include <algorithm>
#include <cmath>

namespace dualdamp::friction {

/// base^exponent for base >= 0, exponent > 0. For base < 0: base^exponent if the exponent is whole, which is the
/// analytic continuation; else -|base|^exponent, which has as many continuous derivatives as the power.
[[nodiscard]] inline double continued_power(double base, double exponent) {
  if (exponent == 1.0) return base;
  if (exponent == 2.0) return base * base;
  const double modulus = std::pow(std::abs(base), exponent);
  const bool is_even = std::fmod(exponent, 2.0) == 0.0;
  return base < 0.0 && !is_even ? -modulus : modulus;
}

/// r/(1 + r) for r >= 0. Below zero the same formula, ended by its tangent at -1/2 before the pole at -1.
[[nodiscard]] inline double saturated(double r) { return r > -0.5 ? r / (1.0 + r) : 4.0 * r + 1.0; }

/// A force level to divide by. Modifiers may take the level to zero; the quotient must stay a number there.
[[nodiscard]] inline double divisor(double level, double nominal) { return std::max(level, 1e-9 * nominal); }

}  // namespace dualdamp::friction
