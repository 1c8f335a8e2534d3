#pragma once
/// Jacobsen and Ayre's rule of thumb: the damping ratio from the large swings, the friction from the small ones.
///
///   zeta_app = ln(X_0/X_2)/(2 pi),   x_f,app = (X_(n-3) - X_(n-1))/4
///
/// X_i = |e_i| are magnitudes about zero. The first takes the decay for viscous, the second for Coulomb friction's,
/// so both come out too large:  zeta_app ~ zeta + 2 x_f/(pi X),  x_f,app ~ x_f + pi zeta X/2,  X the swing between
/// the two that are compared. Solving these two for zeta and x_f gives the estimate listed as "corrected", which is
/// the fixed point of correcting each by the other; free_decay has no such bias and should be used. This method is
/// kept as the baseline that others are measured against, deliberately as crude as it is practised.
///
/// Holds for extremes about zero of a mass that moves; three at least. Checked: the extremes alternate; the bias is
/// computed from the corrected estimate and makes the estimate unusable from 10 % on, which is nearly always. No
/// standard errors but from `sigma_x`: two numbers from three or four extremes leave no freedom. Source:
/// jacobsen1958 (as described by liang1998decrement). Errors: `outcome`. Cost: nothing.

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
