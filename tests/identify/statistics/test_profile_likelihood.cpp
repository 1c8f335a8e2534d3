#include "identify/statistics/profile_likelihood.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "identify/methods/amplitudes/resonance_deming.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/statistics.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/estimates.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;

namespace {

std::vector<std::pair<double, double>> noisy_line(double sigma) {
  Normal normal(12);
  std::vector<std::pair<double, double>> list;
  for (int i = 0; i < 8; ++i) {
    const double Y = 4.45e-3 + 0.3e-3 * i;
    list.emplace_back(Y, Y / 0.24 - 0.0133 + sigma * normal());
  }
  return list;
}

}  // namespace

TEST_CASE("The likelihood interval of zeta is Student's interval of the slope") {
  // With a and b free, Q - Q_min = (b - slope)^2 S_YY at the best intercept, so the interval is that of the slope,
  // taken to zeta = 1/(2 b) as it stands: for large scatter far from symmetric.
  LineOptions options;
  options.profile = true;
  for (const double sigma : {0.02e-3, 1.0e-3}) {
    CAPTURE(sigma);
    const auto list = noisy_line(sigma);
    const Estimate e = resonance_least_squares(pairs(list), at_resonance, options);
    REQUIRE(e.outcome.ok());
    REQUIRE(e.used.size() == 8);
    double mean = 0.0, S_YY = 0.0;
    for (const auto& [Y, x] : list) mean += Y / 8.0;
    for (const auto& [Y, x] : list) S_YY += (Y - mean) * (Y - mean);
    const double reach = quantile95(6.0) * e.line->residual_deviation / std::sqrt(S_YY);
    const auto& [low, high] = *further(e, "profile_zeta").interval95;
    CHECK(low == Approx(0.5 / (e.line->slope + reach)).epsilon(1e-6));
    CHECK(high == Approx(0.5 / (e.line->slope - reach)).epsilon(1e-6));
    const bool told = std::ranges::any_of(
        e.warnings, [](const std::string& w) { return w.find("is not the symmetric one") != std::string::npos; });
    CHECK(told == (sigma > 0.1e-3));
  }
}

TEST_CASE("At the ends of the likelihood interval of F0 the best fit is worse by t^2 s^2") {
  LineOptions options;
  options.profile = true;
  const auto list = noisy_line(0.2e-3);
  const Estimate e = resonance_least_squares(pairs(list), at_resonance, options);
  const auto sum = [&](double zeta, double F0) {
    double squares = 0.0;
    const double G = analytic::den_hartog(zeta, 1.0).G;
    for (const auto& [Y, x] : list) {
      const double off = x - (Y / (2.0 * zeta) - G * F0 / 1568.0);
      squares += off * off;
    }
    return squares;
  };
  const double least = sum(e.value.zeta, e.value.F0);
  const double t = quantile95(6.0);
  for (const double end : *further(e, "profile_F0").interval95) {
    double best = std::numeric_limits<double>::infinity();  // by brute force, in steps of 1e-5 of zeta
    for (int i = -60000; i <= 60000; ++i) best = std::min(best, sum(e.value.zeta * (1.0 + 1e-5 * i), end));
    CHECK((best - least) / (least / 6.0) == Approx(t * t).epsilon(1e-5));
  }
  // The curve is ordered, has its least value at the estimate, and shows the ridge: zeta falls as F0 rises.
  const auto curve = std::ranges::find(e.curves, "profile_F0", &EstimateCurve::name);
  REQUIRE(curve != e.curves.end());
  const auto& F0 = curve->columns[0].values;
  const auto& zeta = curve->columns[1].values;
  const auto& deviance = curve->columns[2].values;
  CHECK(std::ranges::is_sorted(F0));
  CHECK(std::ranges::is_sorted(zeta, std::greater<>()));
  const auto bottom = std::ranges::min_element(deviance) - deviance.begin();
  CHECK(F0[static_cast<std::size_t>(bottom)] == e.value.F0);
  CHECK(deviance.front() > t * t);
  CHECK(deviance.back() > t * t);
}

TEST_CASE("Deming's profile follows its own weights") {
  // Small errors: the likelihood interval is the symmetric one.
  LineOptions options;
  options.profile = true;
  options.sigma_x = 2e-5;
  options.sigma_Y = 5e-6;
  const Estimate e = resonance_deming(pairs(noisy_line(0.02e-3)), at_resonance, options);
  const auto& [low, high] = *further(e, "profile_zeta").interval95;
  const double half_width = 0.5 * (e.interval95->zeta[1] - e.interval95->zeta[0]);
  CHECK(low == Approx(e.value.zeta - half_width).margin(0.05 * e.std->zeta));
  CHECK(high == Approx(e.value.zeta + half_width).margin(0.05 * e.std->zeta));
}

TEST_CASE("A likelihood that levels off has no end") {
  Estimate e;
  e.value = {0.1, 8.0, 1e-3, 1.568};
  set_uncertainty(e, Eigen::Matrix2d{{1e-4, 0.0}, {0.0, 1e-8}}, 2.0, at_resonance);
  const auto level = [](double zeta, double x_f) {
    const double u = (zeta - 0.1) / 0.01;
    const double w = (x_f - 1e-3) / 1e-4;
    return (zeta < 0.1 ? u * u : 3.0 * u * u / (1.0 + u * u)) + w * w;
  };
  add_profiles(e, level, 2.0, at_resonance);
  REQUIRE(e.warnings.size() == 1);
  CHECK(e.warnings[0].find("no upper end") != std::string::npos);
  CHECK_FALSE(further(e, "profile_zeta").interval95.has_value());
  CHECK(further(e, "profile_F0").interval95.has_value());
}
