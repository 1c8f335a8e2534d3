#include "identify/least_squares.hpp"

#include <ceres/ceres.h>

#include <Eigen/QR>
#include <cmath>

namespace dualdamp::identify {

namespace {

class Cost final : public ceres::CostFunction {
 public:
  explicit Cost(const LeastSquaresProblem& problem)
      : problem_(problem), residuals_(problem.residuals), jacobian_(problem.residuals, problem.start.size()) {
    set_num_residuals(static_cast<int>(problem.residuals));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.start.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd p = Eigen::Map<const Eigen::VectorXd>(parameters[0], problem_.start.size());
    const bool derivative = jacobians != nullptr && jacobians[0] != nullptr;
    if (!problem_.evaluate(p, residuals_, derivative ? &jacobian_ : nullptr)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, residuals_.size()) = residuals_;
    if (derivative)
      for (Eigen::Index i = 0; i < jacobian_.rows(); ++i)
        for (Eigen::Index j = 0; j < jacobian_.cols(); ++j)
          jacobians[0][i * jacobian_.cols() + j] = jacobian_(i, j);
    return true;
  }

 private:
  const LeastSquaresProblem& problem_;
  mutable Eigen::VectorXd residuals_;
  mutable Eigen::MatrixXd jacobian_;
};

}  // namespace

LeastSquaresFit fit(const LeastSquaresProblem& problem) {
  LeastSquaresFit result;
  result.parameters = problem.start;
  const auto size = static_cast<int>(problem.start.size());
  result.residuals.resize(problem.residuals);
  if (!problem.evaluate(problem.start, result.residuals, nullptr)) {  // Ceres would log it on standard error
    result.outcome = {core::OutcomeKind::not_identifiable, "the model has no value where the fit begins"};
    return result;
  }
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new Cost(problem), nullptr, result.parameters.data());
  for (int i = 0; i < size && problem.low.size() > 0; ++i)
    ceres_problem.SetParameterLowerBound(result.parameters.data(), i, problem.low[i]);
  for (int i = 0; i < size && problem.high.size() > 0; ++i)
    ceres_problem.SetParameterUpperBound(result.parameters.data(), i, problem.high[i]);

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  options.max_num_iterations = 200;
  options.function_tolerance = problem.tolerance;
  options.gradient_tolerance = 0.0;
  options.parameter_tolerance = 1e-15;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);

  result.jacobian.resize(problem.residuals, size);
  const bool has_value = problem.evaluate(result.parameters, result.residuals, &result.jacobian);
  // Where rounding is all that is left no step reduces the cost any more, which Ceres counts as a failure.
  const bool usable = summary.IsSolutionUsable() || (has_value && summary.num_successful_steps > 0);
  if (!usable || !has_value) result.outcome = {core::OutcomeKind::not_identifiable, "the fit did not converge"};
  result.sum_of_squares = result.residuals.squaredNorm();
  return result;
}

std::optional<Eigen::MatrixXd> unit_covariance(const Eigen::MatrixXd& jacobian) {
  if (jacobian.rows() < jacobian.cols()) return std::nullopt;
  const Eigen::VectorXd scale = jacobian.colwise().norm();
  if (!(scale.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  const Eigen::Index size = jacobian.cols();
  const Eigen::MatrixXd R = qr.matrixR().topRows(size);
  constexpr double singular = 1e-13;  // below this a direction rests on rounding
  if (!(std::abs(R(size - 1, size - 1)) > singular * std::abs(R(0, 0)))) return std::nullopt;
  const Eigen::MatrixXd inverse = R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(size, size));
  const Eigen::MatrixXd root = scale.cwiseInverse().asDiagonal() * (qr.colsPermutation() * inverse);
  return root * root.transpose();
}

}  // namespace dualdamp::identify
