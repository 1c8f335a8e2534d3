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
  ModeFunction sixth;            ///< sixth derivative by fastest() s; unused on an even basis
  double amplitude = 0.0;        ///< sum of |c_k|
  double curvature_bound = 0.0;  ///< of |g''|, on an even basis for all s
  double sixth_bound = 0.0;      ///< of that sixth derivative, likewise
};

/// Fills the derived members of `guard` from `value`.
void prepare(const ExponentialBasis& basis, Guard& guard);
/// The same where `slope` is known already.
void prepare_with_slope(const ExponentialBasis& basis, Guard& guard);

/// Relative rounding of a guard's value, in parts of the sum of its amplitudes.
inline constexpr double guard_rounding = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace dualdamp::core
