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
/// Grazing. A guard whose value is within its rounding (`core/crossing/guard_jets.hpp`) grazes zero. A grazing is
///   reported and is not a crossing. A deeper dip is two crossings, of which the first is returned. If g stays
///   within its rounding for some time, this is one grazing, unless that time ends with a crossing, of which it is
///   then a part (`core/crossing/grazing.hpp`).
/// Range. A guard that leaves the range of double precision ends the search with SearchEnd::left_range. Elements
///   that are in no guard may leave it. A guard with amplitudes beyond 1e60 or below 1e-60 is searched multiplied
///   by a power of two; one whose amplitudes have decayed by 1e-220 has no zeros any more.
/// Length. A search of more than `most_panels` panels ends with SearchEnd::too_long: the guard turns too often
///   before the horizon, or a panel is divided without end.
/// Why nothing can be missed (`core/crossing/panel_search.hpp`). Panels cover the interval. On a panel of width h
///   the quintic Hermite interpolant H of (g, g', g'') at both ends obeys
///       |g - H| <= M6 t^3 (1-t)^3 h^6 / 720,   M6 >= |g^(6)| on the panel,
///   M6 from the amplitudes, since every element's modulus is known. In Bernstein form of degree six this remainder
///   changes one coefficient only: L = H - remainder. There are three cases.
///   1. All coefficients of L are positive: the panel has no zero.
///   2. The panel ends negative: Halley's method finds a root of g. The panel from its start to that root is
///      examined in the same way, with the zero at its end factored out: positive coefficients show that the root
///      is the first one. It is a change of sign if g'^2 there exceeds 4 M2 times the rounding of g, M2 >= |g''|.
///   3. Any other panel is split, at the minimum if there is one, until case 1 or 2 holds.
///   Expected crossing: if a lone guard starts at zero and Halley's method finds a root near the crossing that the
///   basis expects (ExponentialBasis::expected), the panel from the start to that root is tried before all others,
///   by the two conditions of case 2.
///   Wide stretches: a search that has taken 64 panels also tries wider stretches. A stretch has no zero if in each
///   guard the constant outweighs the largest moduli of all other elements.
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
