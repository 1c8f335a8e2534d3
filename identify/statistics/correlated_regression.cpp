#include "identify/statistics/correlated_regression.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
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

/// Sums of products of residuals at lags 0 ... most, by the Fourier transform. Residuals may be correlated over
/// thousands of samples, and sums lag by lag would take the square of the number of samples.
std::vector<double> products_up_to(const Eigen::VectorXd& r, const Ranges& blocks, Eigen::Index most) {
  std::vector<double> products(static_cast<std::size_t>(most) + 1, 0.0);
  Eigen::FFT<double> transform;
  for (const auto& [begin, end] : blocks) {
    const auto length = std::bit_ceil(static_cast<std::size_t>(end - begin + most));
    std::vector<double> values(length, 0.0);
    std::copy(r.data() + begin, r.data() + end, values.begin());
    std::vector<std::complex<double>> lines;
    transform.fwd(lines, values);
    for (std::complex<double>& line : lines) line = std::norm(line);
    transform.inv(values, lines);
    for (std::size_t lag = 0; lag < products.size(); ++lag) products[lag] += values[lag];
  }
  return products;
}

/// Number of lags in the covariance, with lag 0: twice the first lag at which the autocorrelation of the residuals
/// has fallen to that of chance, at most a tenth of the residuals.
std::size_t lags_of(const Eigen::VectorXd& r, const Ranges& blocks) {
  const double variance = r.squaredNorm();
  if (!(variance > 0.0)) return 1;
  const double chance = 2.0 / std::sqrt(static_cast<double>(r.size())) * variance;
  const Eigen::Index longest = r.size() / 10;
  const auto twice = [longest](Eigen::Index lag) {
    return static_cast<std::size_t>(std::min(longest, 2 * lag)) + 1;
  };
  constexpr Eigen::Index few = 32;
  for (Eigen::Index lag = 1; lag <= std::min(few, longest); ++lag)
    if (product_at(r, blocks, lag) < chance) return twice(lag);
  if (longest <= few) return static_cast<std::size_t>(longest) + 1;
  const std::vector<double> products = products_up_to(r, blocks, longest);
  for (Eigen::Index lag = few + 1; lag <= longest; ++lag)
    if (products[static_cast<std::size_t>(lag)] < chance) return twice(lag);
  return static_cast<std::size_t>(longest) + 1;
}

/// Sum of the products of pairs of rows, with Bartlett's weights 1 - lag/lags. It equals the sum over all windows
/// of `lags` rows of the product of the window's sum with itself, over `lags`: one pass for any number of lags.
Eigen::MatrixXd bartlett_sum(const Eigen::MatrixXd& rows, const Ranges& blocks, std::size_t lags) {
  const auto window = static_cast<Eigen::Index>(lags);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows.cols(), rows.cols());
  for (const auto& [begin, end] : blocks) {
    Eigen::RowVectorXd within = Eigen::RowVectorXd::Zero(rows.cols());
    for (Eigen::Index last = begin; last < end + window - 1; ++last) {
      if (last < end) within += rows.row(last);
      if (last - window >= begin) within -= rows.row(last - window);
      sum.noalias() += within.transpose() * within;
    }
  }
  return sum / static_cast<double>(lags);
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
  const Eigen::MatrixXd normal = gram(scaled);
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
  const std::size_t lags = lags_of(fit.residuals, parts);
  const double variance = fit.residuals.squaredNorm();
  const double inflation = variance > 0.0 ? bartlett_sum(fit.residuals, parts, lags)(0, 0) / variance : 1.0;
  fit.independent = static_cast<double>(columns.rows()) / std::max(1.0, inflation);

  const Eigen::MatrixXd inverse = spectrum.matrix_with(spectrum.values.cwiseInverse());
  const Eigen::MatrixXd root = scale.cwiseInverse().asDiagonal() * inverse;
  const Eigen::MatrixXd scores = fit.residuals.asDiagonal() * scaled;
  fit.covariance = propagated(root, bartlett_sum(scores, parts, lags));
  // As N - p replaces N in least squares with independent errors.
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
