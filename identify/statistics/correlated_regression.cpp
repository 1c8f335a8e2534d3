#include "identify/statistics/correlated_regression.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/statistics/autoregression.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

namespace {

/// Blocks as pairs of first row and end.
using Ranges = std::vector<std::pair<Eigen::Index, Eigen::Index>>;

double product_at(const Eigen::VectorXd& r, const Ranges& blocks, Eigen::Index lag) {
  double sum = 0.0;
  for (const auto& [begin, end] : blocks) {
    const Eigen::Index count = end - begin - lag;
    if (count > 0) sum += r.segment(begin, count).dot(r.segment(begin + lag, count));
  }
  return sum;
}

/// Autocorrelation of the residuals at lags 0, 1, ..., as far as the covariance looks.
std::vector<double> correlation_of(const Eigen::VectorXd& r, const Ranges& blocks) {
  const double variance = r.squaredNorm();
  std::vector<double> rho{1.0};
  if (!(variance > 0.0)) return rho;
  const double chance = 2.0 / std::sqrt(static_cast<double>(r.size()));
  const Eigen::Index longest = r.size() / 10;
  Eigen::Index last = longest;
  for (Eigen::Index lag = 1; lag <= last; ++lag) {
    rho.push_back(product_at(r, blocks, lag) / variance);
    if (last == longest && rho.back() < chance) last = std::min(longest, 2 * lag);
  }
  return rho;
}

double weight(std::size_t lag, std::size_t count) {
  return 1.0 - static_cast<double>(lag) / static_cast<double>(count);
}

/// The bracket of the covariance.
Eigen::MatrixXd score_covariance(const Eigen::MatrixXd& columns, const Eigen::VectorXd& r, const Ranges& blocks,
                                 std::size_t lags) {
  const Eigen::MatrixXd scores = r.asDiagonal() * columns;
  Eigen::MatrixXd sum = scores.transpose() * scores;
  for (std::size_t l = 1; l < lags; ++l) {
    const auto lag = static_cast<Eigen::Index>(l);
    for (const auto& [begin, end] : blocks) {
      const Eigen::Index count = end - begin - lag;
      if (count <= 0) continue;
      const Eigen::MatrixXd part =
          scores.middleRows(begin + lag, count).transpose() * scores.middleRows(begin, count);
      sum += weight(l, lags) * (part + part.transpose());
    }
  }
  return sum;
}

}  // namespace

double CorrelatedFit::freedom() const {
  return std::max(1.0, independent - static_cast<double>(coefficients.size()));
}

std::optional<CorrelatedFit> fit_correlated(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target,
                                            const std::vector<Eigen::Index>& blocks) {
  const Eigen::Index count = columns.cols();
  if (count == 0 || columns.rows() <= count) return std::nullopt;
  const Eigen::VectorXd scale = columns.colwise().norm();
  if (!(scale.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::MatrixXd scaled = columns * scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd normal = scaled.transpose() * scaled;
  const SymmetricSpectrum spectrum = symmetric_spectrum(normal);
  const double least = spectrum.values[0];
  constexpr double dependent = 1e-12;  // of squares: the columns agree to a millionth
  if (!(least > dependent)) return std::nullopt;

  CorrelatedFit fit;
  fit.condition = std::sqrt(spectrum.values[count - 1] / least);
  const Eigen::VectorXd solution = linear_least_squares(scaled, target);
  fit.coefficients = solution.cwiseQuotient(scale);
  fit.residuals = target - scaled * solution;
  fit.deviation = std::sqrt(fit.residuals.squaredNorm() / static_cast<double>(columns.rows() - count));

  const Ranges parts = block_ranges(blocks, columns.rows());
  const std::vector<double> rho = correlation_of(fit.residuals, parts);
  double inflation = 1.0;
  for (std::size_t l = 1; l < rho.size(); ++l) inflation += 2.0 * weight(l, rho.size()) * rho[l];
  fit.independent = static_cast<double>(columns.rows()) / std::max(1.0, inflation);

  const Eigen::MatrixXd inverse =
      spectrum.vectors * spectrum.values.cwiseInverse().asDiagonal() * spectrum.vectors.transpose();
  const Eigen::MatrixXd root = scale.cwiseInverse().asDiagonal() * inverse;
  fit.covariance = root * score_covariance(scaled, fit.residuals, parts, rho.size()) * root.transpose();
  // As least squares of independent errors has N - p in place of N.
  fit.covariance *= 1.0 + static_cast<double>(count) / fit.freedom();
  return fit;
}

std::optional<LackOfFit> correlated_term_test(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target,
                                              const Eigen::VectorXd& term, const std::vector<Eigen::Index>& blocks,
                                              double range, std::string name) {
  Eigen::MatrixXd wider(columns.rows(), columns.cols() + 1);
  wider << columns, term;
  const std::optional<CorrelatedFit> fit = fit_correlated(wider, target, blocks);
  if (!fit || !(range > 0.0)) return std::nullopt;
  const Eigen::Index last = columns.cols();
  const double gain = fit->coefficients[last];
  const double variance = fit->covariance(last, last);
  const Eigen::VectorXd extra = term - columns * linear_least_squares(columns, term);
  LackOfFit test;
  test.test = std::move(name);
  test.freedom = static_cast<int>(fit->freedom());
  test.effect = std::abs(gain) * extra.norm() / std::sqrt(static_cast<double>(term.size())) / range;
  test.statistic = variance > 0.0 ? gain * gain / variance : 0.0;
  test.p_value = f_test_p_value(test.statistic, 1.0, test.freedom);
  test.fired = test.p_value < test.level && test.effect > test.least_effect;
  return test;
}

}  // namespace dualdamp::identify
