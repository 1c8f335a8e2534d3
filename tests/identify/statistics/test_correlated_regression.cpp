#include "identify/statistics/correlated_regression.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numbers>

#include "core/random.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

using Eigen::Index;

/// A line and a wave, and a target with noise beside something that lasts over a good part of the rows.
struct Sample {
  Eigen::MatrixXd columns;
  Eigen::VectorXd target;
};

Sample sample_of(Index count, double lasting) {
  const core::RandomStream noise{.seed = 7};
  Sample sample{Eigen::MatrixXd(count, 2), Eigen::VectorXd(count)};
  for (Index i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count);
    sample.columns.row(i) << std::sin(0.3 * static_cast<double>(i)), t;
    sample.target[i] = 2.0 * sample.columns(i, 0) + t + lasting * (1.0 + std::cos(2.0 * t)) +
                       0.1 * noise.normal(static_cast<std::uint64_t>(i));
  }
  return sample;
}

/// The sums of the header as they stand there, lag by lag, of rows of which two blocks hold `middle` and the rest.
struct Sums {
  double independent = 0.0;
  Eigen::MatrixXd covariance;
};

Sums literally(const Sample& sample, const Eigen::VectorXd& r, Index middle) {
  const Index count = r.size();
  const auto same = [&](Index i, Index j) { return (i < middle) == (j < middle); };
  const auto product = [&](Index lag) {
    double sum = 0.0;
    for (Index i = lag; i < count; ++i)
      if (same(i, i - lag)) sum += r[i] * r[i - lag];
    return sum / r.squaredNorm();
  };
  Index last = count / 10;
  for (Index lag = 1; lag <= last; ++lag)
    if (product(lag) < 2.0 / std::sqrt(static_cast<double>(count))) {
      last = std::min(count / 10, 2 * lag);
      break;
    }
  double inflation = 1.0;
  const Eigen::MatrixXd scores = r.asDiagonal() * sample.columns;
  Eigen::MatrixXd bracket = scores.transpose() * scores;
  for (Index lag = 1; lag <= last; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(last + 1);
    inflation += 2.0 * weight * product(lag);
    for (Index i = lag; i < count; ++i)
      if (same(i, i - lag))
        bracket += weight * (scores.row(i).transpose() * scores.row(i - lag) +
                             scores.row(i - lag).transpose() * scores.row(i));
  }
  const auto n = static_cast<double>(count);
  const double independent = n / std::max(1.0, inflation);
  const Eigen::Matrix2d inverse = (sample.columns.transpose() * sample.columns).inverse();
  const double freedom = std::max(1.0, independent - 2.0);
  return {independent, inverse * bracket * inverse * (1.0 + 2.0 / freedom)};
}

}  // namespace

TEST_CASE("Correlated residuals: the covariance is the sum over lags of its formula, with two records too") {
  for (const double lasting : {0.0, 0.05, 1.0}) {
    const Sample sample = sample_of(1500, lasting);
    constexpr Index middle = 600;
    const std::optional<CorrelatedFit> fit = fit_correlated(sample.columns, sample.target, {0, middle});
    REQUIRE(fit);
    const Sums sums = literally(sample, fit->residuals, middle);
    CAPTURE(lasting, fit->independent);
    CHECK(fit->independent == Approx(sums.independent).epsilon(1e-9));
    CHECK((fit->covariance - sums.covariance).norm() < 1e-9 * sums.covariance.norm());
    // What lasts leaves few residuals that count.
    if (lasting == 1.0) CHECK(fit->independent < 20.0);
  }
}

TEST_CASE("Correlated residuals: the first lag of chance is found among the far ones too") {
  // The autocorrelation of a wave falls below that of chance where it crosses zero: after a quarter of its period.
  for (const Index quarter : {31, 32, 33, 34, 50}) {
    Sample sample = sample_of(6000, 0.0);
    for (Index i = 0; i < sample.target.size(); ++i)
      sample.target[i] = std::cos(0.5 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(quarter));
    const std::optional<CorrelatedFit> fit = fit_correlated(sample.columns, sample.target, {});
    REQUIRE(fit);
    CAPTURE(quarter);
    CHECK(fit->independent == Approx(literally(sample, fit->residuals, 0).independent).epsilon(1e-9));
  }
}

TEST_CASE("Correlated residuals: the test of a further term is that of Student for its coefficient") {
  const Sample sample = sample_of(400, 0.0);
  Eigen::VectorXd term(400);
  for (Index i = 0; i < 400; ++i) term[i] = std::cos(0.05 * static_cast<double>(i * i) / 20.0);
  Eigen::MatrixXd wider(400, 3);
  wider << sample.columns, term;
  const std::optional<CorrelatedFit> fit = fit_correlated(wider, sample.target, {});
  const auto test = correlated_term_test(sample.columns, sample.target, term, {}, 2.0, "term");
  REQUIRE(fit);
  REQUIRE(test);
  const double t = fit->coefficients[2] / std::sqrt(fit->covariance(2, 2));
  CHECK(test->statistic == Approx(t * t).epsilon(1e-9));
  CHECK(test->freedom == static_cast<int>(fit->freedom()));
  const boost::math::students_t law(test->freedom);
  CHECK(test->p_value == Approx(2.0 * boost::math::cdf(boost::math::complement(law, std::abs(t)))).epsilon(1e-9));
  // What the term adds to the columns, as a share of the range.
  const Eigen::MatrixXd& J = sample.columns;
  const Eigen::VectorXd beside = term - J * (J.transpose() * J).inverse() * (J.transpose() * term);
  CHECK(test->effect ==
        Approx(std::abs(fit->coefficients[2]) * beside.norm() / std::sqrt(400.0) / 2.0).epsilon(1e-9));
}

TEST_CASE("Correlated residuals: what lasts over a long record costs no more than its samples") {
  const Sample sample = sample_of(200'000, 1.0);
  const std::clock_t begin = std::clock();
  REQUIRE(fit_correlated(sample.columns, sample.target, {}));
  // Sums lag by lag, 20,000 of them, take more than ten seconds of processor time.
  constexpr double most = 2.0;
  CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < most);
}
