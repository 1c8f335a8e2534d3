#pragma once
/// Friction from the amplitude of a random response, by stochastic averaging.
///
///   A = sqrt(x^2 + (v/W)^2), W^2 = k/m;   p(A) = A exp(-alpha A - beta A^2)/Z
///   F0 = pi m D alpha/(8 W),   c = m D beta/W^2
///
/// under a white acceleration of intensity D, <xi(t) xi(t')> = D delta(t - t'). alpha and beta by maximum
/// likelihood: the mean of A and of A^2 are those of p. The shape of p tells F0 from c and not their size, which D
/// sets: from the work of the recorded y or force on the mass, which is m D/2 on average, or without them from the
/// quadratic variation of v.
///
/// Holds for small damping and an excitation that is white about W; where dry friction is the larger part of the
/// damping F0 comes out some per cent off, and c for it up to a quarter. F0 is not to be seen once k x_rms > 30 F0.
/// Checked: that ratio, the third moment of A, increments as white ones where they give D. Uncertainty: from
/// responses to other random drives (`identify/uncertainty/random_response.hpp`), scatter between blocks of the
/// record. Source: after Iourtchenko and Dimentberg (liang2004identifying, reference C; the text was not at hand),
/// roberts1986. Errors: `outcome`. Cost: 10 operations a sample.

#include "identify/method.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate stochastic_averaging(const Record& record, const KnownConstants& constants);

extern const MethodEntry stochastic_averaging_method;

}  // namespace dualdamp::identify
