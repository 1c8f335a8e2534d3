#pragma once
/// Jacobsen and Ayre's rule of thumb: the damping ratio from the large swings, the friction from the small ones.
///
///   zeta_app = ln(X_0/X_2)/(2 pi),   x_f,app = (X_(n-3) - X_(n-1))/4
///
/// X_i = |e_i| are magnitudes about zero. The first formula assumes viscous damping alone, the second Coulomb
/// friction alone, so both results are too large:  zeta_app ~ zeta + 2 x_f/(pi X),  x_f,app ~ x_f + pi zeta X/2,
/// where X is the swing between the two that are compared. Solving these two equations for zeta and x_f gives the
/// estimate listed as "corrected". free_decay has no such bias and should be used. This method is the baseline for
/// the others, as crude as it is in practice.
///
/// Holds for extremes about zero of a mass that moves; at least three. Checked: the extremes alternate; the bias is
/// computed from the corrected estimate and makes the estimate unusable from 10 % on, which is nearly always.
/// Standard errors follow from `sigma_x` only: two numbers from three or four extremes leave no degree of freedom.
/// Source: jacobsen1958 (as described by liang1998decrement). Errors: `outcome`. Cost: nothing.

#include "identify/method.hpp"

namespace dualdamp::identify {

struct JacobsenAyreOptions {
  double sigma_x = 0.0;  ///< standard deviation of one extreme [m]; 0: not known

  static constexpr auto declared() { return std::tuple{Use{&sigma_x_option, &JacobsenAyreOptions::sigma_x}}; }
};

[[nodiscard]] Estimate jacobsen_ayre(const Record& record, const KnownConstants& constants,
                                     const JacobsenAyreOptions& options = {});

extern const MethodEntry jacobsen_ayre_method;

}  // namespace dualdamp::identify
