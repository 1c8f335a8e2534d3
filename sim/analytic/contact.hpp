#pragma once
/// Contact compliance in series with Coulomb friction (a Jenkins element) under harmonic motion x = X cos(wt).
///
/// After a reversal the contact spring of stiffness K unloads from +F to -F over the travel 2F/K; sliding begins
/// when X (1 - cos wt) = 2F/K, at the speed
///   V_s = w X sin(wt) = 2 w sqrt(X F/K - (F/K)^2)                                     Eq (18)
///
/// Holds for a harmonic motion with F/K <= X; if F/K > X, the contact never slides.
/// Source: liang2004identifying. Cost: a square root.

#include <optional>

namespace dualdamp::sim::analytic {

/// V_s [m/s] for frequency w [rad/s], amplitude X [m], friction force F [N] and contact stiffness K [N/m], all > 0.
/// Nothing if the contact does not slide.
[[nodiscard]] std::optional<double> transition_velocity(double omega, double X, double F, double K);

/// The inverse of Eq (18), K = 2 F/(X - sqrt(X^2 - V_s^2/w^2)) [N/m]. It is the stiffer of the two solutions, for
/// which sliding begins in the first quarter of the forcing period (F/K <= X/2). Nothing if V_s exceeds the largest
/// speed w X.
[[nodiscard]] std::optional<double> contact_stiffness(double omega, double X, double F, double V_s);

}  // namespace dualdamp::sim::analytic
