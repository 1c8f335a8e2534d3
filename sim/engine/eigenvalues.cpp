#include "sim/engine/eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

namespace dualdamp::sim {

Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, false);
  if (solver.info() != Eigen::Success)
    return Eigen::VectorXcd::Constant(matrix.rows(), std::numeric_limits<double>::quiet_NaN());
  return solver.eigenvalues();
}

}  // namespace dualdamp::sim
