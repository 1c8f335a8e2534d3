#include "identify/statistics/least_squares.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/cancellation.hpp"
#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"

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

/// Ends the solver early, because exceptions cannot pass through it.
class StopIfCancelled final : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    return core::cancellation_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }
};

/// One run of the solver from `parameters` to its end; the parameters numbered in `held` are constant.
ceres::Solver::Summary solve(const LeastSquaresProblem& problem, const std::vector<int>& held, int most_iterations,
                             Eigen::VectorXd& parameters) {
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new Cost(problem), nullptr, parameters.data());
  const auto size = static_cast<int>(parameters.size());
  for (int i = 0; i < size && problem.low.size() > 0; ++i) {
    ceres_problem.SetParameterLowerBound(parameters.data(), i, problem.low[i]);
    ceres_problem.SetParameterUpperBound(parameters.data(), i, problem.high[i]);
  }
  if (!held.empty()) ceres_problem.SetManifold(parameters.data(), new ceres::SubsetManifold(size, held));

  constexpr double rounding = 1e-14;  // of the sum of squares, relative
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  options.max_num_iterations = most_iterations;
  options.function_tolerance = std::max(problem.tolerance, rounding);
  options.gradient_tolerance = 0.0;
  options.parameter_tolerance = 1e-15;
  // Within bounds the solver searches along each step, by default at twenty points where rounding alone is left.
  options.max_num_line_search_step_size_iterations = 4;
  options.line_search_interpolation_type = problem.slopes_along_steps ? ceres::CUBIC : ceres::QUADRATIC;
  StopIfCancelled stop;
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  core::stop_if_cancelled();
  return summary;
}

struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

std::optional<Linearised> linearised(const LeastSquaresProblem& problem, const Eigen::VectorXd& parameters) {
  Linearised at{Eigen::VectorXd(problem.residuals), Eigen::MatrixXd(problem.residuals, parameters.size())};
  if (!problem.evaluate(parameters, at.residuals, &at.jacobian)) return std::nullopt;
  return at;
}

/// Sets to its bound each parameter that the linearised problem would move beyond it, and returns their numbers.
std::vector<int> take_to_bounds(const LeastSquaresProblem& problem, Eigen::VectorXd& parameters) {
  const auto at = linearised(problem, parameters);
  if (!at) return {};
  const Eigen::VectorXd wanted = parameters - pivoted_least_squares(at->jacobian, at->residuals);
  std::vector<int> taken;
  for (int i = 0; i < parameters.size(); ++i) {
    const double inside = std::clamp(wanted[i], problem.low[i], problem.high[i]);
    if (inside == wanted[i]) continue;
    parameters[i] = inside;
    taken.push_back(i);
  }
  return taken;
}

/// Would the sum of squares decrease beyond the bound of each of these parameters?
bool are_held(const LeastSquaresProblem& problem, const Eigen::VectorXd& parameters,
              const std::vector<int>& numbers) {
  const auto at = linearised(problem, parameters);
  return at && std::ranges::all_of(numbers, [&](int i) {
           const double gradient = at->jacobian.col(i).dot(at->residuals);
           return parameters[i] <= problem.low[i] ? gradient >= 0.0 : gradient <= 0.0;
         });
}

double squares(const LeastSquaresProblem& problem, const Eigen::VectorXd& parameters) {
  Eigen::VectorXd residuals(problem.residuals);
  if (!problem.evaluate(parameters, residuals, nullptr)) return core::infinity;
  return residuals.squaredNorm();
}

/// A run within bounds. The solver makes its steps for the whole space and cuts them off at a bound: along a bound
/// it needs a hundred steps instead of ten. Parameters that end at a bound are therefore held there, and released
/// if the sum of squares does not decrease beyond the bound. The linearised problem may lead to the wrong bound,
/// far from the minimum: where a few steps do not come below the place from which it was taken, that run is given
/// up. A run of a few steps is not continued so: it was asked for no more than these.
ceres::Solver::Summary solve(const LeastSquaresProblem& problem, Eigen::VectorXd& parameters) {
  const int most_iterations = problem.most_iterations;
  constexpr int first_iterations = 4;
  if (problem.low.size() == 0) return solve(problem, {}, most_iterations, parameters);
  ceres::Solver::Summary summary = solve(problem, {}, first_iterations, parameters);
  if (summary.termination_type == ceres::CONVERGENCE || most_iterations <= first_iterations) return summary;
  Eigen::VectorXd on_bounds = parameters;
  const std::vector<int> held = take_to_bounds(problem, on_bounds);
  if (!held.empty() && held.size() < static_cast<std::size_t>(parameters.size())) {
    const double before = squares(problem, parameters);
    summary = solve(problem, held, first_iterations, on_bounds);
    if (squares(problem, on_bounds) <= before) {
      if (summary.termination_type != ceres::CONVERGENCE)
        summary = solve(problem, held, most_iterations, on_bounds);
      if (summary.termination_type == ceres::CONVERGENCE && are_held(problem, on_bounds, held)) {
        parameters = on_bounds;
        return summary;
      }
    }
  }
  return solve(problem, {}, most_iterations, parameters);
}

/// Ceres writes to standard error when a fit reaches parameters at which the model has no value, whatever its
/// options are. The outcome says this already.
void keep_silent() {
  static const bool once = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace

LeastSquaresFit fit(const LeastSquaresProblem& problem) {
  keep_silent();
  LeastSquaresFit result;
  result.parameters = problem.start;
  result.residuals.resize(problem.residuals);
  if (!problem.evaluate(problem.start, result.residuals, nullptr)) {
    result.outcome = {core::OutcomeKind::not_identifiable, "the model has no value where the fit begins"};
    return result;
  }
  if (problem.start.size() == 0) {  // nothing is free: a record of steady states that a whole rig has to predict
    result.jacobian.resize(problem.residuals, 0);
    result.sum_of_squares = result.residuals.squaredNorm();
    return result;
  }
  const ceres::Solver::Summary summary = solve(problem, result.parameters);

  result.jacobian.resize(problem.residuals, problem.start.size());
  const bool has_value = problem.evaluate(result.parameters, result.residuals, &result.jacobian);
  // If only rounding is left, no step reduces the cost, which Ceres counts as a failure.
  const bool usable = summary.IsSolutionUsable() || (has_value && summary.num_successful_steps > 0);
  if (!usable || !has_value) result.outcome = {core::OutcomeKind::not_identifiable, "the fit did not converge"};
  result.sum_of_squares = result.residuals.squaredNorm();
  return result;
}

std::optional<Eigen::MatrixXd> unit_covariance(const Eigen::MatrixXd& jacobian) {
  if (jacobian.rows() < jacobian.cols()) return std::nullopt;
  if (jacobian.cols() == 0) return Eigen::MatrixXd(0, 0);
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
