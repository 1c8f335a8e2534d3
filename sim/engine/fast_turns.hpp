#pragma once
/// Perturbations that turn many times within a part of a step, by the exponential of the Jacobian (the first two
/// terms of Magnus' series, blanes2009):
///
///   u(1) = exp(B0 + [B1, B0]) u(0),   B0 = int J ds,   B1 = int (s - 1/2) J ds,   0 <= s <= 1.
///
/// It is exact for any number of turns where J is constant, as under laws that are affine in each mode. Elsewhere
/// the second term tells the error: a part in which it changes a column by more than 1e-5 is too long. What then is
/// left of the third term is below 1e-7.
///
/// Cost: up to two exponentials of a matrix, each with log2 |J| products.

#include <Eigen/Core>
#include <optional>
#include <span>

namespace dualdamp::sim {

class FastTurns {
 public:
  /// J (in parts of the interval's length) and df/dt at the stages of RadauCollocation.
  struct Stages {
    std::span<const Eigen::MatrixXd> jacobians;
    Eigen::MatrixXd forcing;  ///< one column for each stage
  };

  /// `perturbations` at the end, one in each column; the last column also has the forcing. None: the part is too
  /// long, or J is too large for the exponential.
  [[nodiscard]] std::optional<Eigen::MatrixXd> pass(const Stages& stages, const Eigen::MatrixXd& perturbations);

  /// Operations of linear algebra so far.
  [[nodiscard]] long operations() const { return operations_; }

 private:
  [[nodiscard]] Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix);

  long operations_ = 0;
};

}  // namespace dualdamp::sim
