#pragma once
/// Eigenvalues and modes of a real square matrix. One translation unit holds Eigen's solver, which takes seconds to
/// compile.

#include <Eigen/Core>
#include <optional>

namespace dualdamp::sim {

/// Scales the coordinates by powers of two until rows and columns have similar sizes; returns the new units. The
/// error of a computation with a matrix is relative to its largest entry: in m and m/s an entry may be 1e17 times
/// another one, and both matter.
Eigen::VectorXd balance(Eigen::MatrixXd& matrix);

/// Infinite if the solver does not converge, for example for a matrix that is not finite: a map whose Floquet
/// multipliers are not known must not count as attracting.
[[nodiscard]] Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix);

/// The way on which z' = matrix z + rate goes from z = 0 towards the place where it stays, mode by mode: mode k
/// contributes (1 - exp(exponents[k] t)) times column k of `ways`.
struct Modes {
  Eigen::VectorXcd exponents;
  Eigen::MatrixXcd ways;
};
/// None if it stays nowhere, or if the solver does not converge.
[[nodiscard]] std::optional<Modes> modes_of(Eigen::MatrixXd matrix, Eigen::VectorXd rate);

}  // namespace dualdamp::sim
