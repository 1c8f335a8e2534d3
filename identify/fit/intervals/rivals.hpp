#pragma once
/// Other minima of a fit, whose sum of squares is no higher than the noise may make it.
///
/// The profile of a parameter leaves the estimate along one valley. Where the sum of squares has several minima,
/// the values at another one, and near it, belong to the 95 % interval too:
///
///   growth(rival) + [(p - p_rival)/deviation]^2 <= limit^2
///
/// `growth`: of the sum of squares, from that of the estimate. `deviation`: by the derivatives at the rival.

#include <Eigen/Core>

#include "identify/fit/fit.hpp"
#include "identify/fit/intervals/uncertainty.hpp"

namespace dualdamp::identify {

/// Widens the intervals and profiles of `fit` by the rivals of its end, and warns of those that are outside of
/// them. `limits`: of each parameter, of the square root of the growth. `variance`: of a weighted residual.
/// Parameters without an interval get none.
void add_rivals(const FitEnd& end, const Eigen::VectorXd& limits, double variance, Fit& fit);

}  // namespace dualdamp::identify
