#include "sim/engine/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace dualdamp::sim {

Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix) { return matrix.eigenvalues(); }

}  // namespace dualdamp::sim
