#pragma once
/// Rows of the sensors of histories, as the joint model is made of them.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/ledger/history_terms.hpp"
#include "identify/ledger/innovations.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Rows of one sensor over all tests: the residual first, then the base columns, then the relaxations, then what
/// else is to be treated alike.
struct Channel {
  Eigen::MatrixXd rows;
  std::vector<Eigen::Index> blocks;
  int most_lags = 0;  ///< over which its errors may still be alike

  void add(const Eigen::MatrixXd& more);
};

/// Of each sensor in one test the residual, the base columns, the relaxations; no rows where it was not read.
struct SensorRows {
  Eigen::MatrixXd x, v, a;

  /// Further columns at the right.
  void append(const SensorRows& more);
};

/// The rows with independent errors of unit variance, by what is left of the residual beside the `columns` after
/// it.
[[nodiscard]] Eigen::MatrixXd made_white(const Channel& channel, Eigen::Index columns);

/// One below the other, all of one width.
[[nodiscard]] Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& parts);

/// The history with noise in its y and force once more, as strong as that which they have.
[[nodiscard]] History with_noisier_drive(History history);

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

/// Of the drive k y + f, and of readings.
[[nodiscard]] ReadingNoise noise_levels(const History& history, double k, const MotionScale& scale);

/// Why the motion of the histories cannot be simulated; empty when it can.
[[nodiscard]] std::string fault_of_histories(const Record& record);

}  // namespace dualdamp::identify
