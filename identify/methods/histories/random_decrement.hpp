#pragma once
/// Random decrement: the equivalent damping of a random response, over its amplitude.
///
/// Stretches of the response that begin at an extreme with an amplitude near a are averaged. The random part
/// averages out, and the mean decays with
///
///   zeta_eq(a) = zeta + 2 F0/(pi k a)                               by the decrement of its extremes
///
/// zeta and F0 are those of a straight line over 1/a. THEY ARE NOT TO BE USED: the average is not the free decay of
/// a nonlinear system, and the method does not separate Coulomb from viscous friction (F0 of 1 to 2 N comes out as
/// about nothing, zeta several times too high). It is here for the equivalent damping, and as an example of a
/// method that gives plausible but wrong numbers. `usable` is always false, and there is no interval.
///
/// Curves: equivalent_damping (a, zeta_eq), signature. Source: cole1973. Errors: `outcome`. Cost: a few operations
/// a sample.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate random_decrement(const Record& record, const KnownConstants& constants);

extern const MethodEntry random_decrement_method;

}  // namespace dualdamp::identify
