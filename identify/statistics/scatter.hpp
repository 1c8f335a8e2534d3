#pragma once
/// How readings scatter beside the noise that is stated for them.

#include "identify/estimate.hpp"

namespace dualdamp::identify {

/// Degrees of freedom behind a stated deviation: F with so many in the denominator is chi-square.
inline constexpr double known_freedom = 1e9;

/// Two-sided p-value of a mean square of residuals that is `ratio` times the stated variance.
[[nodiscard]] double stated_noise_p_value(double ratio, double freedom);

/// How readings scatter beside their stated noise: as stated, or clearly less or more.
enum class ScatterBesideStated { less, as_stated, more };

/// `ratio`: of the deviations; `p_value`: that of its square.
[[nodiscard]] ScatterBesideStated scatter_beside_stated(double ratio, double p_value);

/// Warns of readings that scatter clearly more than their stated deviations say. `ratio`: the mean square of the
/// residuals over the stated variance; `freedom`: degrees of freedom of the residuals.
void warn_of_scatter(double ratio, double freedom, Estimate& estimate);

}  // namespace dualdamp::identify
