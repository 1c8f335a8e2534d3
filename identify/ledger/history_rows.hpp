#pragma once
/// Rows of the sensors of histories, as the joint model is made of them.

#include <Eigen/Core>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// Rows of one sensor over all tests: the residual first, then the base columns, then the relaxations.
struct Channel {
  Eigen::MatrixXd rows;
  std::vector<Eigen::Index> blocks;
  int most_lags = 0;  ///< over which its errors may still be alike

  void add(const Eigen::MatrixXd& more);
};

/// The rows with independent errors of unit variance, by what is left of the residual beside all columns.
[[nodiscard]] Eigen::MatrixXd made_white(const Channel& channel);

/// Means of `width` rows each; what is left over at the end is dropped.
[[nodiscard]] Eigen::MatrixXd averaged(const Eigen::MatrixXd& rows, Eigen::Index width);

/// d/dt of every column by central differences.
[[nodiscard]] Eigen::MatrixXd differentiated(const Eigen::MatrixXd& columns, double rate);

/// Sets to zero the rows within two samples of a reversal.
void leave_out_reversals(const Eigen::VectorXd& v, Eigen::MatrixXd& rows);

/// Rows of a history that are used: all, but of a free vibration those before its amplitude has fallen to 3 x_f.
/// The number of the swings after that, and the place of the rest, jump with the parameters.
[[nodiscard]] Eigen::Index moving_rows(const History& history, const Eigen::VectorXd& x, double x_f);

/// Standard deviation of the noise of a signal, its rounding to the steps of a converter included.
[[nodiscard]] double noise_of(const std::vector<double>& signal);

}  // namespace dualdamp::identify
