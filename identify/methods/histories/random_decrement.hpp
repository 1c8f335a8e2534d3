#pragma once
/// Random decrement: the equivalent damping of a random response, over its amplitude.
///
/// Stretches of the response that begin at an extreme with an amplitude near a are averaged; what is random drops
/// out, and what remains decays with
///
///   zeta_eq(a) = zeta + 2 F0/(pi k a)                               by the decrement of its extremes
///
/// zeta and F0 are those of a straight line over 1/a. THEY ARE NOT TO BE USED: the average is not the free decay of
/// a nonlinear system, and the method does not separate Coulomb from viscous friction (F0 of 1 to 2 N comes out as
/// about nothing, zeta several times too high). It is here as equivalent damping, and as an example of a method
/// that gives plausible numbers. `usable` is always false, and no interval is claimed.
///
/// Curves: equivalent_damping (a, zeta_eq), signature. Source: cole1973. Errors: `outcome`. Cost: a few operations
/// a sample.

#include "identify/method.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate random_decrement(const Record& record, const KnownConstants& constants);

inline constexpr MethodEntry random_decrement_method{
    "random_decrement",
    "equivalent damping of a random response over its amplitude; not to be used for the Coulomb friction",
    "long stationary response to a white excitation; the averaged stretches are taken for a free decay, which they "
    "are not where there is dry friction: never usable",
    "zeta_eq(a) = zeta + 2 F0/(pi k a) of the mean of stretches that begin at an extreme near a",
    "cole1973",
    RecordKind::history,
    lacks_histories,
    call_of<random_decrement>};

}  // namespace dualdamp::identify
