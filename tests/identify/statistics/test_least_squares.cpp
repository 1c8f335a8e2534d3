#include "identify/statistics/correlated_regression.hpp"
#include "identify/statistics/least_squares.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace dualdamp::identify;

namespace {

/// y = p0 (1 - exp(-p1 t)): the problem Misra1a of NIST's Statistical Reference Datasets in its form.
LeastSquaresProblem saturation(const Eigen::VectorXd& t, const Eigen::VectorXd& y, double p0, double p1) {
  LeastSquaresProblem problem;
  problem.residuals = t.size();
  problem.start = Eigen::Vector2d(p0, p1);
  problem.evaluate = [t, y](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    const Eigen::ArrayXd decay = (-p[1] * t.array()).exp();
    r = (p[0] * (1.0 - decay) - y.array()).matrix();
    if (J != nullptr) {
      J->col(0) = (1.0 - decay).matrix();
      J->col(1) = (p[0] * t.array() * decay).matrix();
    }
    return true;
  };
  return problem;
}

/// Least at 0, where it is 1, highest at 1 and -1, and falling again beyond. Near its minimum the linearised
/// function has its zero far away.
double hump(double p) { return 1.0 + 9.0 * p * p / std::pow(1.0 + p * p, 2); }
double hump_slope(double p) { return 18.0 * p * (1.0 - p * p) / std::pow(1.0 + p * p, 3); }

}  // namespace

TEST_CASE("A certified fit is reproduced: NIST's Misra1a") {
  Eigen::VectorXd x(14);
  Eigen::VectorXd y(14);
  x << 77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0;
  y << 10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78;
  // Time in units of 1000 so that both parameters are of order one to a thousand.
  const LeastSquaresFit found = fit(saturation(x / 1000.0, y, 500.0, 0.1));
  REQUIRE(found.outcome.ok());
  // Certified to 11 digits; the minimum is flat to the square root of rounding.
  CHECK(found.parameters[0] == Approx(2.3894212918e2).epsilon(1e-9));
  CHECK(found.parameters[1] == Approx(5.5015643181e-1).epsilon(1e-9));
  CHECK(found.sum_of_squares == Approx(1.2455138894e-1).epsilon(1e-10));
  const auto covariance = unit_covariance(found.jacobian);
  REQUIRE(covariance.has_value());
  const double variance = found.sum_of_squares / 12.0;
  CHECK(std::sqrt(variance * (*covariance)(0, 0)) == Approx(2.7070075241).epsilon(1e-8));
  CHECK(std::sqrt(variance * (*covariance)(1, 1)) == Approx(7.2668688436e-3).epsilon(1e-8));
}

