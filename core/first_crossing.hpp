#pragma once
/// The certified first crossing of guards on one mode.
///
/// A guard is a function g(s) on an exponential basis that is positive while the mode holds.
///
/// What triggers. The search returns the smallest s in (0, horizon) at which some guard goes from positive to
///   negative. Sides are frozen: a guard counts as positive from the start of the mode, so a root that rounding
///   has stepped across is still a sign change on the panel that contains it.
/// What happens exactly at an end point.
///   s = 0        The caller states how many zeros g has there (`known_zeros`: value, slope, curvature, ...).
///                They are factored out of the first panel, never stepped over; g is taken positive just after 0.
///   s = horizon  Belongs to the next search: a guard that reaches zero there within rounding is not reported here
///                and the caller's check at the start of the next mode finds it. So does a contact of one guard
///                that is not over where another one crosses.
/// Tangency. Rounding of g at s is taken as (16 eps + eps max|Im z| s) times the sum of the guard's amplitudes
///   |c_k E_k(s)|, the second part from the phases z s; with n known zeros and s < T/2, T = 1/max|z|, as that at T
///   times (s/T)^n. A minimum within it of zero is one grazing contact: reported, not a crossing. Deeper dips are
///   two crossings, of which the first is returned. Touches between which g does not leave that rounding are one
///   contact; the contact of which a crossing is the end is no grazing.
/// Range. A guard that leaves the range of double precision ends the search: nothing found, values infinite. One
/// whose
///   amplitudes have decayed below 1e-280 has no zeros any more.
/// Why nothing can be missed. The interval is covered by panels. On a panel of width h the quintic Hermite
///   interpolant H of (g, g', g'') at both ends obeys
///       |g - H| <= M6 t^3 (1-t)^3 h^6 / 720,   M6 >= |g^(6)| on the panel,
///   M6 from the amplitudes, since every element's modulus is known. In Bernstein form of degree six that remainder
///   touches one coefficient only: L = H - remainder. All coefficients of L positive: no zero on the panel. Where a
///   panel ends negative, a root of g is found by Halley's method and the panel from its begin to that root is
///   examined in the same way, with the zero at its end factored out: positive coefficients show that it is the
///   first one. It is a change of sign when g'^2 there exceeds 4 M2 times the rounding of g, M2 >= |g''|. Anything
///   else is split, at the minimum where there is one, until one of these cases holds.
///   Where a lone guard starts at zero and Halley's method finds a root beside the crossing that the basis expects
///   (ExponentialBasis::expected), the panel from the start to that root is tried before all others, by the same
///   two conditions.
///
/// Cost: on a basis without chains a panel costs a few dozen multiplications and no transcendental function; a
/// crossing costs one evaluation of the basis, none where it was expected. No allocation unless contacts graze.

#include <span>
#include <vector>

#include "core/exponential_basis.hpp"

namespace dualdamp::core {

struct Guard {
  ModeFunction value;
  int known_zeros = 0;  ///< order of the zero at s = 0, up to 3

  // Filled by prepare().
  ModeFunction slope;
  ModeFunction curvature;
  ModeFunction sixth;            ///< sixth derivative; unused on an even basis
  double amplitude = 0.0;        ///< sum of |c_k|
  double curvature_bound = 0.0;  ///< of |g''|, on an even basis for all s
  double sixth_bound = 0.0;      ///< of |g^(6)|, likewise
};

/// Fills the derived members of `guard` from `value`.
void prepare(const ExponentialBasis& basis, Guard& guard);
/// The same where `slope` is known already.
void prepare_with_slope(const ExponentialBasis& basis, Guard& guard);

struct Crossing {
  bool found = false;
  int guard = -1;                   ///< index of the guard that crossed
  double s = 0.0;                   ///< where [s]
  ExponentialBasis::Values values;  ///< E_k at s, or at the horizon when nothing was found
};

/// A tangency.
struct Grazing {
  int guard = -1;
  double s = 0.0;  ///< s
};

/// What has been searched so far: the certificate a run can print.
struct SearchCount {
  long searches = 0;  ///< searches for the next event
  long panels = 0;    ///< certified, of all guards at once
  long splits = 0;    ///< panels of one guard that had to be divided
  long grazings = 0;  ///< tangencies

  SearchCount& operator+=(const SearchCount& other) {
    searches += other.searches;
    panels += other.panels;
    splits += other.splits;
    grazings += other.grazings;
    return *this;
  }
};

/// First crossing of any of `guards` (each prepared) in (0, horizon); tangencies before it are appended to
/// `grazings`. The horizon must be finite and >= 0.
void first_crossing(const ExponentialBasis& basis, std::span<const Guard> guards, double horizon,
                    Crossing& crossing, std::vector<Grazing>& grazings, SearchCount& count);

/// The sign of a function just after s = 0 and the order of its zero there, from its Taylor coefficients; a
/// coefficient within 16 eps times its own amplitudes' sum plus `tolerance` times the basis' rate counts as zero.
struct Germ {
  int sign = 0;   ///< 0: zero to the order examined
  int zeros = 0;  ///< number of leading Taylor coefficients that vanish
};

[[nodiscard]] Germ germ(const ExponentialBasis& basis, const ModeFunction& f, double tolerance);
/// Of a prepared guard whose first `from` Taylor coefficients are known to vanish.
[[nodiscard]] Germ germ(const ExponentialBasis& basis, const Guard& guard, double tolerance, int from = 0);

}  // namespace dualdamp::core
