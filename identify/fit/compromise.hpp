#pragma once
/// One rig against two: whether one set of numbers is right for the record that was fitted (A) and for another (B).
///
///   T = min over p of [ (p - p_A)^T C_A^-1 (p - p_A) + D_B(p) ] - min over p of D_B(p)
///   D_B(p) = sum over signals of  (n'/n) sum_i [(output_i(p) - measured_i)/s]^2
///
/// the likelihood ratio of two rigs to one, with A's likelihood by its estimate p_A and covariance C_A, both in the
/// coordinates of the search (logarithms of positive numbers). s: what the rig fitted to B alone leaves, or the
/// stated noise; n' of the n samples count as independent. Of one rig and normal errors T is chi-square with as
/// many degrees of freedom as parameters that A knows; of deviations that were estimated T/f is Fisher's F. What B
/// has of its own, its first state, is free in both. A parameter that A does not know takes any value.
///
/// Source: wilks1938. Errors: `p_value` is unknown where A knows nothing, or B is not determined. Cost: nine
/// motions; two short searches unless one of these has a chance of 0.2 already, whose T is an upper bound.

#include <Eigen/Core>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A fit to record A.
struct KnownRig {
  const Rig& rig;                               ///< with the fitted values
  const std::vector<FitParameter>& parameters;  ///< shared ones, `stated` at their fitted values
  const Eigen::MatrixXd& covariance;            ///< of these
};

struct Compromise {
  double statistic = unknown;  ///< T
  double freedom = 0.0;
  double p_value = unknown;
};

/// `held`: fit of B with the rig held; `alone`: the rig fitted to B, its parameters the shared ones and B's own.
[[nodiscard]] Compromise compromise_of(const KnownRig& known, const Experiments& second, const Fit& held,
                                       const Fit& alone);

}  // namespace dualdamp::identify
