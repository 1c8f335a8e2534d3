#pragma once
/// Fit of Den Hartog's exact amplitude law to x-Y pairs at one or more frequencies.
///
///   x_i = -G x_f + sqrt((Y_i/q)^2 - (H x_f)^2),   G, H, q of (zeta, w_i/wn)           Eqs (3)-(6)
///
/// by least squares over zeta and x_f, with analytic derivatives; over wn too with `free_natural_frequency`.
/// Nothing is neglected, so the frequencies need not be near resonance, and detuning is no error. With one
/// frequency wn cannot be found in practice (the error of zeta would be tens of times larger), so a free wn is
/// refused with fewer than three frequencies.
///
/// Holds for Coulomb and viscous friction, zeta < 0.95, without sticking, errors of x independent and of equal
/// size. Phases are not fitted; if the record has them, they are compared with those of the fitted motion.
/// Uncertainty: covariance of least squares, n - 2 (n - 3) degrees of freedom, or from `sigma_x` and `sigma_Y`.
/// Diagnostics: pairs that stick are left out by the exact test; an F test of a term quadratic in the output; with
/// several frequencies and a known wn, an F test of another wn. Source: denhartog1931, hundal1979,
/// liang2004identifying. Errors: `outcome`. Cost: some twenty evaluations, each 0.3 us a frequency and 20 ns a
/// pair, and the solver's own 0.2 ms.

#include "identify/method.hpp"

namespace dualdamp::identify {

inline constexpr Option free_natural_frequency_option{.name = "free_natural_frequency",
                                                      .meaning = "den_hartog_fit fits the natural frequency too"};

struct DenHartogOptions : KnownDeviations {
  bool free_natural_frequency = false;
  int bootstrap = 0;     ///< replicates; 0: none
  bool profile = false;  ///< curves of the likelihood of zeta and F0

  static constexpr auto declared() {
    return std::tuple_cat(KnownDeviations::declared(),
                          std::tuple{Use{&free_natural_frequency_option, &DenHartogOptions::free_natural_frequency},
                                     Use{&bootstrap_option, &DenHartogOptions::bootstrap},
                                     Use{&profile_option, &DenHartogOptions::profile}});
  }
};

[[nodiscard]] Estimate den_hartog_fit(const Record& record, const KnownConstants& constants,
                                      const DenHartogOptions& options = {});

extern const MethodEntry den_hartog_fit_method;

}  // namespace dualdamp::identify
