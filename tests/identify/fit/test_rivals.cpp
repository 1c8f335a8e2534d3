#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "identify/fit/fit.hpp"
#include "tests/identify/fit/sum_of_squares.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

constexpr double steepness = 10.0;

/// A sum of squares over t and the damping c of
///   60 + [10 (t^2 - 1)]^2 + [slope (t - middle)]^2 + (c - 100)^2
/// with minima near t = -1 and t = 1. There is no motion for |t| < gap.
std::unique_ptr<Experiment> two_minima(double slope, double middle, double gap) {
  return std::make_unique<test::SumOfSquares>(
      [=](double t, const sim::Oscillator& oscillator) -> std::optional<std::array<double, 3>> {
        if (std::abs(t) < gap) return std::nullopt;
        return {{steepness * (t * t - 1.0), slope * (t - middle), oscillator.damping - 100.0}};
      });
}

Fit fit_of(std::unique_ptr<Experiment> experiment, double begun_at) {
  Rig rig = test::rig_with(test::law_case_of("viscous_saturating"));
  rig.known.oscillator.damping = 100.0;
  rig.laws.front().values = {{"coefficient", test::saturating_coefficient},
                             {"saturation_velocity", std::exp(begun_at)}};
  Experiments experiments;
  experiments.push_back(std::move(experiment));
  std::vector<FitParameter> parameters = test::sought_in(rig, {"damping", "saturation_velocity"}, 1.0);
  return fit_rig(rig, std::move(parameters), experiments);
}

Fit fit_of_two_minima(double slope, double middle, double begun_at, double gap = 0.0) {
  return fit_of(two_minima(slope, middle, gap), begun_at);
}

}  // namespace

TEST_CASE("rivals: of two minima that the noise does not tell apart, the lower one is the estimate",
          "[identify][fit]") {
  // The other one is 2.4 variances higher.
  const double slope = std::sqrt(3.0);
  for (const double begun_at : {-0.9, 0.9}) {
    CAPTURE(begun_at);
    const Fit fit = fit_of_two_minima(slope, -0.2, begun_at);
    const FittedParameter& speed = test::fitted(fit, "saturation_velocity");
    CHECK(std::log(speed.value) == Approx(-1.0).margin(0.02));
    CHECK(speed.interval95[0] == Approx(std::exp(-1.0 - 1.96 * 0.05)).epsilon(0.02));
    // The deviation of t is 1/(2 steepness) at both minima.
    CHECK(speed.interval95[1] == Approx(std::exp(1.0 + std::sqrt(1.96 * 1.96 - 2.4) * 0.05)).epsilon(0.02));
    const FittedParameter& damping = test::fitted(fit, "damping");
    CHECK(damping.interval95[1] - damping.value == Approx(1.96).epsilon(0.02));
    REQUIRE(fit.warnings.size() == 1);
    CAPTURE(fit.warnings.front());
    CHECK(fit.warnings.front().find("another minimum, only 2.4 variances") != std::string::npos);
    CHECK(fit.warnings.front().find("saturation_velocity = 2.69") != std::string::npos);
  }
}

TEST_CASE("rivals: there may be no motion between them", "[identify][fit]") {
  const Fit fit = fit_of_two_minima(std::sqrt(3.0), -0.2, 0.9, 0.3);
  CHECK(std::log(test::fitted(fit, "saturation_velocity").value) == Approx(-1.0).margin(0.02));
  CHECK(fit.warnings.size() == 1);
}

TEST_CASE("rivals: a minimum beyond the noise is none", "[identify][fit]") {
  // 9.6 variances higher.
  const Fit fit = fit_of_two_minima(std::sqrt(12.0), -0.2, 0.9);
  const FittedParameter& speed = test::fitted(fit, "saturation_velocity");
  CHECK(std::log(speed.value) == Approx(-1.0).margin(0.05));
  CHECK(speed.interval95[1] < std::exp(-0.8));
  CHECK(fit.warnings.empty());
}

TEST_CASE("rivals: one without an effect of the parameter says nothing about values far from it",
          "[identify][fit]") {
  // Beyond t = 1 the sum of squares is nearly constant, 2.4 variances above the minimum at t = -1.
  const auto plateau = [](double t, const sim::Oscillator& oscillator) -> std::optional<std::array<double, 3>> {
    const double level = t < 0.0 ? 0.0 : std::sqrt(2.4) + 1e-3 * std::abs(t - 1.5);
    return {{t < 1.0 ? steepness * (t * t - 1.0) : 0.0, level, oscillator.damping - 100.0}};
  };
  const Fit fit = fit_of(std::make_unique<test::SumOfSquares>(plateau), 0.9);
  const FittedParameter& speed = test::fitted(fit, "saturation_velocity");
  CHECK(std::log(speed.value) == Approx(-1.0).margin(0.02));
  CHECK(std::log(speed.interval95[0]) > -2.01);
  CHECK(std::log(speed.interval95[1]) > 1.0);
  CHECK(fit.warnings.size() == 1);
}
