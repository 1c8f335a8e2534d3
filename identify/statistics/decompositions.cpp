#include "identify/statistics/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

namespace dualdamp::identify {

Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(columns).solve(values);
}

LinearFit linear_fit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::Index count = columns.cols();
  LinearFit fit{qr.solve(values), Eigen::VectorXd(count)};
  // The length of the k-th row of the inverse of R is the deviation of the k-th coefficient.
  const Eigen::MatrixXd R = qr.matrixQR().topRows(count).triangularView<Eigen::Upper>();
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(count, k);
    fit.deviations[k] = R.transpose().triangularView<Eigen::Lower>().solve(unit).norm();
  }
  return fit;
}

Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return DependentColumns(columns).solve(values);
}

Eigen::VectorXd left_beside(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return values - columns * pivoted_least_squares(columns, values);
}

struct DependentColumns::Factors {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
};

DependentColumns::DependentColumns(const Eigen::MatrixXd& columns)
    : factors_(columns.cols() == 0
                   ? nullptr
                   : std::make_shared<const Factors>(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns))) {}

Eigen::Index DependentColumns::rank() const { return factors_ ? factors_->qr.rank() : 0; }

Eigen::VectorXd DependentColumns::solve(const Eigen::VectorXd& values) const { return solve_each(values); }

Eigen::MatrixXd DependentColumns::solve_each(const Eigen::MatrixXd& values) const {
  if (!factors_) return Eigen::MatrixXd(0, values.cols());
  return factors_->qr.solve(values);
}

Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values) {
  return matrix.completeOrthogonalDecomposition().solve(values);
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns, std::optional<double> threshold) {
  if (columns.cols() == 0) return Eigen::MatrixXd(columns.rows(), 0);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  if (threshold) qr.setThreshold(*threshold);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), std::min(qr.rank(), columns.rows()));
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) { return matrix.inverse(); }

struct DefiniteMatrix::Factors {
  Eigen::LDLT<Eigen::MatrixXd> ldlt;
};

DefiniteMatrix::DefiniteMatrix(const Eigen::MatrixXd& matrix)
    : factors_(std::make_shared<const Factors>(Eigen::LDLT<Eigen::MatrixXd>(matrix))) {}

bool DefiniteMatrix::is_regular() const { return factors_->ldlt.info() == Eigen::Success; }

Eigen::VectorXd DefiniteMatrix::solve(const Eigen::VectorXd& right) const { return solve_each(right); }

Eigen::MatrixXd DefiniteMatrix::solve_each(const Eigen::MatrixXd& right) const {
  return factors_->ldlt.solve(right);
}

Eigen::MatrixXd DefiniteMatrix::inverse() const {
  const Eigen::Index size = factors_->ldlt.rows();
  return solve_each(Eigen::MatrixXd::Identity(size, size));
}

Eigen::MatrixXd gram(const Eigen::MatrixXd& rows) { return rows.transpose() * rows; }

Eigen::MatrixXd propagated(const Eigen::MatrixXd& linear, const Eigen::MatrixXd& covariance) {
  return linear * covariance * linear.transpose();
}

Eigen::MatrixXd in_units(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& units) {
  return units.asDiagonal() * matrix * units.asDiagonal();
}

Eigen::MatrixXd product(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) { return left * right; }

double variance_along(const Eigen::VectorXd& direction, const Eigen::MatrixXd& covariance) {
  return direction.transpose() * covariance * direction;
}

Eigen::MatrixXd projector_beside(const Eigen::MatrixXd& basis) {
  return Eigen::MatrixXd::Identity(basis.rows(), basis.rows()) - basis * basis.transpose();
}

Eigen::MatrixXd SymmetricSpectrum::matrix_with(const Eigen::VectorXd& others) const {
  return vectors * others.asDiagonal() * vectors.transpose();
}

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace dualdamp::identify
