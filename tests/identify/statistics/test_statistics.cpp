#include "identify/statistics/statistics.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("The F test of an added term fires as often as its level says, and sees a term that is there") {
  // Straight lines with normal errors, no curvature: 4000 tests at 5 % fire 200 times, give or take 14; four times
  // that. The effect of noise alone is far above the least effect here, so only the level decides.
  constexpr int tests = 4000;
  constexpr Eigen::Index n = 8;
  Normal normal(41);
  Eigen::MatrixXd columns(n, 2);
  Eigen::VectorXd square(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / (n - 1) - 0.5;
    columns.row(i) << 1.0, u;
    square[i] = u * u;
  }
  const Eigen::MatrixXd normal_matrix = columns.transpose() * columns;
  const auto residuals = [&](double curvature) {
    Eigen::VectorXd y(n);
    for (Eigen::Index i = 0; i < n; ++i) y[i] = 3.0 + columns(i, 1) + curvature * square[i] + 0.05 * normal();
    const Eigen::VectorXd coefficients = normal_matrix.inverse() * (columns.transpose() * y);
    return Eigen::VectorXd(y - columns * coefficients);
  };
  int fired = 0;
  int seen = 0;
  for (int i = 0; i < tests; ++i) {
    fired += added_term_test(columns, residuals(0.0), square, 1.0, "test")->fired;
    seen += added_term_test(columns, residuals(1.5), square, 1.0, "test")->fired;
  }
  CHECK(std::abs(fired - 200) < 56);
  CHECK(seen > tests * 9 / 10);
}

TEST_CASE("The F test needs freedom and a term of its own") {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(4, 2);
  columns.col(1) << 0.0, 1.0, 0.0, 1.0;
  const Eigen::VectorXd residual = Eigen::VectorXd::Random(4);
  // Two levels only: the square of the level is the level.
  CHECK_FALSE(added_term_test(columns, residual, columns.col(1), 1.0, "test").has_value());
  const Eigen::VectorXd other = Eigen::Vector4d(0.0, 1.0, 2.0, 4.0);
  CHECK(added_term_test(columns, residual, other, 1.0, "test").has_value());
  CHECK_FALSE(added_term_test(columns.topRows(3), residual.head(3), other.head(3), 1.0, "test").has_value());
  // Significant and of no weight: 1e-6 of the range.
  const Eigen::VectorXd tiny =
      1e-6 * (other - columns * (columns.transpose() * columns).inverse() * (columns.transpose() * other));
  const auto test = added_term_test(columns, tiny, other, 1.0, "test");
  CHECK(test->p_value < 1e-4);
  CHECK_FALSE(test->fired);
}

TEST_CASE("An independent error widens both sides of an interval by the root of the sum of squares") {
  // 3-4-5 triangles: an added half width of 4 makes sides of 3 and 7.5 to 5 and 8.5.
  const double deviation = 4.0 / 1.9599639845400545;
  const Interval wider = widened({-3.0, 7.5}, 0.0, deviation);
  CHECK(wider[0] == Approx(-5.0).epsilon(1e-12));
  CHECK(wider[1] == Approx(8.5).epsilon(1e-12));
  // A value beyond the interval counts as its end.
  const Interval beyond = widened({-3.0, 0.0}, 1.0, deviation);
  CHECK(beyond[0] == Approx(-5.0).epsilon(1e-12));
  CHECK(beyond[1] == Approx(4.0).epsilon(1e-12));
}
