#pragma once
/// Linear least squares. One translation unit holds Eigen's decompositions, which take seconds to compile.

#include <Eigen/Core>

namespace dualdamp::identify {

/// The x that minimises |columns x - values|, by Householder's QR. For columns that are independent: as many rows
/// as columns at least. Cost: 2 rows columns^2 operations.
[[nodiscard]] Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// The same where columns may be nearly dependent: with column pivoting, dependent columns get 0.
[[nodiscard]] Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

}  // namespace dualdamp::identify
