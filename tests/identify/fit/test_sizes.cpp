// The sizes of parameters, and what a fit says of one that ends where its search ends.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/fit/fit.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

/// 4 s of two sines with a largest speed of some 1.3 `speed`, against a force of the speed, with noise of 0.01 N.
template <typename Force>
identify::Record loop_against(const Force& force, double speed, double noise = 0.01) {
  identify::History loop{.sample_rate = 250.0};
  const core::RandomStream draws{11, 877};
  for (std::uint64_t i = 0; i < 1000; ++i) {
    constexpr double slow = 6.283;
    constexpr double fast = 14.45;
    const double t = static_cast<double>(i) / loop.sample_rate;
    loop.x.push_back(-speed * (std::cos(slow * t + 0.2) / slow + 0.3 * std::cos(fast * t) / fast));
    loop.v.push_back(speed * (std::sin(slow * t + 0.2) + 0.3 * std::sin(fast * t)));
    loop.force.push_back(force(loop.v.back()) + noise * draws.normal(i));
  }
  identify::Record record;
  record.histories.push_back(std::move(loop));
  return record;
}

/// A law without an oscillator. What is not stated is sought; of what is stated, `also`.
identify::Fit fit_of_loop(const std::string& law, const friction::ParameterValues& stated,
                          const identify::Record& record, const std::vector<std::string>& also = {}) {
  identify::Rig rig = test::loop_alone(test::rig_with(test::law_case_of(law)));
  rig.laws[0].values = stated;
  std::vector<std::string> faults;
  std::vector<identify::FitParameter> parameters = identify::unstated_parameters(rig, faults);
  std::erase_if(parameters, [](const auto& parameter) { return parameter.owner != identify::Owner::law; });
  for (const identify::FitParameter& parameter : identify::parameters_of(rig))
    if (std::ranges::find(also, parameter.name) != also.end()) parameters.push_back(parameter);
  identify::arrange(rig, parameters);
  std::string fault;
  const identify::Experiments experiments =
      identify::experiments_of(record, {.name = "record", .loop = true, .has_mass = false}, fault);
  REQUIRE(fault.empty());
  identify::Fit fit = identify::fit_rig(rig, std::move(parameters), experiments);
  REQUIRE(fit.outcome.ok());
  return fit;
}

bool has_reached_the_limit(const identify::Fit& fit, const std::string& name) {
  return std::ranges::any_of(fit.warnings, [&](const std::string& warning) {
    return warning.starts_with(name + " reached the limit of the search");
  });
}

}  // namespace

TEST_CASE("sizes: a force at a speed a thousand times that of the motion is found", "[identify][fit]") {
  // Drag of 3 N at 1 mm/s is 3e6 N at 1 m/s. From the size of a force, the search ended at 7e5 N.
  constexpr double speed = 1e-3;
  constexpr double coefficient = 3e6;
  const identify::Record record = loop_against([](double v) { return coefficient * v * std::abs(v); }, speed);
  for (const bool knows_the_power : {true, false}) {
    CAPTURE(knows_the_power);
    const friction::ParameterValues stated =
        knows_the_power ? friction::ParameterValues{{"exponent", 2.0}} : friction::ParameterValues{};
    const identify::Fit fit = fit_of_loop("viscous_power", stated, record);
    const identify::FittedParameter& found = test::fitted(fit, "coefficient");
    CHECK(!found.at_bound);
    CHECK(found.interval95[0] < coefficient);
    CHECK(coefficient < found.interval95[1]);
    CHECK(found.std < (knows_the_power ? 0.002 : 0.03) * coefficient);
    if (!knows_the_power) CHECK(test::fitted(fit, "exponent").value == Approx(2.0).epsilon(0.005));
    CHECK(fit.noise_units == Approx(1.0).margin(0.1));
    CHECK(fit.not_identifiable.empty());
  }
}

TEST_CASE("sizes: the derivatives of a force that is sought at another speed are those of its value",
          "[identify][fit]") {
  const identify::Rig rig = test::rig_with(test::law_case_of("viscous_power"));
  std::vector<identify::FitParameter> parameters;
  for (const identify::FitParameter& parameter : identify::parameters_of(rig))
    if (parameter.owner == identify::Owner::law && parameter.path.find('.') == std::string::npos &&
        (parameter.at_speed || parameter.path == "reference_velocity" || parameter.path == "exponent"))
      parameters.push_back(parameter);
  REQUIRE(parameters.size() == 3);
  identify::arrange(rig, parameters);
  REQUIRE(parameters[0].at_speed);
  parameters[0].at_speed->sought_at = 0.02;
  const identify::FitProblem problem(rig, parameters, {}, {4.0, 0.5, 1.5});
  const Eigen::Vector3d q(1.7, 0.3, -0.4);
  // c = 4 q0 (v0/0.02)^n/(0.5/0.02)^1.5
  const double v0 = 0.5 * std::exp(0.3);
  const double n = 1.5 * std::exp(-0.4);
  CHECK(problem.space().values(q)[0] == Approx(4.0 * 1.7 * std::pow(v0 / 0.02, n) / std::pow(25.0, 1.5)));
  CHECK((problem.space().point(problem.space().values(q)) - q).norm() < 1e-12);
  const Eigen::MatrixXd slope = problem.space().slope(q);
  constexpr double step = 1e-6;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const Eigen::Vector3d change = step * Eigen::Vector3d::Unit(j);
    const Eigen::VectorXd expected =
        (problem.space().values(q + change) - problem.space().values(q - change)) / (2.0 * step);
    CHECK((slope.col(j) - expected).norm() < 1e-7 * (1.0 + expected.norm()));
  }
}

TEST_CASE("sizes: those of units that no law of the registry has follow from their dimension", "[identify][fit]") {
  const identify::DataScale scale{.mass = 2.0, .force = 3.0, .length = 0.01, .speed = 0.5};
  constexpr double time = 0.02;
  const auto size_in = [&](const std::string& unit) {
    return identify::sizes_of({{.name = "number", .unit = unit, .range = friction::positive}}, scale).front();
  };
  CHECK(size_in("N.s^3/m^3") == Approx(3.0 * std::pow(time / 0.01, 3)));
  CHECK(size_in("kg/m") == Approx(3.0 * time * time / 0.01 / 0.01));
  CHECK(size_in("m2/s") == Approx(0.01 * 0.01 / time));
  CHECK(size_in("1/m") == Approx(0.3 / 0.01));
  CHECK(size_in("K") == 1.0);
}

TEST_CASE("sizes: a parameter that may be zero says so if it reached the largest value of the search",
          "[identify][fit]") {
  // A stated friction force of 1 uN is sought up to 1 N only.
  const identify::Record record = loop_against([](double v) { return std::copysign(3.0, v); }, 0.1);
  const identify::Fit fit = fit_of_loop("coulomb", {{"kinetic", 1e-6}}, record, {"kinetic"});
  CHECK(test::fitted(fit, "kinetic").at_bound);
  CHECK(has_reached_the_limit(fit, "kinetic"));
  CHECK(fit.not_identifiable.empty());
  // Zero is an end of the law, not of the search.
  const identify::Fit none = fit_of_loop("coulomb", {}, loop_against([](double v) { return -1e-3 * v; }, 0.1));
  CHECK(test::fitted(none, "kinetic").value == 0.0);
  CHECK(!has_reached_the_limit(none, "kinetic"));
}
