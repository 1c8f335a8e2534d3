#pragma once
/// The sign of a function on an exponential basis just after the start of an interval, from its Taylor
/// coefficients. An interval often starts where a guard is zero, and rounding must not decide the guard's sign.

#include "core/crossing/guard.hpp"

namespace dualdamp::core {

/// The size of f at the start: the sum of the moduli of its coefficients. An element of a chain is zero at s = 0,
/// so its coefficient counts times the value that the element reaches within 1/fastest(). Without that factor a
/// coefficient of s^n (of a drive in short pieces, for example) may be larger than f by any factor.
[[nodiscard]] double start_amplitude(const ExponentialBasis& basis, const ModeFunction& f);

/// The sign of a function just after s = 0 and the order of its zero there. The n-th derivative counts as zero if
/// it is within 16 eps times its own start amplitude plus `tolerance` times the n-th power of the basis' rate.
struct Germ {
  int sign = 0;   ///< 0: all examined coefficients vanish
  int zeros = 0;  ///< number of leading Taylor coefficients that vanish
};

[[nodiscard]] Germ germ(const ExponentialBasis& basis, const ModeFunction& f, double tolerance);
/// The germ of a prepared guard whose first `from` Taylor coefficients are known to vanish.
[[nodiscard]] Germ germ(const ExponentialBasis& basis, const Guard& guard, double tolerance, int from = 0);

}  // namespace dualdamp::core
