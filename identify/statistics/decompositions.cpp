#include "identify/statistics/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

namespace dualdamp::identify {

Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(columns).solve(values);
}

Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns).solve(values);
}

Eigen::VectorXd left_beside(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return values - columns * pivoted_least_squares(columns, values);
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns, std::optional<double> threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  if (threshold) qr.setThreshold(*threshold);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), std::min(qr.rank(), columns.rows()));
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) { return matrix.inverse(); }

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace dualdamp::identify
