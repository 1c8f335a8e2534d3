#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

TEST_CASE("fit: the covariance holds that the residuals also tell how the signals are weighed", "[identify][fit]") {
  const identify::Fit fit = test::fit_of(test::SmallRecord{.is_decay = false, .readings = 8}, 3);
  REQUIRE(fit.outcome.ok());
  REQUIRE(fit.signals.size() == 2);
  // Kenward and Roger's covariance, from the derivatives and the residuals of each signal.
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(2, 2);
  std::vector<Eigen::MatrixXd> parts;
  for (const identify::FittedSignal& signal : fit.signals) {
    const auto count = static_cast<double>(signal.rows.size());
    const Eigen::MatrixXd slopes = fit.slopes.middleRows(signal.rows.begin, signal.rows.size());
    parts.emplace_back(slopes.transpose() * slopes * signal.freedom / (count * signal.rms * signal.rms));
    sum += parts.back();
  }
  const Eigen::MatrixXd plain = sum.inverse();
  Eigen::MatrixXd expected = plain;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const Eigen::MatrixXd& part = parts[s];
    expected += 4.0 / fit.signals[s].freedom * plain * (part - part * plain * part) * plain;
  }
  CAPTURE(plain, expected, fit.covariance);
  CHECK((fit.covariance - expected).norm() < 0.01 * expected.norm());
  CHECK(expected(0, 0) > 1.03 * plain(0, 0));
  CHECK(expected(1, 1) > 1.03 * plain(1, 1));
}
