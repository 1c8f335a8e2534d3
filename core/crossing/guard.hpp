#pragma once
/// A guard: a function g(s) on an exponential basis that is positive while the mode holds. The interval ends where
/// a guard becomes negative.

#include <limits>

#include "core/crossing/exponential_basis.hpp"

namespace dualdamp::core {

struct Guard {
  ModeFunction value;
  int known_zeros = 0;  ///< order of the zero at s = 0, up to 3

  // Filled by prepare().
  ModeFunction slope;
  ModeFunction curvature;
  ModeFunction sixth;            ///< d^6 g/d(fastest() s)^6; unused on an even basis
  double amplitude = 0.0;        ///< sum of |c_k|
  double curvature_bound = 0.0;  ///< of |g''| for all s; on an even basis only
  double sixth_bound = 0.0;      ///< of |sixth|, likewise
};

/// Fills the derived members of `guard` from `value`.
void prepare(const ExponentialBasis& basis, Guard& guard);
/// As `prepare`, if `slope` is already filled in too.
void prepare_with_slope(const ExponentialBasis& basis, Guard& guard);

/// Rounding of a guard's value, relative to the sum of its amplitudes.
inline constexpr double guard_rounding = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace dualdamp::core
