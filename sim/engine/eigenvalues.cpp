#include "sim/engine/eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/constants.hpp"

namespace dualdamp::sim {

namespace {

/// Scales the coordinates by powers of two until rows and columns have similar sizes. The solver's
/// error is relative to the largest entry: in m and m/s an entry may be 1e17 times another one, and both matter.
Eigen::MatrixXd balanced(Eigen::MatrixXd matrix) {
  constexpr double enough = 0.95;
  constexpr int most_sweeps = 100;
  const auto size_of = [](const auto& part, Eigen::Index i) { return part.cwiseAbs().sum() - std::abs(part[i]); };
  bool changed = matrix.allFinite();
  for (int sweep = 0; changed && sweep < most_sweeps; ++sweep) {
    changed = false;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      const double column = size_of(matrix.col(i), i);
      const double row = size_of(matrix.row(i), i);
      if (!(column > 0.0) || !(row > 0.0)) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (column * factor + row / factor >= enough * (column + row)) continue;
      matrix.col(i) *= factor;
      matrix.row(i) /= factor;
      changed = true;
    }
  }
  return matrix;
}

}  // namespace

Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(balanced(matrix), false);
  if (solver.info() != Eigen::Success) return Eigen::VectorXcd::Constant(matrix.rows(), core::infinity);
  return solver.eigenvalues();
}

}  // namespace dualdamp::sim
