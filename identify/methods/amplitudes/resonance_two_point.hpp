#pragma once
/// Two-point resonance method: viscous and Coulomb friction from two input-output amplitude pairs at resonance.
///
///   zeta = (Y2 - Y1)/(2 (x2 - x1)),   x_f = (x1 Y2 - x2 Y1)/(G(zeta) (Y1 - Y2))       Eqs (14), (13)
///
/// with G from the exact Eq (4) at w = wn, or from Eq (15) with `approximate_G`. The pairs are the
/// named ones, or those with the smallest and the largest input among the pairs that do not stick.
///
/// Holds for small zeta near w = wn, without sticking; the error of the method is computed at its own estimate.
/// Standard errors need the measurement deviations (`sigma_x`, `sigma_Y`): two pairs leave no degree of freedom.
/// They then follow Eqs (16)-(17), with intervals of a normal distribution. Source: liang2004identifying. Errors:
/// `outcome`. Cost: linear in the pairs, for leaving out those that stick.

#include "identify/method.hpp"

namespace dualdamp::identify {

inline constexpr Option pairs_option{.name = "pairs",
                                     .kind = OptionKind::counts,
                                     .range = {.low = 1.0},
                                     .least_items = 2,
                                     .most_items = 2,
                                     .otherwise = "the outermost",
                                     .meaning = "numbers of the two pairs that resonance_two_point uses"};

struct TwoPointOptions : ResonanceOptions {
  std::vector<int> pairs;  ///< numbers of two; empty: the outermost usable pairs

  static constexpr auto declared() {
    return std::tuple_cat(ResonanceOptions::declared(), std::tuple{Use{&pairs_option, &TwoPointOptions::pairs}});
  }
};

[[nodiscard]] Estimate resonance_two_point(const Record& record, const KnownConstants& constants,
                                           const TwoPointOptions& options = {});

extern const MethodEntry resonance_two_point_method;

}  // namespace dualdamp::identify
