#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "identify/fit/fit.hpp"
#include "identify/fit/problem.hpp"
#include "tests/identify/fit/sum_of_squares.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

constexpr double angle_per_t = 0.35;
constexpr double angle_at_zero = 0.25 * std::numbers::pi;

/// A sum of squares over t, damping and mass of
///   60 + [100 (a^2 + b^2 - 1)]^2 + [20 (angle - angle at zero - 0.35 t)]^2 + t^2
/// with a = damping/(100 N.s/m), b = mass/(1 kg) and the angle of (a, b): a valley along a circle. Beside it there
/// is no motion.
std::unique_ptr<Experiment> circular_valley() {
  return std::make_unique<test::SumOfSquares>(
      [](double t, const sim::Oscillator& oscillator) -> std::optional<std::array<double, 3>> {
        const double a = oscillator.damping / 100.0;
        const double b = oscillator.mass;
        const double off = a * a + b * b - 1.0;
        if (std::abs(off) > 0.2) return std::nullopt;
        return {{100.0 * off, 20.0 * (std::atan2(b, a) - angle_at_zero - angle_per_t * t), t}};
      });
}

}  // namespace

TEST_CASE("fit: a profile follows a bend of the valley beside which there is no motion", "[identify][fit]") {
  Rig rig = test::rig_with(test::law_case_of("viscous_saturating"));
  rig.known.oscillator.damping = 100.0 * std::cos(angle_at_zero);
  rig.known.oscillator.mass = std::sin(angle_at_zero);
  rig.laws.front().values = {{"coefficient", test::saturating_coefficient}, {"saturation_velocity", 1.0}};
  Experiments experiments;
  experiments.push_back(circular_valley());
  std::vector<FitParameter> parameters = test::sought_in(rig, {"damping", "mass", "saturation_velocity"}, 1.0);
  const Fit fit = fit_rig(rig, std::move(parameters), experiments);
  REQUIRE(fit.outcome.ok());
  // Along the valley the sum of squares is t^2: its end is 1.96 noises away, and the others are on the circle.
  const double z = 1.96;
  const double low = angle_at_zero - angle_per_t * z;
  const double high = angle_at_zero + angle_per_t * z;
  const FittedParameter& speed = test::fitted(fit, "saturation_velocity");
  CHECK(std::log(speed.profile95[0]) == Approx(-z).epsilon(0.03));
  CHECK(std::log(speed.profile95[1]) == Approx(z).epsilon(0.03));
  const FittedParameter& damping = test::fitted(fit, "damping");
  CHECK(damping.profile95[0] == Approx(100.0 * std::cos(high)).margin(2.0));
  CHECK(damping.profile95[1] == Approx(100.0 * std::cos(low)).margin(2.0));
  const FittedParameter& mass = test::fitted(fit, "mass");
  CHECK(mass.profile95[0] == Approx(std::sin(low)).margin(0.02));
  CHECK(mass.profile95[1] == Approx(std::sin(high)).margin(0.02));
}

TEST_CASE("fit: a step of a search takes one motion for each parameter, unless a signal jumps", "[identify][fit]") {
  Rig rig = test::rig_with(test::law_case_of("viscous_saturating"));
  rig.laws.front().values = {{"coefficient", test::saturating_coefficient}, {"saturation_velocity", 2.0}};
  for (const char* signal : {"x", "a"}) {
    CAPTURE(signal);
    std::atomic<int> motions = 0;
    Experiments experiments;
    experiments.push_back(std::make_unique<test::SumOfSquares>(
        [&](double t, const sim::Oscillator& oscillator) -> std::optional<std::array<double, 3>> {
          ++motions;
          return {{t, oscillator.damping, oscillator.mass}};
        }));
    experiments.front()->signals.front().name = signal;
    const std::vector<FitParameter> parameters =
        test::sought_in(rig, {"damping", "mass", "saturation_velocity"}, 1.0);
    const FitProblem problem(rig, parameters, experiments, {1.0, 1.0, 1.0});
    const auto motions_of = [&](bool seeks) {
      motions = 0;
      Eigen::VectorXd outputs;
      Eigen::MatrixXd jacobian;
      REQUIRE(
          problem.derivatives(problem.space().point(Eigen::Vector3d(80.0, 1.0, 2.0)), outputs, jacobian, seeks));
      CHECK(jacobian(20, 0) * std::sqrt(20.0) == Approx(1.0).epsilon(1e-6));
      return motions.load();
    };
    CHECK(motions_of(false) == 1 + 2 * 3);
    CHECK(motions_of(true) == (signal == std::string("a") ? 1 + 2 * 3 : 1 + 3));
  }
}
