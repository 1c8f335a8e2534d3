#pragma once
/// Makes errors independent that are correlated from sample to sample, by an autoregression.
///
///   e_t = a_1 e_(t-1) + ... + a_p e_(t-p) + s n_t,   n of unit variance
///
/// by the equations of Yule and Walker, the order p by Schwarz's criterion (schwarz1978). The rows of a regression
/// with such errors, filtered by 1 - a_1 B - ... - a_p B^p and divided by s, have independent errors of unit
/// variance (box2016). Cost: p times that of reading the rows.

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace dualdamp::identify {

struct Autoregression {
  Eigen::VectorXd coefficients;  ///< a_1 ... a_p; empty: independent errors
  double deviation = 1.0;        ///< s
};

/// First row and last row + 1 of each record, in `count` rows. `blocks`: rows at which another record begins; 0 may
/// be left out.
[[nodiscard]] std::vector<std::pair<Eigen::Index, Eigen::Index>> block_ranges(
    const std::vector<Eigen::Index>& blocks, Eigen::Index count);

/// Mean products of errors at lags 0 ... most. `blocks`: rows at which another record begins; errors of different
/// records are uncorrelated; 0 may be left out. `freedom`: divisor of the sums.
[[nodiscard]] Eigen::VectorXd covariances_of(const Eigen::VectorXd& errors, const std::vector<Eigen::Index>& blocks,
                                             int most, double freedom);

/// The covariances of as many errors that follow one another.
[[nodiscard]] Eigen::MatrixXd toeplitz(const Eigen::VectorXd& covariances);

/// The autoregression from covariances at lags 0 ... largest order. `count`: number of rows, for the choice of p.
[[nodiscard]] Autoregression autoregression_of(const Eigen::VectorXd& covariances, double count);

/// The rows with independent errors. The first p rows of each block are dropped, or all if it has no more.
[[nodiscard]] Eigen::MatrixXd whitened(const Eigen::MatrixXd& rows, const std::vector<Eigen::Index>& blocks,
                                       const Autoregression& autoregression);

}  // namespace dualdamp::identify
