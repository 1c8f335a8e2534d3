#include "identify/statistics/unequal_errors.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.hpp"
#include "identify/statistics/distributions.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

TEST_CASE("unequal errors: means of groups have the errors of their own readings") {
  // A mean of all: s^2/n with n - 1 degrees of freedom.
  const Eigen::VectorXd e = (Eigen::VectorXd(5) << 1.0, -2.0, 0.5, 1.5, -1.0).finished();
  const UnequalErrors mean = unequal_errors(Eigen::MatrixXd::Ones(5, 1), e);
  CHECK(mean.covariance(0, 0) == Approx(e.squaredNorm() / 4.0 / 5.0).epsilon(1e-12));
  CHECK(mean.half_widths[0] == Approx(quantile95(4.0)).epsilon(1e-9));
  // Two groups of three and twelve readings, in units of which one is tiny.
  constexpr double unit = 1e-6;
  Eigen::MatrixXd groups = Eigen::MatrixXd::Zero(15, 2);
  groups.col(0).head(3).setOnes();
  groups.col(1).tail(12).setConstant(unit);
  Eigen::VectorXd residuals(15);
  residuals << 4.0, -5.0, 1.0, 1.0, -1.0, 0.5, -0.5, 1.0, -1.0, 0.5, -0.5, 1.0, -1.0, 0.5, -0.5;
  const UnequalErrors both = unequal_errors(groups, residuals);
  CHECK(both.covariance(0, 0) == Approx(residuals.head(3).squaredNorm() / 2.0 / 3.0).epsilon(1e-9));
  CHECK(both.half_widths[0] == Approx(quantile95(2.0)).epsilon(1e-9));
  CHECK(both.covariance(1, 1) ==
        Approx(residuals.tail(12).squaredNorm() / 11.0 / 12.0 / (unit * unit)).epsilon(1e-9));
  CHECK(both.half_widths[1] == Approx(quantile95(11.0)).epsilon(1e-9));
}

TEST_CASE("unequal errors: intervals of a line hold the truth where the error grows with the reading") {
  constexpr int readings = 15;
  constexpr int records = 400;
  Eigen::MatrixXd J(readings, 2);
  Eigen::VectorXd deviation(readings);
  for (int i = 0; i < readings; ++i) {
    const double u = (i - 7) / 7.0;
    const double gain = 1.0 / (1.0 + 16.0 * u * u);  // a resonance
    J.row(i) << gain, gain * gain;
    deviation[i] = 0.05 * gain;
  }
  const Eigen::MatrixXd A = (J.transpose() * J).inverse();
  int plain = 0;
  int held = 0;
  for (int r = 0; r < records; ++r) {
    const core::RandomStream stream{17, static_cast<std::uint32_t>(r)};
    Eigen::VectorXd errors(readings);
    for (int i = 0; i < readings; ++i) errors[i] = deviation[i] * stream.normal(static_cast<std::uint64_t>(i));
    const Eigen::Vector2d off = A * J.transpose() * errors;
    const Eigen::VectorXd residuals = errors - J * off;
    const double variance = residuals.squaredNorm() / (readings - 2.0);
    plain += std::abs(off[1]) < quantile95(readings - 2.0) * std::sqrt(variance * A(1, 1)) ? 1 : 0;
    const UnequalErrors own = unequal_errors(J, residuals);
    held += std::abs(off[1]) < own.half_widths[1] * std::sqrt(own.covariance(1, 1)) ? 1 : 0;
  }
  CHECK(plain < 0.8 * records);
  CHECK(held > 0.87 * records);  // the weights of few readings are known to a part only
}
