#include "identify/ledger/joint_model.hpp"

namespace dualdamp::identify {

Eigen::MatrixXd free_columns(const Eigen::MatrixXd& base, const Eigen::MatrixXd& relaxed, const Taken& taken) {
  Eigen::MatrixXd all(base.rows(), base.cols() + static_cast<Eigen::Index>(taken.size()));
  all.leftCols(base.cols()) = base;
  for (std::size_t j = 0; j < taken.size(); ++j)
    all.col(base.cols() + static_cast<Eigen::Index>(j)) = relaxed.col(static_cast<Eigen::Index>(taken[j]));
  return all;
}

}  // namespace dualdamp::identify
