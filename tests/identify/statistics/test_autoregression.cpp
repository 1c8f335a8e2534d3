#include "identify/statistics/autoregression.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.hpp"

using namespace dualdamp::identify;

namespace {

/// e_t = 1.5 e_(t-1) - 0.7 e_(t-2) + 0.2 n_t: a resonance.
Eigen::VectorXd resonant(Eigen::Index count) {
  const dualdamp::core::RandomStream stream{7, 0};
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(count);
  for (Eigen::Index t = 2; t < count; ++t)
    errors[t] = 1.5 * errors[t - 1] - 0.7 * errors[t - 2] + 0.2 * stream.normal(static_cast<std::uint64_t>(t));
  return errors;
}

double correlation(const Eigen::VectorXd& e, Eigen::Index lag) {
  return e.head(e.size() - lag).dot(e.tail(e.size() - lag)) / e.squaredNorm();
}

}  // namespace

TEST_CASE("An autoregression is found again, and its errors become white with unit variance") {
  constexpr Eigen::Index count = 20'000;
  const Eigen::VectorXd errors = resonant(count);
  const Autoregression found =
      autoregression_of(covariances_of(errors, {}, 8, static_cast<double>(count)), static_cast<double>(count));
  REQUIRE(found.coefficients.size() >= 2);
  // Standard errors of the coefficients are sqrt((1 - 0.49)/count) = 0.005.
  CHECK(found.coefficients[0] == Approx(1.5).margin(0.025));
  CHECK(found.coefficients[1] == Approx(-0.7).margin(0.035));
  CHECK(found.deviation == Approx(0.2).epsilon(0.03));
  const Eigen::VectorXd white = whitened(errors, {}, found);
  CHECK(white.squaredNorm() / static_cast<double>(white.size()) == Approx(1.0).epsilon(0.05));
  for (Eigen::Index lag = 1; lag < 6; ++lag) CHECK(std::abs(correlation(white, lag)) < 0.03);
}

TEST_CASE("Independent errors stay as they are but for their scale, and blocks lose their own first rows") {
  const dualdamp::core::RandomStream stream{8, 0};
  Eigen::VectorXd errors(400);
  for (Eigen::Index t = 0; t < errors.size(); ++t) errors[t] = 3.0 * stream.normal(static_cast<std::uint64_t>(t));
  CHECK(autoregression_of(covariances_of(errors, {}, 0, 400.0), 400.0).coefficients.size() == 0);
  const Autoregression known{Eigen::Vector2d(0.5, 0.1), 2.0};
  const Eigen::MatrixXd rows = whitened(errors, {0, 100, 101}, known);
  CHECK(rows.rows() == 98 + 0 + 297);
  CHECK(rows(0, 0) == Approx((errors[2] - 0.5 * errors[1] - 0.1 * errors[0]) / 2.0));
  CHECK(rows(98, 0) == Approx((errors[103] - 0.5 * errors[102] - 0.1 * errors[101]) / 2.0));
}
