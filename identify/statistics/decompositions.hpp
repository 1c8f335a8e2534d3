#pragma once
/// Linear algebra by Eigen's decompositions, in one translation unit, because each takes seconds to compile. A
/// decomposition whose factors are used again, or whose right-hand side is a matrix, stands where it is used.

#include <Eigen/Core>
#include <optional>

namespace dualdamp::identify {

/// The x that minimises |columns x - values|, by Householder's QR. Columns must be independent, with at least as
/// many rows as columns. Cost: 2 rows columns^2 operations.
[[nodiscard]] Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// The same for columns that may be nearly dependent, by column pivoting: dependent columns get 0.
[[nodiscard]] Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// What columns, which may be nearly dependent, leave of values: values - columns x with the x of least squares.
[[nodiscard]] Eigen::VectorXd left_beside(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// An orthonormal basis of what the columns span, by QR with column pivoting: columns that are dependent to
/// `threshold` of the largest, or to rounding, add nothing.
[[nodiscard]] Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns,
                                                std::optional<double> threshold = std::nullopt);

/// Inverse of a square matrix that is not singular, by LU.
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix);

/// Eigenvalues, from the least to the largest, and orthonormal eigenvectors as columns.
struct SymmetricSpectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Spectrum of a symmetric matrix; only its lower triangle is read.
[[nodiscard]] SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix);

}  // namespace dualdamp::identify
