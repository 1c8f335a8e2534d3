#pragma once
/// The four-parameter Iwan model of a bolted joint: Jenkins elements in parallel whose slip distances phi are
/// spread by a power law, and one more element that slides last.
///
///   rho(phi) = R phi^exponent  for 0 < phi < phi_max,   and S at phi = phi_max
///
/// rho dphi is the stiffness [N/m] of the elements of slip distance phi. In terms that a test measures, with
/// -1 < exponent:
///
///   stiffness   K_T = R phi_max^(exponent+1)/(exponent+1) + S              before anything slides [N/m]
///   limit       F_S = R phi_max^(exponent+2)/(exponent+2) + S phi_max      when everything slides (macroslip) [N]
///   beta        S/(K_T - S)
///
///   first loading        F = K_T x - R x^(exponent+2)/((exponent+1)(exponent+2)),            x <= phi_max      [N]
///   work of a loop       W = 4 R A^(exponent+3)/((exponent+2)(exponent+3)),   amplitude A <= phi_max           [J]
///
/// The dissipation grows with the power exponent + 3 of the amplitude; joints in tests have powers between 2 and 3.
///
/// Discretisation: `count` elements take the cells of a grid over phi and one takes S. The first cell reaches from
/// 0 to smallest phi_max, the edges of the others grow by the same ratio q to phi_max. An element has the stiffness
/// and the limit of its cell, so that
///   * the force that sliding takes away in first loading, K_T x - F, is exact where x is an edge, and between
///     edges too small by at most the fraction (exponent + 1)(exponent + 2)(ln q)^2/8;
///   * the work of a loop is too large by the fraction (exponent + 2)(ln q)^2/12 where A is an edge, and too small
///     by the fraction (exponent + 2)(3 exponent + 7)(ln q)^2/24 half way between two edges, where it is worst;
///     everywhere (smallest phi_max/A)^(exponent+3)/(exponent+2) is added;
/// all to the leading order of ln q. With 100 elements down to 1e-4, ln q = 0.093: less than 0.3 % of the force and
/// 0.6 % of the work for an exponent up to 0 and A above 20 smallest phi_max. Both fall with the square of ln q.
///
/// The elements in parallel are `iwan`. Source: segalman2005, iwan1966 in `docs/refs.bib`. Exact engine. Cost: as
/// `iwan`.

#include <vector>

#include "friction_models/laws/iwan.hpp"

namespace dualdamp::friction {

struct IwanFourParameter {
  double stiffness = 1.0;  ///< K_T > 0 [N/m]
  double limit = 1.0;      ///< F_S > 0 [N]
  double exponent = 0.0;   ///< > -1
  double beta = 0.0;       ///< >= 0

  static const std::vector<Parameter>& parameters();

  [[nodiscard]] double phi_max() const;  ///< m
  [[nodiscard]] double R() const;        ///< N/m^(exponent+2)
  [[nodiscard]] double S() const;        ///< N/m

  /// 1 <= count, 0 < smallest < 1.
  [[nodiscard]] std::vector<Iwan::Element> elements(int count, double smallest) const;
};

}  // namespace dualdamp::friction
