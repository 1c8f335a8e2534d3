#include "identify/methods/histories/acceleration_velocity_displacement.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "friction_models/laws/viscous_saturating.hpp"
#include "identify/records/signals.hpp"
#include "tests/identify/estimates.hpp"
#include "tests/identify/histories.hpp"
#include "tests/support/source_tree.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("Exact signals give all parameters to rounding, known or not") {
  // Two levels, so that a = -w^2 x holds for neither mass nor stiffness alone.
  const Record record = record_of({sampled(driven_bearing(11.0, 3.7, 4e-3), 4.0, 500.0),
                                   sampled(driven_bearing(11.0, 3.7, 6e-3, 42.0), 4.0, 500.0)});
  for (const bool know_mass : {true, false}) {
    for (const bool know_stiffness : {true, false}) {
      const KnownConstants constants{know_mass ? 1.042 : unknown, know_stiffness ? 1568.0 : unknown};
      const Estimate e = acceleration_velocity_displacement(record, constants, {});
      if (!know_mass && !know_stiffness) {
        // Neither force nor mass nor stiffness: every multiple of a solution is one.
        CHECK_FALSE(e.outcome.ok());
        continue;
      }
      REQUIRE(e.outcome.ok());
      CHECK(e.usable);
      // Rounding times the condition of the columns, some tens.
      CHECK(e.value.c == Approx(11.0).epsilon(1e-11));
      CHECK(e.value.F0 == Approx(3.7).epsilon(1e-11));
      CHECK(e.value.zeta == Approx(11.0 / (2.0 * std::sqrt(1.042 * 1568.0))).epsilon(1e-11));
      if (!know_mass) CHECK(further(e, "mass").value == Approx(1.042).epsilon(1e-11));
      if (!know_stiffness) CHECK(further(e, "stiffness").value == Approx(1568.0).epsilon(1e-11));
      CHECK(further(e, "offset").value == Approx(0.0).margin(1e-11));
    }
  }
}

TEST_CASE("One level hardly tells mass from stiffness, and the noise of sensors then biases both") {
  // Position to 3 um, acceleration with noise of 0.05 m/s^2, velocity by difference and five-point average. Errors
  // in a regressor flatten its coefficient, and a = -w^2 x nearly, so that m and k sink together.
  Normal normal(5);
  const auto measured = [&normal](double level, double omega) {
    sim::Model model = driven_bearing(11.0, 3.7, 1568.0 * level, omega);
    model.excitation.type = sim::ExcitationType::force_harmonic;
    History history = sampled(model, 8.0, 1000.0, 2.0);
    for (double& x : history.x) x = quantised(x, 3e-6);
    for (double& a : history.a) a += 0.05 * normal();
    history.v = five_point_average(central_difference(history.x, history.sample_rate));
    return history;
  };
  RegressionOptions options;
  options.least_speed = 0.02;  // where the average bends the kink of the velocity
  const auto warned = [](const Estimate& e) {
    return std::ranges::any_of(
        e.warnings, [](const std::string& w) { return w.find("condition number") != std::string::npos; });
  };
  const History first = measured(4e-3, 38.79);
  const Estimate one = acceleration_velocity_displacement(record_of({first}), {}, options);
  const Estimate two = acceleration_velocity_displacement(record_of({first, measured(6e-3, 34.0)}), {}, options);
  const Estimate fixed = acceleration_velocity_displacement(record_of({first}), bearing_constants, options);
  REQUIRE(one.outcome.ok());
  REQUIRE(two.outcome.ok());
  REQUIRE(fixed.outcome.ok());
  CHECK(warned(one));
  CHECK_FALSE(warned(two));
  const double bias = further(one, "mass").value / 1.042 - 1.0;
  CHECK(bias < -0.005);
  CHECK(further(one, "stiffness").value / 1568.0 - 1.0 == Approx(bias).margin(0.01));
  CHECK(std::abs(further(two, "mass").value / 1.042 - 1.0) < 0.3 * std::abs(bias));
  CHECK(std::abs(fixed.value.c / 11.0 - 1.0) < 0.02);
  CHECK(std::abs(fixed.value.F0 / 3.7 - 1.0) < 0.02);
}

