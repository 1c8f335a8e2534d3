#pragma once
/// Comparing estimates obtained with different springs, and averaging repeated ones.
///
/// If the damping coefficient c and the friction force F0 stay the same, a change of stiffness from k1 to k2 turns
/// zeta = c/(2 sqrt(m k)) and x_f = F0/k into
///   zeta_2 = zeta_1 sqrt(k1/k2),   x_f2 = x_f1 k1/k2.
/// Holds if c and F0 depend neither on frequency nor on amplitude, which a change of spring changes as well.
/// Source: liang2004identifying. Errors: none; k1, k2 > 0 and a list that is not empty are preconditions.

#include <vector>

namespace dualdamp::identify {

/// The two numbers that a vibration test gives.
struct Friction {
  double zeta = 0.0;  ///< -
  double x_f = 0.0;   ///< m
};

/// An estimate with stiffness k1 [N/m], converted to the same contact with stiffness k2 [N/m].
[[nodiscard]] Friction transfer_stiffness(const Friction& friction, double k1, double k2);

/// Arithmetic means.
[[nodiscard]] Friction mean(const std::vector<Friction>& estimates);

}  // namespace dualdamp::identify
