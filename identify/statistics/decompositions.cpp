#include "identify/statistics/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <limits>

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

namespace {

/// Below this share of the longest, what is left of a column of unit length beside others is rounding: columns of
/// one motion are computed by recurrences of many steps.
constexpr double rounding = 1e-12;

/// Lengths to divide columns by; 1 for a column of zeros.
Eigen::VectorXd lengths_of(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd norms = columns.colwise().norm();
  return (norms.array() > 0.0).select(norms, 1.0);
}

/// Columns of unit length: the units of columns do not decide which of them count as dependent.
Eigen::ColPivHouseholderQR<Eigen::MatrixXd> unit_factors(const Eigen::MatrixXd& columns,
                                                         const Eigen::VectorXd& lengths) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns * lengths.cwiseInverse().asDiagonal());
  qr.setThreshold(rounding);
  return qr;
}

}  // namespace

struct DependentColumns::Factors {
  explicit Factors(const Eigen::MatrixXd& columns)
      : lengths(lengths_of(columns)), qr(unit_factors(columns, lengths)) {}

  Eigen::VectorXd lengths;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
};

DependentColumns::DependentColumns(const Eigen::MatrixXd& columns)
    : factors_(columns.cols() == 0 ? nullptr : std::make_shared<const Factors>(columns)) {}

Eigen::Index DependentColumns::rank() const { return factors_ ? factors_->qr.rank() : 0; }

Eigen::VectorXd DependentColumns::solve(const Eigen::VectorXd& values) const { return solve_each(values); }

Eigen::MatrixXd DependentColumns::solve_each(const Eigen::MatrixXd& values) const {
  if (!factors_) return Eigen::MatrixXd(0, values.cols());
  const Eigen::VectorXd& lengths = factors_->lengths;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr = factors_->qr;
  if (!qr.matrixR().allFinite())
    return Eigen::MatrixXd::Constant(lengths.size(), values.cols(), std::numeric_limits<double>::quiet_NaN());
  // Eigen's own solution takes the columns beyond the rank too: it would fit values by rounding errors.
  const Eigen::Index rank = qr.rank();
  Eigen::MatrixXd solved = values;
  solved.applyOnTheLeft(qr.householderQ().setLength(rank).adjoint());
  Eigen::MatrixXd ordered = Eigen::MatrixXd::Zero(lengths.size(), values.cols());
  ordered.topRows(rank) =
      qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(solved.topRows(rank));
  return lengths.cwiseInverse().asDiagonal() * (qr.colsPermutation() * ordered);
}

Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values) {
  return matrix.completeOrthogonalDecomposition().solve(values);
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns, std::optional<double> threshold) {
  if (columns.cols() == 0) return Eigen::MatrixXd(columns.rows(), 0);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr = unit_factors(columns, lengths_of(columns));
  if (threshold) qr.setThreshold(*threshold);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), std::min(qr.rank(), columns.rows()));
}

Eigen::MatrixXd decorrelated(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& rows) {
  return Eigen::LLT<Eigen::MatrixXd>(covariance).matrixL().solve(rows);
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