TEST_CASE("Noiseless data give the truth to rounding, within bounds") {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(20, 0.1, 3.0);
  const Eigen::VectorXd y = (2.0 * (1.0 - (-0.7 * t.array()).exp())).matrix();
  LeastSquaresProblem problem = saturation(t, y, 1.0, 0.2);
  const LeastSquaresFit free = fit(problem);
  REQUIRE(free.outcome.ok());
  CHECK(free.parameters[0] == Approx(2.0).epsilon(1e-13));
  CHECK(free.parameters[1] == Approx(0.7).epsilon(1e-13));
  problem.low = Eigen::Vector2d(0.0, 0.0);
  problem.high = Eigen::Vector2d(10.0, 0.5);
  const LeastSquaresFit bounded = fit(problem);
  REQUIRE(bounded.outcome.ok());
  CHECK(bounded.parameters[1] == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("A bound that is met holds its parameter, and costs no more steps than none") {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(20, 0.1, 3.0);
  const Eigen::ArrayXd y = 2.0 * (1.0 - (-0.7 * t.array()).exp());
  for (const double bound : {0.5, 1.5}) {
    // With p1 on its bound the problem is linear in p0.
    const Eigen::ArrayXd g = 1.0 - (-bound * t.array()).exp();
    LeastSquaresProblem problem = saturation(t, y.matrix(), 1.0, bound < 0.7 ? 0.2 : 4.0);
    problem.low = Eigen::Vector2d(0.0, bound < 0.7 ? 0.0 : bound);
    problem.high = Eigen::Vector2d(10.0, bound < 0.7 ? bound : 5.0);
    problem.tolerance = 1e-10;
    int evaluations = 0;
    problem.evaluate = [&evaluations, model = problem.evaluate](const auto& p, auto& r, auto* J) {
      ++evaluations;
      return model(p, r, J);
    };
    const LeastSquaresFit found = fit(problem);
    CAPTURE(bound, evaluations);
    REQUIRE(found.outcome.ok());
    CHECK(found.parameters[1] == bound);
    CHECK(found.parameters[0] == Approx((g * y).sum() / (g * g).sum()).epsilon(1e-6));
    CHECK(evaluations < 40);
  }
  // A bound that is met on the way and not in the end lets go.
  LeastSquaresProblem inside = saturation(t, y.matrix(), 9.0, 0.06);
  inside.low = Eigen::Vector2d(0.0, 0.05);
  inside.high = Eigen::Vector2d(10.0, 0.75);
  CHECK(fit(inside).parameters[1] == Approx(0.7).epsilon(1e-9));
}

TEST_CASE("A bound to which the linearised problem leads is left if the sum of squares is larger there") {
  LeastSquaresProblem problem;
  problem.residuals = 2;
  problem.start = Eigen::Vector2d(3.0, 0.5);
  problem.low = Eigen::Vector2d(-10.0, -3.0);
  problem.high = Eigen::Vector2d(10.0, 3.0);
  problem.tolerance = 1e-8;
  problem.evaluate = [](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    r.resize(2);
    r << p[0] - 1.0, hump(p[1]);
    if (J != nullptr) {
      J->resize(2, 2);
      *J << 1.0, 0.0, 0.0, hump_slope(p[1]);
    }
    return true;
  };
  const LeastSquaresFit found = fit(problem);
  CHECK(found.sum_of_squares < 1.01);
  CHECK(std::abs(found.parameters[1]) < 0.1);
}

TEST_CASE("A wrong bound to which the linearised problem leads costs a few steps") {
  // At the bounds p0 has a minimum so flat that tens of steps lead to it.
  LeastSquaresProblem problem;
  problem.residuals = 3;
  problem.start = Eigen::Vector2d(3.0, 0.5);
  problem.low = Eigen::Vector2d(-10.0, -3.0);
  problem.high = Eigen::Vector2d(10.0, 3.0);
  problem.tolerance = 1e-12;
  int at_bound = 0;
  problem.evaluate = [&](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    if (std::abs(p[1]) == 3.0) ++at_bound;
    const double flat = std::pow(p[0], 8) / 9.0;
    r.resize(3);
    r << 0.01 * (p[0] - 1.0), hump(p[1]), std::pow(p[1], 6) * flat;
    if (J != nullptr) {
      J->resize(3, 2);
      *J << 0.01, 0.0, 0.0, hump_slope(p[1]), std::pow(p[1], 6) * 8.0 * std::pow(p[0], 7) / 9.0,
          6.0 * std::pow(p[1], 5) * flat;
    }
    return true;
  };
  const LeastSquaresFit found = fit(problem);
  CHECK(found.sum_of_squares < 1.01);
  CHECK(std::abs(found.parameters[1]) < 0.1);
  CAPTURE(at_bound);
  CHECK(at_bound > 0);
  CHECK(at_bound < 40);
}

TEST_CASE("A direction that the data leave open has no covariance") {
  Eigen::MatrixXd jacobian(3, 2);
  jacobian << 1.0, 2.0, 2.0, 4.0, 3.0, 6.0;
  CHECK_FALSE(unit_covariance(jacobian).has_value());
  jacobian(0, 1) = 0.0;
  REQUIRE(unit_covariance(jacobian).has_value());
  CHECK(((*unit_covariance(jacobian)) * (jacobian.transpose() * jacobian)).isIdentity(1e-12));
}

TEST_CASE("Where nothing is free there is no covariance to find, and no crash") {
  const std::optional<Eigen::MatrixXd> covariance = unit_covariance(Eigen::MatrixXd(4, 0));
  REQUIRE(covariance.has_value());
  CHECK(covariance->size() == 0);
  CHECK_FALSE(fit_correlated(Eigen::MatrixXd(4, 0), Eigen::VectorXd::Ones(4), {0}).has_value());
}

TEST_CASE("A model without a value where the search begins is a failure and no crash") {
  LeastSquaresProblem problem;
  problem.residuals = 1;
  problem.start = Eigen::VectorXd::Zero(1);
  problem.evaluate = [](const Eigen::VectorXd&, Eigen::VectorXd&, Eigen::MatrixXd*) { return false; };
  CHECK_FALSE(fit(problem).outcome.ok());
}
