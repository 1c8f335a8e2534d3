#pragma once
/// How errors of the four measured amplitudes reach a two-point resonance estimate, to first order.
///
///   zeta = (Y2 - Y1)/(2 (x2 - x1)),   x_f = (x1 Y2 - x2 Y1)/(G(zeta) (Y1 - Y2))       Eqs (14), (13)
///   dzeta = [dY2 - dY1 - 2 zeta (dx2 - dx1)]/(2 (x2 - x1))                            Eq (16)
///   dx_f  = A dx1 + B dx2 + C dY1 + D dY2 + E dzeta                                   Eq (17)
///
/// A ... E are the partial derivatives at fixed zeta and with respect to zeta. They nearly cancel, because an error
/// that raises zeta lowers G. The effect of an error on x_f is the total derivative, Eq (16) inserted into Eq (17).
/// docs/theory.md gives its form for small zeta: an output error has the factor 2 zeta, an input error the factor
/// pi/4 for any zeta.
///
/// Source: liang2004identifying. Cost: below a microsecond. Errors: none; the preconditions are stated below.

namespace dualdamp::identify {

struct AmplitudePair {
  double Y = 0.0;  ///< m
  double x = 0.0;  ///< m
};

/// A change, or a derivative, with respect to each measured amplitude.
struct PairChanges {
  double x1 = 0.0, x2 = 0.0, Y1 = 0.0, Y2 = 0.0;
};

struct TwoPointSensitivity {
  double zeta = 0.0;                          ///< estimate, -
  double x_f = 0.0;                           ///< estimate, m
  double G = 0.0;                             ///< at zeta, -
  double A = 0.0, B = 0.0, C = 0.0, D = 0.0;  ///< -
  double E = 0.0;                             ///< m
  PairChanges of_zeta;                        ///< Eq (16): d zeta/d x1 ... [1/m]
  PairChanges of_x_f;                         ///< total derivatives of x_f, E folded in [-]
};

/// G of a resonance estimate: exact Eq (4) at r = w/wn, or the approximation Eq (15).
struct ResonanceG {
  double r = 1.0;
  bool approximate = false;

  [[nodiscard]] double value(double zeta) const;
  [[nodiscard]] double derivative(double zeta) const;
};

/// Precondition: the two inputs differ, the two outputs differ, and zeta by Eq (14) is positive.
[[nodiscard]] TwoPointSensitivity two_point_sensitivity(const AmplitudePair& first, const AmplitudePair& second,
                                                        const ResonanceG& G);

}  // namespace dualdamp::identify
