#pragma once
/// Distributions for intervals and tests.

#include <string>

namespace dualdamp::identify {

/// Half width of a two-sided 95 % interval in standard errors: Student's t with `freedom` > 0 degrees of freedom,
/// `normal95` for infinitely many.
[[nodiscard]] double quantile95(double freedom);

/// The normal value 1.96 of `quantile95`.
[[nodiscard]] double normal95();

/// The number of standard errors at which a two-sided normal test has this p-value, from 0 to 1. A p-value below
/// the smallest double counts as that.
[[nodiscard]] double normal_score(double p_value);

/// The p-value of a chi-square test: the probability of at least `statistic` with `freedom` > 0 degrees of freedom.
/// NaN, no p-value, if the statistic is no number or there is no freedom; 0 for an infinite statistic.
[[nodiscard]] double chi_square_p_value(double statistic, double freedom);

/// The p-value of an F test: the probability of at least `statistic` with `numerator` and `denominator` > 0 degrees
/// of freedom. No number, no freedom, infinite: as above.
[[nodiscard]] double f_test_p_value(double statistic, double numerator, double denominator);

/// "p = 0.012"; "p < 1e-300" where it is below the smallest number.
[[nodiscard]] std::string p_text(double p_value);

}  // namespace dualdamp::identify