TEST_CASE("Standard errors cover the truth where the error is one of the force") {
  // Noise of the force alone, filtered like everything else: 95 % intervals hold the truth in 19 of 20 cases.
  const sim::Model bearing = driven_bearing(11.0, 3.7, 4e-3);
  const History clean = sampled(bearing, 4.0, 500.0, 2.0);
  RegressionOptions options;
  options.cutoffs = {60.0};
  int covered = 0;
  const int cases = 100;
  for (int seed = 0; seed < cases; ++seed) {
    Normal normal(static_cast<std::uint64_t>(seed));
    History noisy = clean;
    for (std::size_t i = 0; i < noisy.x.size(); ++i) noisy.force.push_back(2.0 * normal());
    const Estimate e = acceleration_velocity_displacement(record_of({noisy}), bearing_constants, options);
    REQUIRE(e.outcome.ok());
    covered += e.interval95->c[0] <= 11.0 && 11.0 <= e.interval95->c[1] ? 1 : 0;
    covered += e.interval95->F0[0] <= 3.7 && 3.7 <= e.interval95->F0[1] ? 1 : 0;
  }
  // Binomial: 200 cases at 0.95 have a standard deviation of 1.5 %; both parameters share their noise.
  CHECK(covered >= static_cast<int>(0.91 * 2 * cases));
  CHECK(covered <= static_cast<int>(0.985 * 2 * cases));
}

TEST_CASE("Friction that is not straight over speed is told") {
  sim::Model model = driven_bearing(0.0, 3.16, 6e-3);
  model.friction.emplace_back(friction::ViscousSaturating(18.7, 0.3));
  const Estimate e =
      acceleration_velocity_displacement(record_of({sampled(model, 4.0, 500.0, 1.0)}), bearing_constants, {});
  REQUIRE(e.outcome.ok());
  REQUIRE(e.lack_of_fit);
  CHECK(e.lack_of_fit->fired);
  CHECK_FALSE(e.usable);
  CHECK(e.reason.find("straight line") != std::string::npos);
}

TEST_CASE("A record that cannot be used says why") {
  Normal normal(1);
  History history = displacement_only(sampled(driven_bearing(11.0, 3.7, 4e-3), 1.0, 500.0), 0.0, normal);
  history.force.clear();
  const auto reason = [&](const KnownConstants& constants, const RegressionOptions& options = {}) {
    return acceleration_velocity_displacement(record_of({history}), constants, options).reason;
  };
  CHECK(reason({unknown, unknown}) == "the method needs the mass, the stiffness or a record of the force");
  CHECK(reason({unknown, 0.0}) == "the method needs the mass, the stiffness or a record of the force");
  CHECK(reason({-1.0, 10.0}) == "the mass must be positive and finite");
  RegressionOptions options;
  options.cutoffs = {300.0};
  CHECK(reason(bearing_constants, options) ==
        "no history can be used: a cut-off frequency of 300 Hz is above 0.45 of the sample rate");
  for (double& x : history.x) x = 0.0;
  CHECK(acceleration_velocity_displacement(record_of({history}), bearing_constants, {}).outcome.ok() == false);
}

namespace {

/// The drive train of the EMPS benchmark (janot2019), when it is there; else nothing. Not part of this project.
Record emps() {
  const char* named = std::getenv("DUALDAMP_EMPS");
  const std::string beside = dualdamp::testing::in_tree("../shared/data/emps/estimation.csv").string();
  std::ifstream file(named != nullptr ? named : beside.c_str());
  Record record;
  std::string line;
  if (!std::getline(file, line)) return record;
  History history;
  history.sample_rate = 1000.0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::array<double, 4> row{};  // time, position, reference, force
    for (double& cell : row) {
      cells >> cell;
      cells.ignore(1);
    }
    history.x.push_back(row[1]);
    history.force.push_back(row[3]);
  }
  record.histories.push_back(history);
  return record;
}

}  // namespace

TEST_CASE("A real machine on a rail gives the published parameters with three filters") {
  const Record record = emps();
  if (record.histories.empty()) {
    WARN("skipped: set DUALDAMP_EMPS to the benchmark's estimation.csv");
    return;
  }
  RegressionOptions options;
  options.cutoffs = {50.0, 30.0, 20.0};
  const Estimate e = acceleration_velocity_displacement(record, {unknown, 0.0}, options);
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(std::isnan(e.value.zeta));
  CHECK(std::isnan(e.value.x_f));
  REQUIRE(e.subsets.size() == 3);
  for (const SubsetFit& fit : e.subsets) {
    CAPTURE(fit.label);
    CHECK(further(fit.others, "mass").value == Approx(95.11).epsilon(0.005));
    CHECK(fit.value.c == Approx(203.5).epsilon(0.015));
    CHECK(fit.value.F0 == Approx(20.39).epsilon(0.015));
    CHECK(further(fit.others, "offset").value == Approx(-3.16).margin(0.1));
  }
  // The published values lie within the intervals.
  CHECK(e.interval95->c[0] < 203.5);
  CHECK(e.interval95->c[1] > 203.5);
  CHECK(e.interval95->F0[0] < 20.39);
  CHECK(e.interval95->F0[1] > 20.39);
  const FurtherParameter& mass = further(e, "mass");
  CHECK((*mass.interval95)[0] < 95.11);
  CHECK((*mass.interval95)[1] > 95.11);
  REQUIRE(e.curves.size() == 1);
  CHECK(e.curves[0].name == "friction_velocity");
}
