#pragma once
/// Profile likelihood of zeta and F0: for each value of one of them, the best fit over the other.
///
///   D(theta) = min over the other parameter of (Q - Q_min)/s^2
///
/// with Q the weighted sum of squares and s^2 the variance of a datum. The 95 % interval is where D <= t^2 with
/// Student's quantile t (D is then an F statistic with one degree of freedom above). It follows the curvature of
/// the model, which an interval of +- t standard errors does not. The curve of the other parameter along it is the
/// ridge on which a change of one parameter compensates a change of the other. Source: bates1988 (chapter 6). Cost:
/// about 2,000 evaluations of the deviance.

#include <functional>

#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// (Q - Q_min)/s^2 at (zeta, x_f [m]); infinite where the model has no value.
using Deviance = std::function<double(double zeta, double x_f)>;

/// Adds the curves `profile_zeta` and `profile_F0` and the further parameters of these names with their likelihood
/// intervals. Warns if an end differs from that of the symmetric interval by more than a tenth of its width, or
/// does not exist. `half_width`: t. Does nothing if the estimate has no standard errors, or errors that are only
/// rounding.
void add_profiles(Estimate& estimate, const Deviance& deviance, double half_width, const KnownConstants& constants);

}  // namespace dualdamp::identify
