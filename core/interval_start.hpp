#pragma once
/// How a function on an exponential basis begins: its sign just after the start of an interval, from its Taylor
/// coefficients. An interval often starts where a guard is zero, and rounding must not decide its sign there.

#include "core/guard.hpp"

namespace dualdamp::core {

/// The sign of a function just after s = 0 and the order of its zero there; a Taylor coefficient within 16 eps
/// times its own amplitudes' sum plus `tolerance` times the basis' rate counts as zero.
struct Germ {
  int sign = 0;   ///< 0: zero to the order examined
  int zeros = 0;  ///< number of leading Taylor coefficients that vanish
};

[[nodiscard]] Germ germ(const ExponentialBasis& basis, const ModeFunction& f, double tolerance);
/// Of a prepared guard whose first `from` Taylor coefficients are known to vanish.
[[nodiscard]] Germ germ(const ExponentialBasis& basis, const Guard& guard, double tolerance, int from = 0);

}  // namespace dualdamp::core
