#pragma once
/// Tests whether one rig made both the record that was fitted (A) and another record (B).
///
///   T = min over p of [ (p - p_A)^T C_A^-1 (p - p_A) + D_B(p) ] - min over p of D_B(p)
///   D_B(p) = sum over signals of  (n'/n) sum_i [(output_i(p) - measured_i)/s]^2
///
/// T is the likelihood ratio of one rig to two. The likelihood of A is approximated by its estimate p_A and
/// covariance C_A, in the coordinates of the search (logarithms of positive parameters). s is the deviation of the
/// residuals of the rig fitted to B alone, or the stated noise; n' of the n samples count as independent. For one
/// rig and normal errors, T is chi-square; its degrees of freedom f are the number of parameters that A determines.
/// If the deviations are estimated, T/f is Fisher's F. The parameters of B itself, such as its first state, are
/// free in both terms. A parameter that A does not determine may have any value. If A determines only sums of
/// parameters, C_A^-1 is zero along the directions that A does not determine. B may then lead far away from p_A,
/// where such a direction is straight in the values (forces that add up) or in their logarithms (factors). T is the
/// smaller one of the two.
///
/// Source: wilks1938. Errors: `p_value` is `unknown` if A determines no parameter or B does not determine the rig.
/// Cost: nine motions and up to two short searches. A search is skipped if T at its start, an upper bound, already
/// has a chance of 0.2.

#include <Eigen/Core>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A fit to record A.
struct KnownRig {
  const Rig& rig;                               ///< with the fitted values
  const std::vector<FitParameter>& parameters;  ///< those of the rig; `stated` is the fitted value
  const SharedUncertainty& uncertainty;         ///< of these parameters
};

struct Compromise {
  double statistic = unknown;  ///< T
  double freedom = 0.0;
  double p_value = unknown;
};

/// Parameters of the rig, and then those of the records themselves, each stated as the fit `held` has it.
[[nodiscard]] std::vector<FitParameter> with_own_parameters(std::vector<FitParameter> shared, const Fit& held);

/// `held`: fit of B with the rig held fixed. `alone`: fit of B with the parameters of the rig and those of B
/// itself.
[[nodiscard]] Compromise compromise_of(const KnownRig& known, const Experiments& second, const Fit& held,
                                       const Fit& alone);

}  // namespace dualdamp::identify
