#pragma once
/// Recursive least squares on the equation of motion: friction over time.
///
///   z = k (y - x) + f - m a,   psi = (v, sgn v),   theta = (c, F0)
///   K = P psi/(l + psi^T P psi),   theta += K (z - psi^T theta),   P = (P - K psi^T P)/l
///
/// A forgetting factor l < 1 follows a slow drift, with a memory of 1/(1 - l) samples; l = 1 is least squares of
/// all samples so far. Samples with |v| < `least_speed` do not change the estimate. The other interpretation of the
/// method, by the error of the output, is `output_error`.
///
/// Curve: friction_over_time. Checked: with l = 1, whether both halves of the record agree. Uncertainty: from
/// the parametric bootstrap (`identify/uncertainty/parametric_bootstrap.hpp`). Source: after yao
/// (liang2004identifying, reference 13; the text was not at hand), ljung1999. Errors: `outcome`. Cost: 30
/// operations a sample.

#include "identify/method.hpp"

namespace dualdamp::identify {

inline constexpr Option forgetting_option{
    .name = "forgetting",
    .kind = OptionKind::number,
    .unit = "1",
    .range = {.low = 0.0, .high = 1.0, .low_open = true},
    .otherwise = "1",
    .meaning = "forgetting factor of recursive_least_squares; 1 forgets nothing"};

struct RecursiveOptions : RegressionOptions {
  double forgetting = 1.0;  ///< in (0, 1]; 1 forgets nothing

  static constexpr auto declared() {
    return std::tuple_cat(RegressionOptions::declared(),
                          std::tuple{Use{&forgetting_option, &RecursiveOptions::forgetting}});
  }
};

[[nodiscard]] Estimate recursive_least_squares(const Record& record, const KnownConstants& constants,
                                               const RecursiveOptions& options = {});

extern const MethodEntry recursive_least_squares_method;

}  // namespace dualdamp::identify
