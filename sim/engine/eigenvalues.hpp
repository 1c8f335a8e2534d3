#pragma once
/// Eigenvalues of a real square matrix. One translation unit holds Eigen's solver, which takes seconds to compile.

#include <Eigen/Core>

namespace dualdamp::sim {

[[nodiscard]] Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix);

}  // namespace dualdamp::sim
