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
/// with x_o the output amplitude [m], x_f = F0/k [m], zeta = c/(2 sqrt(m k)). A bracket of Eq (6) lost its square
/// in print; docs/theory.md derives all of this. For zeta >= 1 sine and cosine turn into their hyperbolic forms.
///
/// Holds where the velocity keeps one sign over the half period between turning points. Eq (3) gives a plausible
/// number beyond that range too, so `non_sticking_state` tests it and answers with nothing where the true motion
/// sticks.
///
/// This is an oracle: it shares no code with the event-driven engine.
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
  double H = 0.0;         ///< -; likewise, relative to the distance of b from a multiple of pi
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

/// Eq (15): G with wd taken for w and wn, sinh(pi zeta)/(cosh(pi zeta) - 1) = coth(pi zeta/2). Needs zeta > 0.
[[nodiscard]] double approximate_G(double zeta);
/// Its derivative, -pi/2 / sinh^2(pi zeta/2).
[[nodiscard]] double approximate_G_derivative(double zeta);

/// S [-]: the motion of amplitude x_o does not stick if and only if x_o/x_f > S.
///
/// On the half period after the upper turning point x' = -x_o w sin(wt) + x_f b(t) with b free of x_o and Y, so
/// S = max b/(w sin wt) over 0 < wt < pi. The end points count with their limits; the maximum may lie inside, below
/// r = 1/2 above all. Absolute error about 1e-15 (1 + G). Needs r >= 1e-4. Infinite when singular.
[[nodiscard]] double non_sticking_limit(const DenHartog& functions);

/// The value of b/(w sin wt) at the turning point, [1 + (1 - r^2) G + 2 zeta r H]/r^2 [-]: the limit S where the
/// motion first stops at its turning point, which is everywhere but at low r. A lower bound of S always.
[[nodiscard]] double turning_point_limit(const DenHartog& functions);

/// Largest x_f/Y [-] that does not stick: (1/q)/sqrt((S + G)^2 + H^2).
[[nodiscard]] double non_sticking_boundary(const DenHartog& functions);

struct NonStickingState {
  double amplitude = 0.0;      ///< x_o [m]
  double turning_phase = 0.0;  ///< w t + phi at the upper turning point [rad], in [0, 2 pi)
  double phase = 0.0;          ///< lag of the fundamental of x behind the base [rad], in [0, 2 pi)
  double fundamental = 0.0;    ///< amplitude of the fundamental of x [m]
};

/// Eq (3) without the test whether the motion sticks; nothing where no positive x_o solves it. Y > 0, x_f >= 0 [m].
[[nodiscard]] std::optional<double> amplitude(const DenHartog& functions, double Y, double x_f);

/// The steady state that never sticks; nothing where there is none. Y > 0, x_f >= 0 [m].
[[nodiscard]] std::optional<NonStickingState> non_sticking_state(const DenHartog& functions, double Y, double x_f);
/// The same for many inputs, with `limit` = `non_sticking_limit(functions)`, which is most of the cost.
[[nodiscard]] std::optional<NonStickingState> non_sticking_state(const DenHartog& functions, double limit, double Y,
                                                                 double x_f);

}  // namespace dualdamp::sim::analytic
