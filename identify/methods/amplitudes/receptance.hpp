#pragma once
/// Receptance method: viscous and Coulomb friction from the imaginary part of the inverse receptance over
/// frequency.
///
///   (k Y/X) exp(i phi) = (k - m w^2) + i [c w + 4 F0/(pi X)]
///
/// Linear regression of the imaginary part on {w, 1/X} gives c and F0; that of the real part on {1, w^2} gives a
/// stiffness and a mass, which are listed as further parameters. X is the amplitude of the fundamental if it was
/// measured, otherwise half of peak to trough.
///
/// Holds for Coulomb and viscous friction in the sense of harmonic balance, without sticking. Harmonic balance
/// biases c and F0 by one or two percent; the method computes its bias from exact states at its own estimate.
/// Errors of the data: independent errors of the phasor of x, of equal size along x and across it (an error of the
/// phase is one across x, over X) and at all frequencies. The resulting errors of the imaginary part differ in
/// size; the covariance of the unweighted fit allows for this, n - 2 degrees of freedom. Diagnostics: pairs that
/// stick are left out (when the mass is known); an F test, weighted, of a term that grows with X; with one input
/// amplitude the fit of the limacon, |X/(k Y)| = (1/h)(sin phi - 4 F0/(pi k Y)), h = c wn, listed as a subset: it
/// assumes hysteretic damping, and a difference is a warning. Source: tomlinson1980. Errors: `outcome`. Cost: about
/// 10 us for 50 states.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate receptance(const Record& record, const KnownConstants& constants);

extern const MethodEntry receptance_method;

}  // namespace dualdamp::identify
