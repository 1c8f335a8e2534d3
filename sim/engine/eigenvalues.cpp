#include "sim/engine/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

#include "core/constants.hpp"

namespace dualdamp::sim {

Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, false);
  if (solver.info() != Eigen::Success) return Eigen::VectorXcd::Constant(matrix.rows(), core::infinity);
  return solver.eigenvalues();
}

}  // namespace dualdamp::sim
