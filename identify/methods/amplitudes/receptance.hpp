#pragma once
/// Receptance method: viscous and Coulomb friction from the imaginary part of the inverse receptance over
/// frequency.
///
///   (k Y/X) exp(i phi) = (k - m w^2) + i [c w + 4 F0/(pi X)]
///
/// Linear regression of the imaginary part on {w, 1/X} gives c and F0; that of the real part on {1, w^2} gives the
/// stiffness and the mass that the motion shows, listed beside. X is the amplitude of the fundamental where it was
/// measured, else half of peak to trough.
///
/// Holds for Coulomb and viscous friction in the sense of harmonic balance, without sticking. Harmonic balance
/// biases c and F0 by one or two percent; the method tells by reading exact states at its own estimate. Errors:
/// independent errors of x, as long along x as across it (those of the phase are errors of x over X), alike at all
/// frequencies; they make errors of the imaginary part that are not alike, which the covariance of the unweighted
/// fit allows for, n - 2 degrees of freedom. Diagnostics: pairs that stick are left out (when the mass is known);
/// an F test, weighted, of a term that grows with X; with one input amplitude the fit of the limacon, |X/(k Y)| =
/// (1/h)(sin phi - 4 F0/(pi k Y)), h = c wn, listed as a subset: it takes hysteretic damping, and a warning tells
/// when it disagrees. Source: tomlinson1980. Errors: `outcome`. Cost: about 10 us for 50 states.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate receptance(const Record& record, const KnownConstants& constants);

/// Phases at three frequencies are asked for.
[[nodiscard]] std::string lacks_receptance(const Record& record);

extern const MethodEntry receptance_method;

}  // namespace dualdamp::identify
