#pragma once
/// Within-sweep resonance method: one damping ratio for all sweeps, a Coulomb friction of its own for each.
///
///   x_ij = a_j + b Y_ij,   b = sum_j sum_i (Y_ij - mean_j Y)(x_ij - mean_j x)/sum_j sum_i (Y_ij - mean_j Y)^2
///   zeta = 1/(2 b),   x_f,j = -a_j/G(zeta)
///
/// The paper's sweeps lie on parallel lines, because its friction force drifted from one sweep to the next. With
/// parallel lines the drift does not affect zeta; with a single line it counts as scatter. The friction reported is
/// the mean over the sweeps.
///
/// Holds for small zeta near w = wn, without sticking, with errors in x alone and a friction that stays the same
/// within a sweep; at least two sweeps of two pairs. Uncertainty: b from the scatter about the parallel lines, of
/// N - J - 1 degrees of freedom for N pairs in J sweeps (or from `sigma_x`, `sigma_Y`); the mean friction from the
/// scatter of the sweeps, J - 1 degrees of freedom, and from b, the two combined after welch1947. Diagnostics:
/// pairs that stick are left out, an F test of a friction quadratic in x, an F test of separate slopes. Source:
/// liang2004identifying (the drift, section 4); the fit is the analysis of covariance, draper1998. Errors:
/// `outcome`. Cost: n log n.

#include "identify/method.hpp"

namespace dualdamp::identify {

struct WithinSweepOptions : ResonanceOptions {
  int bootstrap = 0;  ///< replicates by sweeps; 0: none

  static constexpr auto declared() {
    return std::tuple_cat(ResonanceOptions::declared(),
                          std::tuple{Use{&bootstrap_option, &WithinSweepOptions::bootstrap}});
  }
};

[[nodiscard]] Estimate resonance_within_sweep(const Record& record, const KnownConstants& constants,
                                              const WithinSweepOptions& options = {});

/// Why the record has no two sweeps of two pairs each; empty when it has.
[[nodiscard]] std::string lacks_sweeps(const Record& record);

extern const MethodEntry resonance_within_sweep_method;

}  // namespace dualdamp::identify
