#include "identify/statistics/residual_covariance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace dualdamp::identify;

namespace {

using Eigen::Index;

constexpr Index count = 600;

/// Residuals that stay alike for some thirty samples, and the rows of a line.
Eigen::VectorXd lasting() {
  return Eigen::VectorXd::NullaryExpr(count, [](Index i) {
    const auto t = static_cast<double>(i);
    return std::sin(0.05 * t) + 0.3 * std::sin(1.7 * t);
  });
}

Eigen::MatrixXd line() {
  Eigen::MatrixXd rows(count, 2);
  for (Index i = 0; i < count; ++i) rows.row(i) << 1.0, static_cast<double>(i) / static_cast<double>(count);
  return rows;
}

double correlation_at(const Eigen::VectorXd& r, Index lag) {
  double sum = 0.0;
  for (Index i = lag; i < r.size(); ++i) sum += r[i] * r[i - lag];
  return sum / r.squaredNorm();
}

/// Twice the first lag whose correlation is that of chance, a tenth of the residuals at most.
Index last_lag(const Eigen::VectorXd& r) {
  Index lag = 1;
  while (correlation_at(r, lag) >= 2.0 / std::sqrt(static_cast<double>(r.size()))) ++lag;
  return std::min(r.size() / 10, 2 * lag);
}

}  // namespace

TEST_CASE("Correlated samples: how many count, and the covariance of their scores, are the sums of the formula") {
  const Eigen::VectorXd r = lasting();
  const Eigen::MatrixXd J = line();
  const Index last = last_lag(r);
  REQUIRE(last > 20);
  constexpr double variance = 2.5;
  double inflation = 1.0;
  Eigen::MatrixXd bracket = variance * J.transpose() * J;
  for (Index lag = 1; lag <= last; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(last + 1);
    inflation += 2.0 * weight * correlation_at(r, lag);
    for (Index i = lag; i < count; ++i)
      bracket += variance * weight * correlation_at(r, lag) *
                 (J.row(i).transpose() * J.row(i - lag) + J.row(i - lag).transpose() * J.row(i));
  }
  CHECK(independent_samples(r, true) == Approx(static_cast<double>(count) / inflation).epsilon(1e-9));
  CHECK((score_covariance(J, r, variance, true) - bracket).norm() < 1e-9 * bracket.norm());
}

TEST_CASE("Readings that are no samples, and few samples, are taken as independent") {
  const Eigen::VectorXd r = lasting();
  const Eigen::MatrixXd J = line();
  CHECK(independent_samples(r, false) == Approx(600.0));
  CHECK((score_covariance(J, r, 2.0, false) - 2.0 * J.transpose() * J).norm() < 1e-12 * J.squaredNorm());
  CHECK(independent_samples(r.head(49), true) == Approx(49.0));
  CHECK(independent_samples(r.head(50), true) < 25.0);
  CHECK(independent_samples(Eigen::VectorXd::Zero(100), true) == Approx(100.0));
}
