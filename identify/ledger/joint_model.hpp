#pragma once
/// One model of a whole record, linearised at its best fit: what the ledger's tests are made of.
///
///   r = B d + C g + e,   e of unit variance, independent
///
/// r: residuals of the fit, each over its standard deviation. B: a column for each parameter that is always free
/// (zeta and F0 first). C: a column for each relaxation, one way in which an assumption may fail.

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "identify/assumption.hpp"
#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct Relaxation {
  Assumption assumption = Assumption::constants;
  std::string test;  ///< "natural frequency free", ...: what is set free
  int sign = 0;      ///< that the coefficient of such a departure has; 0: either
};

/// What was read.
enum class ReadingKind { amplitude, phase, extreme, time };

/// The reading behind a row.
struct Reading {
  ReadingKind kind = ReadingKind::amplitude;
  int number = 0;              ///< of the pair or of the extreme, from 1
  double per_deviation = 0.0;  ///< change of the reading that raises the row's residual by one; 0: no reading
};

struct JointModel {
  std::string data;  ///< "24 steady states"
  Eigen::VectorXd residuals;
  std::vector<Reading> readings;  ///< of each row; empty where rows are means of many
  Eigen::MatrixXd base;
  std::vector<Relaxation> relaxations;
  Eigen::MatrixXd relaxed;  ///< a column for each relaxation
  /// Residuals, base and relaxed side by side, where the drive has its noise twice; empty: noise is in r alone. The
  /// columns are derivatives of the motion under the drive as measured, so its noise is in them and in r alike.
  Eigen::MatrixXd shaken = {};
  /// By how much the friction force of a part of the record is off the mean, F0, for a unit of each relaxation [N];
  /// empty: none sets one free.
  Eigen::VectorXd F0_parts = {};
  Eigen::VectorXd zeta_parts = {};  ///< the same of the damping ratio
  /// Relaxations without a column, which change the record in the second order only: not tested, and fitted where a
  /// departure is to be explained.
  std::vector<std::size_t> hidden = {};
  /// Degrees of freedom that went into the residuals beside the columns: deviations of channels.
  double spent = 0.0;
  double deviance = unknown;   ///< twice the negative log-likelihood, to compare fits of the record; NaN: not known
  double scale_freedom = 0.0;  ///< degrees of freedom behind the deviation that decides about friction
  ParameterSet value;          ///< of the fit
  KnownConstants constants;    ///< as stated, or as fitted
  /// The model linearised where these relaxations are fitted, too; empty: it is as good where it is.
  std::function<JointModel(const std::vector<std::size_t>& taken)> refit;
  std::vector<std::string>
      left_out;  ///< parts of the record that are outside the tests' conditions, each a sentence
};

/// The columns of the base parameters and of the relaxations taken, these last.
[[nodiscard]] Eigen::MatrixXd free_columns(const Eigen::MatrixXd& base, const Eigen::MatrixXd& relaxed,
                                           const std::vector<std::size_t>& taken);

}  // namespace dualdamp::identify
