#pragma once
/// Free-vibration decrements: viscous and Coulomb friction from the extremes of a free decay.
///
///   e_i = (-1)^i X_i + o,   X_(i+1) = R X_i - x_f (1 + R),   R = exp(-pi zeta/sqrt(1 - zeta^2))
///
/// with an unknown offset o of the sensor. Differences of extremes two apart contain neither friction nor offset,
/// so four extremes give one exact estimate,
///   R = -(e_3 - e_1)/(e_2 - e_0),   x_f = |u_0 - 2 u_1 + u_2|/(4 (1 + R)),   u_i = e_(i+1) + R e_i.
/// More extremes: least squares by variable projection. For a given R the model is linear in X_0, X_0 - X_1 and o,
/// so the search is for R alone. (In a regression of X_(i+1) on X_i the regressor would have errors.) With
/// `zero_offset` the extremes are about zero, with alternating signs, and three suffice.
///
/// Holds for a linear spring and zeta < 1 while the mass moves: extremes after one with X_i <= x_f are left out.
/// Checked: the extremes alternate; the half swing lasts pi/(wn sqrt(1 - zeta^2)), if times are given; an F test of
/// a cubic term, from six extremes on. Estimates from each four successive extremes are listed. Uncertainty:
/// least-squares covariance with n - 4 degrees of freedom (n - 3 with `zero_offset`), or from `sigma_x`. Source:
/// feeny1996decrement, liang1998decrement. Errors: `outcome`. Cost: 300 linear fits of three unknowns.

#include "identify/method.hpp"

namespace dualdamp::identify {

inline constexpr Option zero_offset_option{
    .name = "zero_offset", .meaning = "the extremes of a free vibration are known to be about zero"};

struct FreeDecayOptions {
  double sigma_x = 0.0;      ///< standard deviation of one extreme [m]; 0: from the residuals
  bool zero_offset = false;  ///< the extremes are about zero, so three of them suffice

  static constexpr auto declared() {
    return std::tuple{Use{&sigma_x_option, &FreeDecayOptions::sigma_x},
                      Use{&zero_offset_option, &FreeDecayOptions::zero_offset}};
  }
};

[[nodiscard]] Estimate free_decay(const Record& record, const KnownConstants& constants,
                                  const FreeDecayOptions& options = {});

extern const MethodEntry free_decay_method;

}  // namespace dualdamp::identify
