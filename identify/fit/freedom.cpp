#include "identify/fit/freedom.hpp"

#include <algorithm>
#include <cstddef>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

std::vector<double> freedoms_of(const FitProblem& problem, const Eigen::MatrixXd& rows) {
  std::vector<Eigen::Index> effective;
  for (Eigen::Index j = 0; j < rows.cols(); ++j)
    if (rows.col(j).norm() > 0.0) effective.push_back(j);
  constexpr double dependent = 1e-6;
  const Eigen::MatrixXd basis = orthonormal_basis(rows(Eigen::all, effective).colwise().normalized(), dependent);
  std::vector<double> freedoms;
  for (const SignalRows& signal : problem.readings().signals()) {
    const double spent = basis.middleRows(signal.begin, signal.size()).squaredNorm();
    freedoms.push_back(std::max(0.0, problem.readings().count(signal) - spent));
  }
  return freedoms;
}

double joint_freedom(const std::vector<double>& variances, const std::vector<double>& freedoms) {
  double total = 0.0;
  double sum = 0.0;
  for (std::size_t s = 0; s < variances.size(); ++s) {
    total += variances[s];
    sum += variances[s] * variances[s] / freedoms[s];
  }
  return sum > 0.0 ? total * total / sum : core::infinity;
}

Eigen::MatrixXd doubt_of_weights(const Eigen::MatrixXd& normal_of_signal, const Eigen::MatrixXd& inverse_of_all,
                                 double freedom) {
  const double variance = freedom > 1.0 ? 2.0 / freedom : 2.0;
  return 2.0 * variance * (normal_of_signal - product(product(normal_of_signal, inverse_of_all), normal_of_signal));
}

}  // namespace dualdamp::identify
