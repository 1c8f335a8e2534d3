#include "identify/statistics/linear_least_squares.hpp"

#include <Eigen/QR>

namespace dualdamp::identify {

Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(columns).solve(values);
}

Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns).solve(values);
}

}  // namespace dualdamp::identify
