#pragma once
/// Eigenvalues of a real square matrix. One translation unit holds Eigen's solver, which takes seconds to compile.

#include <Eigen/Core>

namespace dualdamp::sim {

/// Infinite if the solver does not converge, for example for a matrix that is not finite: a map whose Floquet
/// multipliers are not known must not count as attracting.
[[nodiscard]] Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix);

}  // namespace dualdamp::sim
