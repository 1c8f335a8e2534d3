#pragma once
/// The certified first crossing of guards on one mode.
///
/// A guard (`core/crossing/guard.hpp`) is a function g(s) on an exponential basis that is positive while the mode
/// holds.
///
/// What triggers. The search returns the smallest s in (0, horizon) at which some guard goes from positive to
///   negative. The side of a guard is frozen: a guard counts as positive from the start of the mode, so a root that
///   rounding has stepped across is still a sign change on the panel that contains it.
/// What happens exactly at an end point.
///   s = 0        The caller states how many zeros g has there (`known_zeros`: value, slope, curvature, ...;
///                `core/crossing/interval_start.hpp` counts them). They are factored out of the first panel, never
///                stepped over; g is taken positive just after 0.
///   s = horizon  Belongs to the next search: a guard that reaches zero there within rounding is not reported here
///                and the caller's check at the start of the next mode finds it. The same holds for a grazing of
///                one guard that is not over where another guard crosses.
/// Grazing. A guard whose value is within its rounding (`core/crossing/guard_jets.hpp`) grazes zero: that is
/// reported and is
///   not a crossing. A deeper dip is two crossings, of which the first is returned. Where g stays within that
///   rounding for a while there is one grazing; where that while ends with a crossing there is none
///   (`core/crossing/grazing.hpp`).
/// Range. A guard that leaves the range of double precision ends the search with SearchEnd::left_range. Elements
///   that are not in a guard have no part in that. A guard with amplitudes beyond 1e60 or below 1e-60 is searched
///   multiplied by a power of two; one whose amplitudes have decayed by 1e-220 has no zeros any more.
/// Length. A search of more than `most_panels` panels ends with SearchEnd::too_long: the guard turns too often
/// before
///   the horizon, or a panel is divided without end.
/// Why nothing can be missed (`core/crossing/panel_search.hpp`). The interval is covered by panels. On a panel of
/// width h
///   the quintic Hermite interpolant H of (g, g', g'') at both ends obeys
///       |g - H| <= M6 t^3 (1-t)^3 h^6 / 720,   M6 >= |g^(6)| on the panel,
///   M6 from the amplitudes, since every element's modulus is known. In Bernstein form of degree six that remainder
///   changes one coefficient only: L = H - remainder. All coefficients of L positive: no zero on the panel. Where a
///   panel ends negative, a root of g is found by Halley's method and the panel from its begin to that root is
///   examined in the same way, with the zero at its end factored out: positive coefficients show that it is the
///   first one. It is a change of sign when g'^2 there exceeds 4 M2 times the rounding of g, M2 >= |g''|. Any other
///   panel is split, at the minimum where there is one, until one of these cases holds.
///   Where a lone guard starts at zero and Halley's method finds a root beside the crossing that the basis expects
///   (ExponentialBasis::expected), the panel from the start to that root is tried before all others, by the same
///   two conditions.
///
///   Where a search has taken 64 panels wider stretches are tried: where the constant of each guard outweighs the
///   largest moduli of all its other elements there is no zero.
///
/// Cost: on a basis without chains a panel costs a few dozen multiplications and no transcendental function; a
/// crossing costs one evaluation of the basis, none where it was expected. No allocation unless guards graze.

#include <span>
#include <vector>

#include "core/crossing/exponential_basis.hpp"
#include "core/crossing/guard.hpp"
#include "core/crossing/search_result.hpp"

namespace dualdamp::core {

/// First crossing of any of `guards` (each prepared) in (0, horizon); grazings before it are appended to
/// `grazings`. The horizon must be finite and >= 0.
SearchEnd first_crossing(const ExponentialBasis& basis, std::span<const Guard> guards, double horizon,
                         Crossing& crossing, std::vector<Grazing>& grazings, SearchCount& count);

}  // namespace dualdamp::core
