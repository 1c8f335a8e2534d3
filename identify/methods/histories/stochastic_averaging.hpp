#pragma once
/// Friction from the amplitude of a random response, by stochastic averaging.
///
///   A = sqrt(x^2 + (v/W)^2), W^2 = k/m;   p(A) = A exp(-alpha A - beta A^2)/Z
///   F0 = pi m D alpha/(8 W),   c = m D beta/W^2
///
/// under a white acceleration of intensity D, <xi(t) xi(t')> = D delta(t - t'). Maximum likelihood gives alpha and
/// beta: the means of A and A^2 equal those of p. The shape of p gives the ratio of F0 to c, and D their size. D
/// follows from the work of the recorded y or force on the mass, whose mean power is m D/2, or without them from
/// the quadratic variation of v.
///
/// Holds for small damping and an excitation that is white about W; if Coulomb friction is the larger part of the
/// damping, the error of F0 is some per cent and that of c up to a quarter. F0 has no visible effect if k x_rms >
/// 30 F0. Checked: this ratio, the third moment of A, and, if the increments of v give D, that they are those of a
/// white acceleration. Uncertainty: from responses to other random drives
/// (`identify/uncertainty/random_response.hpp`), and scatter between blocks of the record. Source: after
/// Iourtchenko and Dimentberg (liang2004identifying, reference C; the text was not at hand), roberts1986. Errors:
/// `outcome`. Cost: 10 operations a sample.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate stochastic_averaging(const Record& record, const KnownConstants& constants);

extern const MethodEntry stochastic_averaging_method;

}  // namespace dualdamp::identify
