#include "identify/ledger/histories/unlike_zeros.hpp"

#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

Eigen::VectorXd unlike_zeros(const JointModel& model, const ForwardLayout& layout, const Place& at,
                             const Eigen::VectorXd& before) {
  const Eigen::Index count = layout.count_of_zeros();
  const Eigen::Index first = layout.count() - count;
  if (count == 0 || !model.base.allFinite()) return {};
  const Eigen::Index after = model.base.cols() - layout.count();
  Eigen::MatrixXd others(model.base.rows(), first + after);
  others << model.base.leftCols(first), model.base.rightCols(after);
  const Eigen::MatrixXd basis = orthonormal_basis(others);
  const double freedom = static_cast<double>(model.residuals.size() - basis.cols() - count);
  if (freedom < 1.0) return {};
  const auto beside = [&](const Eigen::MatrixXd& rows) -> Eigen::MatrixXd {
    return rows - basis * (basis.transpose() * rows);
  };
  const Eigen::MatrixXd own = beside(model.base.middleCols(first, count));
  const Eigen::VectorXd left = beside(model.residuals);
  const Eigen::VectorXd step = pivoted_least_squares(own, left);
  Eigen::VectorXd p = at.p;
  if (before.size() > 0) layout.add_zeros(p, before);
  const Eigen::VectorXd zeros = p.tail(count) + step;
  const double variance = (left - own * step).squaredNorm() / freedom;
  constexpr double level = 0.01;
  const double statistic = (own * zeros).squaredNorm() / (static_cast<double>(count) * variance);
  if (!(f_test_p_value(statistic, static_cast<double>(count), freedom) < level)) return {};
  Eigen::VectorXd all(count + 1);
  all << -zeros.sum(), zeros;
  return layout.length() * (all.array() + at.zeros[at.zeros.size() - 1]).matrix();
}

}  // namespace dualdamp::identify
