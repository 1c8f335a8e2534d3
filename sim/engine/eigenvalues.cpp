#include "sim/engine/eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <complex>

#include "core/constants.hpp"

namespace dualdamp::sim {

Eigen::VectorXd balance(Eigen::MatrixXd& matrix) {
  constexpr double enough = 0.95;
  constexpr int most_sweeps = 100;
  const auto size_of = [](const auto& part, Eigen::Index i) { return part.cwiseAbs().sum() - std::abs(part[i]); };
  Eigen::VectorXd units = Eigen::VectorXd::Ones(matrix.rows());
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
      units[i] *= factor;
      changed = true;
    }
  }
  return units;
}

Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd balanced = matrix;
  balance(balanced);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(balanced, false);
  if (solver.info() != Eigen::Success) return Eigen::VectorXcd::Constant(matrix.rows(), core::infinity);
  return solver.eigenvalues();
}

std::optional<Modes> modes_of(Eigen::MatrixXd matrix, Eigen::VectorXd rate) {
  constexpr double solved = 1e-9;
  const Eigen::VectorXd units = balance(matrix);
  rate = rate.cwiseQuotient(units);
  const Eigen::VectorXd whole = matrix.completeOrthogonalDecomposition().solve(-rate);
  if (!((matrix * whole + rate).norm() <= solved * rate.norm())) return std::nullopt;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  Modes modes{.exponents = solver.eigenvalues(), .ways = solver.eigenvectors()};
  const Eigen::VectorXcd shares = modes.ways.partialPivLu().solve(whole.cast<std::complex<double>>());
  modes.ways = units.asDiagonal() * modes.ways * shares.asDiagonal();
  if (!modes.ways.allFinite()) return std::nullopt;
  return modes;
}

}  // namespace dualdamp::sim
