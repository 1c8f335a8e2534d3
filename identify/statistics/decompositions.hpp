#pragma once
/// Linear algebra by Eigen's decompositions and products of matrices, in one translation unit, because each takes
/// seconds to compile.

#include <Eigen/Core>
#include <memory>
#include <optional>

namespace dualdamp::identify {

/// The x that minimises |columns x - values|, by Householder's QR. Columns must be independent, with at least as
/// many rows as columns. Cost: 2 rows columns^2 operations.
[[nodiscard]] Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

struct LinearFit {
  Eigen::VectorXd coefficients;
  Eigen::VectorXd deviations;  ///< of the coefficients, for values with independent errors of deviation 1
};

/// Linear least squares with the standard deviations of the coefficients.
[[nodiscard]] LinearFit linear_fit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// The x that minimises |columns x - values| for columns that may be nearly dependent, by column pivoting:
/// dependent columns get 0. There may be no column.
[[nodiscard]] Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// What columns, which may be nearly dependent, leave of values: values - columns x with the x of least squares.
[[nodiscard]] Eigen::VectorXd left_beside(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// Least squares over columns that may be nearly dependent, for several targets: one decomposition serves all. What
/// counts as dependent does not depend on the units of columns. A column that is not finite makes the solution so.
class DependentColumns {
 public:
  explicit DependentColumns(const Eigen::MatrixXd& columns);

  /// Number of columns that are independent to rounding.
  [[nodiscard]] Eigen::Index rank() const;

  /// The x that minimises |columns x - values|; dependent columns get 0.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& values) const;

  /// Such an x for each column of `values`.
  [[nodiscard]] Eigen::MatrixXd solve_each(const Eigen::MatrixXd& values) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;  ///< null: there is no column
};

/// The shortest of the x that minimise |matrix x - values|, for a matrix of any rank.
[[nodiscard]] Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values);

/// An orthonormal basis of what the columns span, by QR with column pivoting: columns that are dependent to
/// `threshold`, or to rounding, add nothing, whatever their units. No columns have an empty basis.
[[nodiscard]] Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns,
                                                std::optional<double> threshold = std::nullopt);

/// L^-1 rows, where L L^T is the covariance of their errors, by Cholesky: their errors are independent.
[[nodiscard]] Eigen::MatrixXd decorrelated(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& rows);

/// Inverse of a square matrix that is not singular, by LU.
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix);

/// Factors L D L^T of a symmetric matrix that is positive definite, or nearly so; only its lower triangle is read.
class DefiniteMatrix {
 public:
  explicit DefiniteMatrix(const Eigen::MatrixXd& matrix);

  /// False where the decomposition failed.
  [[nodiscard]] bool is_regular() const;

  /// The x of matrix x = right.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

  /// The x of matrix x = right for each column of `right`.
  [[nodiscard]] Eigen::MatrixXd solve_each(const Eigen::MatrixXd& right) const;

  [[nodiscard]] Eigen::MatrixXd inverse() const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// rows^T rows: the products of all columns with each other.
[[nodiscard]] Eigen::MatrixXd gram(const Eigen::MatrixXd& rows);

/// linear covariance linear^T: the covariance of linear x where x has `covariance`.
[[nodiscard]] Eigen::MatrixXd propagated(const Eigen::MatrixXd& linear, const Eigen::MatrixXd& covariance);

/// units matrix units, with the diagonal matrix of `units`.
[[nodiscard]] Eigen::MatrixXd in_units(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& units);

/// left right.
[[nodiscard]] Eigen::MatrixXd product(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right);

/// direction^T covariance direction.
[[nodiscard]] double variance_along(const Eigen::VectorXd& direction, const Eigen::MatrixXd& covariance);

/// The projector on what is orthogonal to the columns of `basis`, which are orthonormal.
[[nodiscard]] Eigen::MatrixXd projector_beside(const Eigen::MatrixXd& basis);

/// Eigenvalues, from the least to the largest, and orthonormal eigenvectors as columns.
struct SymmetricSpectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;

  /// The matrix with these eigenvectors and other eigenvalues.
  [[nodiscard]] Eigen::MatrixXd matrix_with(const Eigen::VectorXd& others) const;
};

/// Spectrum of a symmetric matrix; only its lower triangle is read.
[[nodiscard]] SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix);

}  // namespace dualdamp::identify
