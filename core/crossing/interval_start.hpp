#pragma once
/// How a function on an exponential basis begins: its sign just after the start of an interval, from its Taylor
/// coefficients. An interval often starts where a guard is zero, and rounding must not decide its sign there.

#include "core/crossing/guard.hpp"

namespace dualdamp::core {

/// What the coefficients of f are worth at the start: the sum of their moduli, each element of a chain by what it
/// grows to within 1/fastest(), for at s = 0 it is zero. A coefficient of s^n, of a drive in short pieces say, may
/// be larger than f by any factor.
[[nodiscard]] double start_amplitude(const ExponentialBasis& basis, const ModeFunction& f);

/// The sign of a function just after s = 0 and the order of its zero there; a Taylor coefficient within 16 eps
/// times its own start amplitude plus `tolerance` times the basis' rate counts as zero.
struct Germ {
  int sign = 0;   ///< 0: zero to the order examined
  int zeros = 0;  ///< number of leading Taylor coefficients that vanish
};

[[nodiscard]] Germ germ(const ExponentialBasis& basis, const ModeFunction& f, double tolerance);
/// Of a prepared guard whose first `from` Taylor coefficients are known to vanish.
[[nodiscard]] Germ germ(const ExponentialBasis& basis, const Guard& guard, double tolerance, int from = 0);

}  // namespace dualdamp::core
