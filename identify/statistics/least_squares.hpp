#pragma once
/// Nonlinear least squares, shared by the methods that need it: Levenberg-Marquardt with bounds, by Ceres.
///
///   min_p sum_i r_i(p)^2,   low <= p <= high
///
/// Parameters should be of order one: scale them. Errors: `outcome`. Cost: tens of evaluations, also if bounds are
/// met.

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "core/outcome.hpp"

namespace dualdamp::identify {

struct LeastSquaresProblem {
  Eigen::Index residuals = 0;
  Eigen::VectorXd start;
  Eigen::VectorXd low;  ///< both empty: no bounds
  Eigen::VectorXd high;
  /// Relative decrease of the sum of squares at which the fit may end. 0: at rounding.
  double tolerance = 0.0;
  int most_iterations = 200;
  /// Within bounds: the search along a step uses the derivatives at its points. Dearer, but more of the bent
  /// valleys of a law are passed.
  bool slopes_along_steps = false;
  /// Fills the residuals, and their derivatives (residuals x parameters) if `jacobian` is not null. False: the
  /// model has no value at these parameters, and the step is shortened.
  std::function<bool(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian)>
      evaluate;
};

struct LeastSquaresFit {
  core::Outcome outcome;
  Eigen::VectorXd parameters;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  double sum_of_squares = 0.0;
};

[[nodiscard]] LeastSquaresFit fit(const LeastSquaresProblem& problem);

/// Covariance of the parameters for residuals of unit variance, (J^T J)^-1. Nothing if the data leave a direction
/// of the parameters undetermined; an empty matrix if there are no parameters.
[[nodiscard]] std::optional<Eigen::MatrixXd> unit_covariance(const Eigen::MatrixXd& jacobian);

}  // namespace dualdamp::identify
