#pragma once
/// Den Hartog's closed form of the steady state that never sticks, for base motion y = Y cos(w t + phi) and Coulomb
/// friction F0 sgn(x'):  m x'' + c x' + k x + F0 sgn(x') = k y.
///
///   (x_o + G x_f)^2 + (H x_f)^2 = (Y/q)^2                                             Eq (3)
///   G = (sinh a - zeta/s sin b) / (cosh a + cos b)                                    Eq (4)
///   H = (beta/s sin b) / (cosh a + cos b)                                             Eq (5)
///   q = sqrt((1 - r^2)^2 + (2 zeta r)^2)                                              Eq (6), with the square
///   beta = 1/r, r = w/wn, wn = sqrt(k/m), s = sqrt(1 - zeta^2), a = pi zeta beta, b = pi s beta
///
/// with x_o the output amplitude [m], x_f = F0/k [m], zeta = c/(2 sqrt(m k)). In the paper a bracket of Eq (6)
/// lacks its square. docs/theory.md derives these equations. For zeta >= 1 sine and cosine become hyperbolic.
///
/// Holds if the velocity keeps one sign over the half period between turning points. Eq (3) also gives a plausible
/// number otherwise, so `non_sticking_state` tests this and returns nothing if the true motion sticks.
///
/// This is an oracle: it shares no code with the engines.
///
/// Source: denhartog1931, hundal1979, liang2004identifying. Cost: below a microsecond; `non_sticking_limit` a few
/// microseconds for r near 1, growing as (1 + zeta)/r.

#include <optional>

namespace dualdamp::sim::analytic {

/// Parameter functions of one damping ratio and one frequency ratio.
struct DenHartog {
  double zeta = 0.0;      ///< -, >= 0
  double r = 0.0;         ///< w/wn, -, > 0
  double G = 0.0;         ///< -; relative error a few 1e-16
  double H = 0.0;         ///< -; the same error, relative to the distance of b from a multiple of pi
  double q = 0.0;         ///< -, inverse of the viscous magnification
  double dG_dzeta = 0.0;  ///< -, for Eq (17)
  /// zeta = 0 with 1/r odd: resonance of the undamped oscillator with a harmonic of the friction force; G and H are
  /// infinite and there is no such steady state.
  bool singular = false;
};

/// Precondition: zeta >= 0 and r > 0, both finite.
[[nodiscard]] DenHartog den_hartog(double zeta, double r);

/// First derivatives of the parameter functions with respect to zeta and r.
struct DenHartogSlopes {
  double G_zeta = 0.0, H_zeta = 0.0, q_zeta = 0.0;
  double G_r = 0.0, H_r = 0.0, q_r = 0.0;
};

/// Precondition: 0 < zeta < 1. Relative error about 1e-15/s^2.
[[nodiscard]] DenHartogSlopes slopes(const DenHartog& functions);

/// Eq (15): G with wd in place of w and wn, sinh(pi zeta)/(cosh(pi zeta) - 1) = coth(pi zeta/2). Needs zeta > 0.
[[nodiscard]] double approximate_G(double zeta);
/// Its derivative, -pi/2 / sinh^2(pi zeta/2).
[[nodiscard]] double approximate_G_derivative(double zeta);

/// S [-]: the motion of amplitude x_o does not stick if and only if x_o/x_f > S.
///
/// On the half period after the upper turning point x' = -x_o w sin(wt) + x_f b(t), where b does not depend on x_o
/// and Y. So S = max b/(w sin wt) over 0 < wt < pi, with the limits at the end points. The maximum may lie inside,
/// mostly below r = 1/2. Absolute error about 1e-15 (1 + G). Needs r >= 1e-4. Infinite if singular.
[[nodiscard]] double non_sticking_limit(const DenHartog& functions);

/// The value of b/(w sin wt) at the turning point, [1 + (1 - r^2) G + 2 zeta r H]/r^2 [-]. It is a lower bound of
/// S, and equal to S if the motion first stops at its turning point, as it does except at low r.
[[nodiscard]] double turning_point_limit(const DenHartog& functions);

/// Largest x_f/Y [-] of a motion that does not stick: (1/q)/sqrt((S + G)^2 + H^2).
[[nodiscard]] double non_sticking_boundary(const DenHartog& functions);

struct NonStickingState {
  double amplitude = 0.0;      ///< x_o [m]
  double turning_phase = 0.0;  ///< w t + phi at the upper turning point [rad], in [0, 2 pi)
  double phase = 0.0;          ///< lag of the fundamental of x behind the base [rad], in [0, 2 pi)
  double fundamental = 0.0;    ///< amplitude of the fundamental of x [m]
};

/// x_o [m] by Eq (3), without the test whether the motion sticks; nothing if no positive x_o solves it. Y > 0,
/// x_f >= 0 [m].
[[nodiscard]] std::optional<double> amplitude(const DenHartog& functions, double Y, double x_f);

/// The steady state that never sticks; nothing if there is none. Y > 0, x_f >= 0 [m].
[[nodiscard]] std::optional<NonStickingState> non_sticking_state(const DenHartog& functions, double Y, double x_f);
/// That steady state with a known `limit` = `non_sticking_limit(functions)`, which is most of the cost: for many
/// inputs.
[[nodiscard]] std::optional<NonStickingState> non_sticking_state(const DenHartog& functions, double limit, double Y,
                                                                 double x_f);

}  // namespace dualdamp::sim::analytic
