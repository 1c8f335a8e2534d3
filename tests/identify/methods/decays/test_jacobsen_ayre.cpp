#include "identify/methods/decays/jacobsen_ayre.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
using std::numbers::pi;

namespace {

/// Signed extremes of the exact recursion.
std::vector<double> decay(double zeta, double x_f, double first, int count) {
  const double R = std::exp(-pi * zeta / std::sqrt(1.0 - zeta * zeta));
  std::vector<double> list;
  double X = first;
  for (int i = 0; i < count; ++i) {
    list.push_back(i % 2 == 0 ? X : -X);
    X = R * X - x_f * (1.0 + R);
  }
  return list;
}

}  // namespace

TEST_CASE("The rule of thumb errs by as much as is known of it, and says so") {
  // The means of the paper's Table 3 from 13.6 mm: 0.142 for 0.0819 (+73 %), 1.20 mm for 0.807 mm (+48 %).
  const Estimate e = jacobsen_ayre(extremes(decay(0.0819, 0.807e-3, 13.6e-3, 5)), stiff_spring, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.value.zeta == Approx(0.142).margin(5e-4));
  CHECK(e.value.x_f == Approx(1.20e-3).margin(5e-6));
  CHECK(e.value.zeta / 0.0819 - 1.0 == Approx(0.73).margin(0.005));
  CHECK(e.value.x_f / 0.807e-3 - 1.0 == Approx(0.48).margin(0.005));
  CHECK_FALSE(e.usable);
  CHECK(mentions(e.reason, "takes one friction for the other"));
  CHECK_FALSE(e.std.has_value());
  // Solved for both, the two biases are gone but for the second order of the decay.
  REQUIRE(e.subsets.size() == 1);
  CHECK(e.subsets[0].label == "corrected");
  CHECK(e.subsets[0].value.zeta == Approx(0.0819).epsilon(0.04));
  CHECK(e.subsets[0].value.x_f == Approx(0.807e-3).epsilon(0.01));
}

TEST_CASE("The biases are those of the rule's own formulas where decrements are small") {
  // zeta_app - zeta = 2 x_f/(pi X), x_f,app - x_f = pi zeta X/2, with X the swing between, up to terms of relative
  // order (pi zeta + 2 x_f/X)^2 = 1 %.
  const double zeta = 0.015, x_f = 0.1;
  const std::vector<double> list = decay(zeta, x_f, 20.0, 9);
  const Estimate e = jacobsen_ayre(extremes(list), table_1_constants, {});
  CHECK(e.value.zeta - zeta == Approx(2.0 * x_f / (pi * std::abs(list[1]))).epsilon(0.02));
  CHECK(e.value.x_f - x_f == Approx(0.5 * pi * zeta * std::abs(list[7])).epsilon(0.02));
  CHECK(e.subsets[0].value.zeta == Approx(zeta).epsilon(5e-3));
  CHECK(e.subsets[0].value.x_f == Approx(x_f).epsilon(5e-3));
}

TEST_CASE("Where one friction rules its swings the rule may be used") {
  // From 80 down to about 0.4 with zeta = 0.005, x_f = 0.05: 2 x_f/(pi X zeta) = 8 %, pi zeta X/(2 x_f) = 8 %.
  std::vector<double> list = decay(0.005, 0.05, 80.0, 400);
  list.erase(std::ranges::find_if(list, [](double e) { return std::abs(e) < 0.4; }), list.end());
  const Estimate e = jacobsen_ayre(extremes(list), table_1_constants, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.value.zeta == Approx(0.005).epsilon(0.1));
  CHECK(e.value.x_f == Approx(0.05).epsilon(0.1));
  CHECK(e.usable);
  REQUIRE(e.warnings.size() == 1);
  CHECK(mentions(e.warnings[0], "free_decay"));
}

TEST_CASE("Known errors of the extremes reach the rule's numbers") {
  // First order in sigma/X = 1 %: 20000 samples know a standard deviation to 0.5 %.
  JacobsenAyreOptions options;
  options.sigma_x = 0.02;
  const std::vector<double> exact = decay(0.05, 0.1, 10.0, 5);
  Normal normal(6);
  Cloud cloud;
  Estimate e;
  for (int i = 0; i < 20000; ++i) {
    std::vector<double> noisy = exact;
    for (double& value : noisy) value += options.sigma_x * normal();
    e = jacobsen_ayre(extremes(noisy), table_1_constants, options);
    cloud.add(e.value.zeta, e.value.F0);
  }
  e = jacobsen_ayre(extremes(exact), table_1_constants, options);
  CHECK(e.std->zeta == Approx(std::sqrt(cloud.var_a())).epsilon(0.02));
  CHECK(e.std->F0 == Approx(std::sqrt(cloud.var_b())).epsilon(0.02));
  CHECK((*e.covariance)(0, 1) == Approx(cloud.covariance()).epsilon(0.1));
}

TEST_CASE("Extremes that are no free decay are refused by the rule") {
  CHECK(jacobsen_ayre(Record{}, table_1_constants, {}).reason ==
        "the record holds no extremes of a free vibration");
  CHECK(mentions(jacobsen_ayre(extremes({3.0, -2.0}), table_1_constants, {}).reason, "three successive extremes"));
  CHECK(mentions(jacobsen_ayre(extremes({3.0, 2.0, 1.0}), table_1_constants, {}).reason, "does not lie across"));
  CHECK(jacobsen_ayre(extremes({1.0, -2.0, 3.0}), table_1_constants, {}).reason == "the swings do not shrink");
}
