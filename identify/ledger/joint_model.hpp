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

namespace dualdamp::identify {

struct Relaxation {
  Assumption assumption = Assumption::constants;
  std::string test;  ///< "natural frequency free", ...: what is set free
};

struct JointModel {
  std::string data;  ///< "24 steady states"
  Eigen::VectorXd residuals;
  Eigen::MatrixXd base;
  std::vector<Relaxation> relaxations;
  Eigen::MatrixXd relaxed;  ///< a column for each relaxation
  /// Degrees of freedom that went into the residuals beside the columns: deviations of channels.
  double spent = 0.0;
  double scale_freedom = 0.0;  ///< degrees of freedom behind the deviation that decides about friction
  ParameterSet value;          ///< of the fit
  /// The model linearised where these relaxations are fitted, too; empty: it is as good where it is.
  std::function<JointModel(const std::vector<std::size_t>& taken)> refit;
  std::vector<std::string>
      left_out;  ///< parts of the record that are outside the tests' conditions, each a sentence
};

}  // namespace dualdamp::identify
