#pragma once
/// Least squares over columns of very different lengths: they are scaled to unit length before the decomposition,
/// so that their units do not decide which of them count as dependent.

#include <Eigen/Core>

#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

/// Lengths of columns, to divide by. 1e-300: a column of zeros keeps its length of zero.
[[nodiscard]] inline Eigen::VectorXd lengths_of(const Eigen::MatrixXd& columns) {
  return columns.colwise().norm().cwiseMax(1e-300);
}

[[nodiscard]] inline Eigen::MatrixXd of_unit_length(const Eigen::MatrixXd& columns,
                                                    const Eigen::VectorXd& lengths) {
  return columns * lengths.cwiseInverse().asDiagonal();
}

class UnitColumns {
 public:
  explicit UnitColumns(const Eigen::MatrixXd& columns)
      : lengths_(lengths_of(columns)), unit_(of_unit_length(columns, lengths_)) {}

  /// Number of columns that are independent to rounding.
  [[nodiscard]] Eigen::Index rank() const { return unit_.rank(); }

  /// The x that minimises |columns x - values|; dependent columns get 0.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& values) const {
    return lengths_.cwiseInverse().asDiagonal() * unit_.solve(values);
  }

  /// Such an x for each column of `values`.
  [[nodiscard]] Eigen::MatrixXd solve_each(const Eigen::MatrixXd& values) const {
    return lengths_.cwiseInverse().asDiagonal() * unit_.solve_each(values);
  }

 private:
  Eigen::VectorXd lengths_;
  DependentColumns unit_;
};

}  // namespace dualdamp::identify
