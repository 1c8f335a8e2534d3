#include "identify/statistics/unequal_errors.hpp"

#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

UnequalErrors unequal_errors(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals) {
  const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd J = jacobian * scale.asDiagonal();
  const Eigen::MatrixXd effect =
      DefiniteMatrix(gram(J)).solve_each(J.transpose());  // of each error on each parameter
  const Eigen::MatrixXd M = Eigen::MatrixXd::Identity(J.rows(), J.rows()) - product(J, effect);
  // A reading that the fit follows altogether shows nothing of its error.
  constexpr double least = 1e-6;
  const Eigen::ArrayXd left = M.diagonal().array().max(least);
  const Eigen::ArrayXd variances = residuals.array().square() / left;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * effect;
  UnequalErrors result{product(scaled * variances.matrix().asDiagonal(), scaled.transpose()),
                       Eigen::VectorXd(J.cols())};
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    const Eigen::VectorXd weight = (effect.row(j).transpose().array().square() / left).matrix();
    const double trace = weight.dot(M.diagonal());
    result.half_widths[j] = quantile95(trace * trace / weight.dot(M.cwiseAbs2() * weight));
  }
  return result;
}

}  // namespace dualdamp::identify
