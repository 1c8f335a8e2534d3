#pragma once
/// The uncertainty of a fit: covariance, intervals, profiles, and the parameters that the data cannot separate
/// (`fit.hpp`).

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// The end of a search.
struct FitEnd {
  const FitProblem& problem;
  const Eigen::VectorXd& weights;              ///< 1/deviation of each row, bounded if the fit is robust
  const Eigen::VectorXd& unbounded;            ///< the same without the bound
  const Eigen::VectorXd& q;                    ///< coordinates
  const Eigen::VectorXd& misses;               ///< outputs - measured
  const Eigen::MatrixXd& jacobian;             ///< of the outputs by the coordinates
  const LastMotions& motions;                  ///< at `q`
  const std::vector<Eigen::VectorXd>& rivals;  ///< coordinates of other minima that fit nearly as well
  bool profile = true;
  bool robust = false;
};

/// Sets standard deviations, intervals, bounds, trade-offs, covariance, undetermined directions and slopes of
/// `fit`. Returns coordinates with a smaller sum of squares if a profile found any; the search must then continue
/// from there.
[[nodiscard]] std::optional<Eigen::VectorXd> add_uncertainty(const FitEnd& end, Fit& fit);

}  // namespace dualdamp::identify
