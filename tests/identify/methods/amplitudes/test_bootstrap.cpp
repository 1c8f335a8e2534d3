#include "identify/methods/amplitudes/bootstrap.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "identify/methods/amplitudes/resonance_deming.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/estimates.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;

namespace {

constexpr double drifting_zeta = 0.12;

/// Ten sweeps of five levels; each sweep has a friction of its own.
Record drifting(const std::vector<double>& x_f, double sigma, Normal& normal) {
  const double G = analytic::den_hartog(drifting_zeta, 1.0).G;
  PairRecord record;
  for (std::size_t j = 0; j < x_f.size(); ++j)
    for (int i = 0; i < 5; ++i) {
      const double Y = 4.45e-3 + 0.575e-3 * i;
      record.pairs.push_back({Y, Y / (2.0 * drifting_zeta) - G * x_f[j] + sigma * normal(),
                              "sweep " + std::to_string(j), static_cast<int>(record.pairs.size()) + 1});
    }
  return {record, std::nullopt};
}

const std::vector<double> drift = {2.3e-3, 2.5e-3, 2.45e-3, 2.7e-3, 2.6e-3,
                                   2.4e-3, 2.2e-3, 2.55e-3, 2.8e-3, 2.35e-3};

}  // namespace

TEST_CASE("Residuals drawn from one sweep scatter the slope as the formula says") {
  // Given the residuals, drawing them with replacement gives the slope the variance s^2/S_YY exactly. 4000
  // replicates know a standard deviation to 1.1 %; three times that.
  Normal normal(4);
  std::vector<std::pair<double, double>> list;
  for (int i = 0; i < 50; ++i) {
    const double Y = 4.45e-3 + 0.046e-3 * i;
    list.emplace_back(Y, Y / (2.0 * drifting_zeta) - 0.013 + 0.05e-3 * normal());
  }
  LineOptions options;
  options.bootstrap = 4000;
  const Estimate e = resonance_least_squares(pairs(list), at_resonance, options);
  CHECK(*further(e, "bootstrap_zeta").std == Approx(e.std->zeta).epsilon(0.035));
  CHECK(*further(e, "bootstrap_F0").std == Approx(e.std->F0).epsilon(0.035));
  CHECK(further(e, "bootstrap_zeta").value == Approx(e.value.zeta).margin(0.1 * e.std->zeta));
  // Percentiles of nearly normal replicates: 1.96 standard deviations, known to 3 % each.
  const auto& [low, high] = *further(e, "bootstrap_F0").interval95;
  CHECK(high - low == Approx(2.0 * 1.96 * e.std->F0).epsilon(0.07));
  REQUIRE_FALSE(e.warnings.empty());
  CHECK(e.warnings.back().find("drew residuals") != std::string::npos);
  // The same draws every time.
  CHECK(further(resonance_least_squares(pairs(list), at_resonance, options), "bootstrap_zeta").value ==
        further(e, "bootstrap_zeta").value);
}

TEST_CASE("Residuals of Deming's line are drawn along its errors") {
  // Errors of both amplitudes; the large-sample standard error is the measure, to 1/sqrt(n) = 4 % or so.
  Normal normal(14);
  std::vector<std::pair<double, double>> list;
  for (int i = 0; i < 400; ++i) {
    const double Y = 4.45e-3 + 0.0058e-3 * i;
    list.emplace_back(Y + 0.1e-3 * normal(), Y / (2.0 * drifting_zeta) - 0.013 + 0.2e-3 * normal());
  }
  LineOptions options;
  options.bootstrap = 2000;
  const Estimate scale = resonance_deming(pairs(list), at_resonance, options);
  CHECK(*further(scale, "bootstrap_zeta").std == Approx(scale.std->zeta).epsilon(0.1));
  CHECK(further(scale, "bootstrap_zeta").value == Approx(scale.value.zeta).margin(0.1 * scale.std->zeta));
}

TEST_CASE("Sweeps drawn whole show the drift between them") {
  // Without noise each sweep is a line of the same slope: a replicate's friction is the mean of ten drawn from the
  // ten, its standard deviation that of the population over sqrt(10), exactly, and zeta does not move.
  Normal none(1);
  LineOptions options;
  options.bootstrap = 4000;
  const Estimate e = resonance_least_squares(drifting(drift, 0.0, none), at_resonance, options);
  double mean = 0.0, square = 0.0;
  for (const double x_f : drift) mean += x_f / 10.0;
  for (const double x_f : drift) square += (x_f - mean) * (x_f - mean) / 10.0;
  CHECK(*further(e, "bootstrap_F0").std == Approx(1568.0 * std::sqrt(square / 10.0)).epsilon(0.035));
  CHECK(*further(e, "bootstrap_zeta").std < 1e-12);
  for (const std::string& warning : e.warnings) CHECK(warning.find("bootstrap") == std::string::npos);
}

TEST_CASE("Few sweeps give a warning") {
  Normal normal(2);
  LineOptions options;
  options.bootstrap = 50;
  const Estimate e =
      resonance_least_squares(drifting({2.4e-3, 2.5e-3, 2.6e-3}, 1e-5, normal), at_resonance, options);
  CHECK(e.warnings.back().find("3 sweeps only") != std::string::npos);
}

TEST_CASE("A thousand replicates of fifty pairs, by sweeps and by residuals") {
  Normal normal(9);
  const Record swept = drifting(drift, 0.05e-3, normal);
  Record single = swept;
  for (Pair& pair : single.pairs->pairs) pair.sweep.clear();
  LineOptions options;
  options.bootstrap = 1000;
  for (const Record* record : std::initializer_list<const Record*>{&swept, &single}) {
    const Estimate e = resonance_least_squares(*record, at_resonance, options);
    CHECK(e.others.size() == 2);
  }
}
