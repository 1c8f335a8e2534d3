#include "identify/fit/search/linear_starts.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/fit/fit.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

constexpr double length = 5e-3;
constexpr double slow = 4.0 * std::numbers::pi;
constexpr double fast = 2.7 * slow;

double position(double t) { return length * (std::sin(slow * t) + 0.4 * std::sin(fast * t)); }
double speed(double t) { return length * (slow * std::cos(slow * t) + 0.4 * fast * std::cos(fast * t)); }
double acceleration(double t) {
  return -length * (slow * slow * std::sin(slow * t) + 0.4 * fast * fast * std::sin(fast * t));
}
constexpr double largest_speed = 0.1307;
constexpr double largest_acceleration = 3.0903;

/// 2 s at 500 Hz along two sines, with the force of a law over time and a rig beside it.
Record loop_along(const std::function<double(double t)>& law, double mass, double damping, double noise) {
  History loop{.sample_rate = 500.0};
  const core::RandomStream draws{5, 911};
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / loop.sample_rate;
    loop.x.push_back(position(t));
    loop.v.push_back(speed(t));
    loop.a.push_back(acceleration(t));
    loop.force.push_back(law(t) + mass * acceleration(t) + damping * speed(t) +
                         noise * draws.normal(static_cast<std::uint64_t>(i)));
  }
  Record record;
  record.histories = {loop};
  return record;
}

double falling(double v, double stribeck_velocity) {
  return 1.0 + 0.8 * std::exp(-v * v / (stribeck_velocity * stribeck_velocity));
}

/// A loop with what is sought of a law, of which nothing is stated.
struct Loop {
  Rig rig;
  Experiments experiments;
  std::vector<FitParameter> parameters;

  Loop(const Record& record, const std::string& law, const std::vector<std::string>& names) {
    std::string fault;
    experiments = experiments_of(record, {.name = "loop", .loop = true, .has_mass = true}, fault);
    REQUIRE(fault.empty());
    rig = test::loop_alone(test::rig_with(test::law_case_of(law)));
    rig.laws.front().values = {};
    for (const std::string& name : names) {
      const std::vector<FitParameter> found = named(parameters_of(rig), name, fault);
      REQUIRE(found.size() == 1);
      parameters.push_back(found.front());
    }
    arrange(rig, parameters);
  }

  [[nodiscard]] Eigen::VectorXd fitted(const std::vector<double>& start) const {
    const FitProblem problem(rig, parameters, experiments, sizes_of(parameters, scale_of(rig, experiments)));
    const Eigen::VectorXd values =
        Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
    return LinearStarts(problem, parameters, values).fitted(values);
  }
};

}  // namespace

TEST_CASE("linear starts: levels, mass and damping follow from the loop if the speed is right", "[identify][fit]") {
  constexpr double mass = 3.0;
  constexpr double damping = 40.0;
  constexpr double stribeck_velocity = 0.01;
  const auto law = [](double t) { return std::copysign(falling(speed(t), stribeck_velocity), speed(t)); };
  const Loop loop(loop_along(law, mass, damping, 0.0), "stribeck",
                  {"kinetic", "static", "stribeck_velocity", "mass", "damping"});
  const Eigen::VectorXd found = loop.fitted({200.0, 300.0, stribeck_velocity, 0.01, 7000.0});
  CHECK(found[0] == Approx(1.0).epsilon(1e-6));
  CHECK(found[1] == Approx(1.8).epsilon(1e-6));
  CHECK(found[2] == stribeck_velocity);
  CHECK(found[3] == Approx(mass).epsilon(1e-6));
  CHECK(found[4] == Approx(damping).epsilon(1e-6));
}

TEST_CASE("linear starts: a number that would leave its range stays, and the others follow without it",
          "[identify][fit]") {
  constexpr double mass = 3.0;
  const auto law = [](double t) { return std::copysign(2.0, speed(t)); };
  const Loop loop(loop_along(law, mass, -5.0, 0.0), "coulomb", {"kinetic", "mass", "damping"});
  const Eigen::VectorXd found = loop.fitted({100.0, 0.1, 0.125});
  CHECK(found[2] == 0.125);
  // Coulomb friction stands for what the damper cannot: its share along the two sines.
  double product = 0.0;
  double way = 0.0;
  double count = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double v = speed(i / 500.0);
    product += std::abs(v);
    way += v * acceleration(i / 500.0);
    count += 1.0;
  }
  CHECK(found[0] == Approx(2.0 - 5.125 * product / count).epsilon(0.01));
  CHECK(found[1] == Approx(mass).epsilon(0.01));
  CHECK(std::abs(way) < 0.02 * count);
}

TEST_CASE("linear starts: the forces of a law with a memory have one scale", "[identify][fit]") {
  Rig rig = test::rig_with(test::law_case_of("lugre"));
  Loop loop(test::loop_of(rig, length, 0.0, 1), "lugre",
            {"kinetic", "static", "stribeck_velocity", "sigma0", "sigma1"});
  std::vector<double> truth;
  for (const FitParameter& parameter : loop.parameters)
    truth.push_back(rig.laws.front().values.number(parameter.path));
  // All forces are 300 times too large, and the damper of the bristles is 7 times off beside that.
  const Eigen::VectorXd found =
      loop.fitted({300.0 * truth[0], 300.0 * truth[1], truth[2], 300.0 * truth[3], 2100.0 * truth[4]});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    CAPTURE(loop.parameters[i].name);
    CHECK(found[static_cast<Eigen::Index>(i)] == Approx(truth[i]).epsilon(1e-3));
  }
}

TEST_CASE("linear starts: a small friction with a lag beside a large mass is found with nothing stated",
          "[identify][fit]") {
  constexpr double stribeck_velocity = 0.015 * largest_speed;
  constexpr double lag = 0.03;
  constexpr double mass = 5.0 / largest_acceleration;
  constexpr double damping = 5.0 / largest_speed;
  double late = speed(0.0);
  double now = 0.0;
  // The late velocity by Heun's method, in steps far below the lag.
  const auto law = [&](double t) {
    constexpr double step = 1e-5;
    while (now < t - 0.5 * step) {
      const double first = (speed(now) - late) / lag;
      const double second = (speed(now + step) - late - step * first) / lag;
      late += 0.5 * step * (first + second);
      now += step;
    }
    return std::copysign(falling(late, stribeck_velocity), speed(t));
  };
  constexpr double noise = 0.01;
  const Loop loop(loop_along(law, mass, damping, noise), "friction_lag",
                  {"kinetic", "static", "stribeck_velocity", "lag", "mass", "damping"});
  const Fit fit = fit_rig(loop.rig, loop.parameters, loop.experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  CHECK(fit.signals.front().rms < 1.1 * noise);
  CHECK(test::fitted(fit, "kinetic").value == Approx(1.0).epsilon(0.02));
  CHECK(test::fitted(fit, "lag").value == Approx(lag).epsilon(0.05));
  CHECK(test::fitted(fit, "mass").value == Approx(mass).epsilon(0.01));
}
