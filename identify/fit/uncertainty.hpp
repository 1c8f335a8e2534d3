#pragma once
/// How well a fit knows its parameters: covariance, intervals, profile, and what the data cannot tell apart
/// (`fit.hpp`).

#include <Eigen/Core>
#include <optional>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A fit at its end.
struct FitEnd {
  const FitProblem& problem;
  const Eigen::VectorXd& weights;   ///< 1/deviation of each row, bounded where the fit is robust
  const Eigen::VectorXd& q;         ///< coordinates
  const Eigen::VectorXd& misses;    ///< outputs - measured
  const Eigen::MatrixXd& jacobian;  ///< of the outputs by the coordinates
  bool profile = true;
  bool robust = false;
};

/// Samples that count as independent: N/(1 + 2 sum of the autocorrelation, with Bartlett's weights).
[[nodiscard]] double independent_samples(const Eigen::VectorXd& residuals, bool is_sampled);

/// Fills in deviations, intervals, bounds, trade-offs, covariance and slopes of `fit`. Where a profile comes by a
/// place with a smaller sum of squares it gives that: the search has to go on from there.
[[nodiscard]] std::optional<Eigen::VectorXd> add_uncertainty(const FitEnd& end, Fit& fit);

}  // namespace dualdamp::identify
