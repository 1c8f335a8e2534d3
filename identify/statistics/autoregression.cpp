#include "identify/statistics/autoregression.hpp"

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

std::vector<std::pair<Eigen::Index, Eigen::Index>> block_ranges(const std::vector<Eigen::Index>& blocks,
                                                                Eigen::Index count) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> list;
  Eigen::Index begin = 0;
  for (const Eigen::Index block : blocks)
    if (block > begin) list.emplace_back(std::exchange(begin, block), block);
  if (count > begin) list.emplace_back(begin, count);
  return list;
}

Eigen::VectorXd covariances_of(const Eigen::VectorXd& errors, const std::vector<Eigen::Index>& blocks, int most,
                               double freedom) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(most + 1);
  for (const auto& [begin, end] : block_ranges(blocks, errors.size()))
    for (Eigen::Index lag = 0; lag <= most && lag < end - begin; ++lag)
      sums[lag] += errors.segment(begin, end - begin - lag).dot(errors.segment(begin + lag, end - begin - lag));
  return sums / freedom;
}

Eigen::MatrixXd toeplitz(const Eigen::VectorXd& covariances) {
  Eigen::MatrixXd matrix(covariances.size(), covariances.size());
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) matrix(r, c) = covariances[std::abs(r - c)];
  return matrix;
}

Autoregression autoregression_of(const Eigen::VectorXd& covariances, double count) {
  Autoregression best;
  double least = core::infinity;
  for (Eigen::Index p = 0; p < covariances.size(); ++p) {
    const Eigen::VectorXd lagged = covariances.segment(1, p);
    const Eigen::VectorXd a =
        p == 0 ? Eigen::VectorXd() : DefiniteMatrix(toeplitz(covariances.head(p))).solve(lagged);
    const double variance = covariances[0] - (p == 0 ? 0.0 : a.dot(lagged));
    if (!(variance > 1e-12 * covariances[0])) break;
    const double criterion = count * std::log(variance) + std::log(count) * static_cast<double>(p + 1);
    if (criterion >= least) continue;
    least = criterion;
    best = {a, std::sqrt(variance)};
  }
  return best;
}

Eigen::MatrixXd whitened(const Eigen::MatrixXd& rows, const std::vector<Eigen::Index>& blocks,
                         const Autoregression& autoregression) {
  const Eigen::Index p = autoregression.coefficients.size();
  const auto parts = block_ranges(blocks, rows.rows());
  Eigen::Index left = 0;
  for (const auto& [begin, end] : parts) left += std::max<Eigen::Index>(0, end - begin - p);
  Eigen::MatrixXd result(left, rows.cols());
  Eigen::Index at = 0;
  for (const auto& [begin, end] : parts) {
    const Eigen::Index count = end - begin - p;
    if (count <= 0) continue;
    result.middleRows(at, count) = rows.middleRows(begin + p, count);
    for (Eigen::Index lag = 1; lag <= p; ++lag)
      result.middleRows(at, count) -=
          autoregression.coefficients[lag - 1] * rows.middleRows(begin + p - lag, count);
    at += count;
  }
  return result / autoregression.deviation;
}

}  // namespace dualdamp::identify
