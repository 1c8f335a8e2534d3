#pragma once
/// Errors of readings that last from row to row, beside a regression.

#include <Eigen/Core>
#include <vector>

#include "identify/statistics/autoregression.hpp"

namespace dualdamp::identify {

/// The regression whose errors are sought.
struct Regression {
  const Eigen::MatrixXd& columns;  ///< may be dependent
  const Eigen::VectorXd& target;
  const std::vector<Eigen::Index>& blocks;      ///< rows at which another record begins; 0 may be left out
  const std::vector<Eigen::VectorXd>& at_rest;  ///< readings of a mass at rest, with the same errors about a mean
  int most_lags = 0;
};

struct LastingErrors {
  Autoregression autoregression;
  double scatter = 0.0;  ///< standard deviation
  double freedom = 0.0;  ///< degrees of freedom behind their power at low frequencies; infinity: none last
};

/// Restricted likelihood. Cost: a QR decomposition of the columns; where errors last, some ten times that of
/// multiplying all columns with each other.
[[nodiscard]] LastingErrors lasting_errors(const Regression& regression);

}  // namespace dualdamp::identify
