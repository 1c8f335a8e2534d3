#pragma once
/// Extended Kalman filter with the friction among the states (x, v, F0, c):
///
///   v' = [k (y - x) + f - c v - F0 tanh(v/e)]/m,   F0' = c' = 0,   measured: x
///   P' = A P + P A^T between samples;  K = P h/(h^T P h + s^2), state += K (x_i - x), P -= K h^T P at a sample
///
/// The sign of the velocity must be smooth for A to exist. Its width e (`sign_width`, default 0.003 of the largest
/// speed) biases the estimate, and with a too large width the filter diverges. P does not contain this error, so
/// intervals come from the parametric bootstrap (`identify/uncertainty/parametric_bootstrap.hpp`). Checked: the
/// estimate with twice the width (`subsets`); the innovations against the size that P expects; a filter that
/// diverges is refused. s: noise of x, from `sigma_x` or estimated from the record.
///
/// Curve: friction_over_time. Source: after Stanway (liang2004identifying, reference 12; the text was not at hand),
/// detchmendy1966. Errors: `outcome`. Cost: 2 us a step, several steps a sample.

#include "identify/method.hpp"

namespace dualdamp::identify {

inline constexpr Option sign_width_option{
    .name = "sign_width",
    .kind = OptionKind::number,
    .unit = "m/s",
    .range = friction::positive,
    .otherwise = "0.003 of the largest speed",
    .meaning = "width of the smoothed sign of the velocity in extended_kalman"};

struct KalmanOptions {
  double sigma_x = 0.0;     ///< standard deviation of the noise of x [m]; 0: from the record
  double sign_width = 0.0;  ///< width of the smoothed sign of the velocity [m/s]; 0: the method's own choice

  static constexpr auto declared() {
    return std::tuple{Use{&sigma_x_option, &KalmanOptions::sigma_x},
                      Use{&sign_width_option, &KalmanOptions::sign_width}};
  }
};

[[nodiscard]] Estimate extended_kalman(const Record& record, const KnownConstants& constants,
                                       const KalmanOptions& options = {});

extern const MethodEntry extended_kalman_method;

}  // namespace dualdamp::identify
