#include "identify/ledger/histories/lasting_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// Orthonormal columns and a target in rows that follow one another in blocks.
struct Rows {
  Eigen::MatrixXd basis;
  Eigen::VectorXd target;
  std::vector<Eigen::Index> blocks;

  [[nodiscard]] double count() const { return static_cast<double>(target.size()); }
  [[nodiscard]] double freedom() const { return std::max(1.0, count() - static_cast<double>(basis.cols())); }
};

Rows rows_of(const Regression& regression) {
  Rows rows{orthonormal_basis(regression.columns), regression.target, regression.blocks};
  const Eigen::VectorXd left = rows.target - rows.basis * (rows.basis.transpose() * rows.target);
  const double variance = left.squaredNorm() / rows.freedom();
  for (const Eigen::VectorXd& more : regression.at_rest) {
    const Eigen::VectorXd about_mean = more.array() - more.mean();
    const double ratio = about_mean.squaredNorm() / (static_cast<double>(more.size() - 1) * variance);
    // A converter that shows no noise at rest, or a mass that creeps, has other errors than in motion.
    constexpr double most_unlike = 2.5;
    if (!(ratio < most_unlike && ratio > 1.0 / most_unlike)) continue;
    const Eigen::Index before = rows.target.size();
    const Eigen::Index columns = rows.basis.cols();
    rows.blocks.push_back(before);
    rows.target.conservativeResize(before + more.size());
    rows.target.tail(more.size()) = about_mean;
    rows.basis.conservativeResize(before + more.size(), columns + 1);
    rows.basis.bottomRows(more.size()).setZero();
    rows.basis.rightCols(1).setZero();
    rows.basis.bottomRightCorner(more.size(), 1).setConstant(1.0 / std::sqrt(static_cast<double>(more.size())));
  }
  return rows;
}

/// Covariances at lags 0 ... most of what is left beside coefficients, and of what the coefficients took out, whose
/// covariance is spread * spread^T.
Eigen::VectorXd with_taken_out(const Rows& rows, const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& spread,
                               int most) {
  Eigen::VectorXd all = covariances_of(rows.target - rows.basis * coefficients, rows.blocks, most, rows.count());
  const Eigen::MatrixXd taken = rows.basis * spread;
  for (Eigen::Index j = 0; j < taken.cols(); ++j)
    all += covariances_of(taken.col(j), rows.blocks, most, rows.count());
  return all;
}

/// Rows with independent errors of unit variance, the first of each block as well: without them the mean of errors
/// that last long would be unknown.
Eigen::MatrixXd all_whitened(const Eigen::MatrixXd& rows, const std::vector<Eigen::Index>& blocks,
                             const Eigen::VectorXd& covariances, const Autoregression& errors) {
  const Eigen::Index p = errors.coefficients.size();
  const Eigen::MatrixXd later = whitened(rows, blocks, errors);
  const auto ranges = block_ranges(blocks, rows.rows());
  Eigen::MatrixXd all(later.rows() + p * static_cast<Eigen::Index>(ranges.size()), rows.cols());
  all.topRows(later.rows()) = later;
  Eigen::Index at = later.rows();
  for (const auto& [begin, end] : ranges) {
    const Eigen::Index first = std::min(p, end - begin);
    all.middleRows(at, first) = decorrelated(toeplitz(covariances.head(first)), rows.middleRows(begin, first));
    at += first;
  }
  return all.topRows(at);
}

/// The covariances that are expected, from the rows, if the errors follow the autoregression that has
/// `covariances`.
Eigen::VectorXd expected_covariances(const Rows& rows, const Eigen::VectorXd& covariances,
                                     const Autoregression& errors, int most) {
  const Eigen::MatrixXd basis = all_whitened(rows.basis, rows.blocks, covariances, errors);
  const Eigen::VectorXd target = all_whitened(rows.target, rows.blocks, covariances, errors);
  const SymmetricSpectrum information = symmetric_spectrum(gram(basis));
  const Eigen::MatrixXd spread = information.vectors * information.values.cwiseSqrt().cwiseInverse().asDiagonal();
  return with_taken_out(rows, spread * (spread.transpose() * (basis.transpose() * target)), spread, most);
}

/// Degrees of freedom behind the power at the frequency zero, s^2/(1 - a_1 - ... - a_p)^2: those of a variance with
/// the same relative standard error.
double freedom_of(const Autoregression& errors, const Eigen::VectorXd& covariances, double freedom) {
  const Eigen::Index p = errors.coefficients.size();
  if (p == 0) return core::infinity;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(p);
  const double of_sum =
      ones.dot(DefiniteMatrix(toeplitz(covariances.head(p))).solve(ones)) * errors.deviation * errors.deviation;
  const double open = 1.0 - errors.coefficients.sum();
  return freedom / (1.0 + 2.0 * of_sum / (open * open));
}

}  // namespace

// What the columns leave of the errors is not like them: most columns swing with the oscillator and take out noise
// near its frequency, the more the longer errors last. What they take out is therefore added, as it is expected of
// errors that have the covariances found: the steps of expectation and maximisation for the restricted likelihood
// (dempster1977). The first takes the errors for white.
LastingErrors lasting_errors(const Regression& regression) {
  const int most = regression.most_lags;
  const Rows rows = rows_of(regression);
  const Eigen::VectorXd left = rows.target - rows.basis * (rows.basis.transpose() * rows.target);
  const double variance = left.squaredNorm() / rows.freedom();
  const Eigen::Index columns = rows.basis.cols();
  Eigen::VectorXd found = with_taken_out(rows, rows.basis.transpose() * rows.target,
                                         Eigen::MatrixXd::Identity(columns, columns) * std::sqrt(variance), most);
  Autoregression errors = autoregression_of(found, rows.count());
  // Exact readings have no errors but those of rounding.
  const bool is_exact = !(variance > 1e-26 * rows.target.squaredNorm() / rows.count());
  constexpr int most_steps = 200;
  constexpr double little = 1e-4;  // of the variance: far below its standard error
  for (int i = 0; errors.coefficients.size() > 0 && !is_exact && i < most_steps; ++i) {
    Eigen::VectorXd next = expected_covariances(rows, found, errors, most);
    const double change = (next - found).cwiseAbs().maxCoeff();
    found = std::move(next);
    errors = autoregression_of(found, rows.count());
    if (!(change > little * found[0])) break;
  }
  return {errors, std::sqrt(found[0]), freedom_of(errors, found, rows.freedom())};
}

}  // namespace dualdamp::identify
