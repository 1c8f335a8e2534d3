#include "identify/experiments/rig.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/random.hpp"
#include "friction_models/laws/dahl.hpp"
#include "friction_models/registry.hpp"
#include "identify/fit/fit.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

/// What a record of a loop of m = 2 kg, k = 300 N/m, c = 4 N.s/m and 1.2 N of friction holds: force, and some of
/// the signals of two sines at 2 and 5.4 Hz.
struct RigLoop {
  double rate = 250.0;
  bool x = true;
  bool v = true;
  double noise_x = 0.0;  ///< m
  double noise_v = 0.0;  ///< m/s
};

identify::History loop_of_rig(const RigLoop& plan, std::uint64_t seed) {
  identify::History loop{.sample_rate = plan.rate};
  const core::RandomStream draws{seed, 930};
  constexpr double slow = 2.0 * std::numbers::pi * 2.0;
  constexpr double fast = 2.7 * slow;
  const auto samples = static_cast<std::uint64_t>(4.0 * plan.rate);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const double one = slow * static_cast<double>(i) / plan.rate + 0.1;
    const double two = 2.7 * (one - 0.1) + 0.3;
    const double x = 10e-3 * std::sin(one) + 4e-3 * std::sin(two);
    const double v = 10e-3 * slow * std::cos(one) + 4e-3 * fast * std::cos(two);
    const double a = -10e-3 * slow * slow * std::sin(one) - 4e-3 * fast * fast * std::sin(two);
    if (plan.x) loop.x.push_back(x + plan.noise_x * draws.normal(samples * 2 + i));
    if (plan.v) loop.v.push_back(v + plan.noise_v * draws.normal(2 * i));
    loop.force.push_back(2.0 * a + 4.0 * v + 300.0 * x + std::copysign(1.2, v) + 0.02 * draws.normal(2 * i + 1));
  }
  return loop;
}

identify::Fit fit_of_loop(const RigLoop& plan, std::uint64_t seed, double sigma = 0.0) {
  identify::Rig rig = test::rig_with({"coulomb", {{"kinetic", 1.0}}, {"kinetic"}});
  rig.known.oscillator = {.mass = 1.8, .stiffness = 250.0, .damping = 5.0};
  rig.known.excitation = {};
  identify::Record record;
  record.histories.push_back(loop_of_rig(plan, seed));
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(
      record, {.name = "loop", .loop = true, .has_mass = true, .sigma_force = sigma}, fault);
  REQUIRE(fault.empty());
  std::vector<identify::FitParameter> parameters =
      test::sought_in(rig, {"mass", "stiffness", "damping", "kinetic"}, 1.0);
  for (const identify::RecordParameter each :
       identify::sought_of_record(*experiments.front(), identify::feels_position(rig, parameters)))
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  identify::Fit fit = identify::fit_rig(rig, parameters, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  return fit;
}

}  // namespace

TEST_CASE("rig: a number that is neither stated nor sought goes on following the number of its default",
          "[identify][fit]") {
  // Left at 1 N, the static level would refuse every kinetic level above it.
  for (const auto& [law, leader, follower] : {std::tuple{"coulomb", "kinetic", "static"},
                                              {"asymmetric_coulomb", "kinetic_forward", "static_forward"},
                                              {"asymmetric_coulomb", "viscous_forward", "viscous_backward"}}) {
    CAPTURE(law, follower);
    identify::Rig rig = test::rig_with({.law = law, .truth = {}, .sought = {}});
    if (law == std::string("asymmetric_coulomb"))
      rig.laws.front().values = {{"kinetic_forward", 1.0}, {"kinetic_backward", 1.0}};
    std::string fault;
    const std::vector<identify::FitParameter> sought = identify::named(identify::parameters_of(rig), leader, fault);
    REQUIRE(sought.size() == 1);
    std::optional<identify::Rig> fitted = rig;
    for (const double value : {1.0, 1.3}) {
      fitted = identify::with_values(*fitted, sought, Eigen::VectorXd::Constant(1, value));
      REQUIRE(fitted);
      CHECK(identify::model_of(*fitted));
      CHECK_FALSE(fitted->laws.front().values.has(follower));
    }
  }
}

TEST_CASE("rig: a law's number with the name of a record's is told from it", "[identify][fit]") {
  friction::LawEntry entry = *friction::find_law("coulomb");
  entry.parameters.push_back({.name = "offset", .unit = "N", .fallback = 0.0});
  identify::Rig rig = test::rig_with(test::law_case_of("coulomb"));
  rig.laws.front().entry = &entry;
  std::string fault;
  std::vector<identify::FitParameter> sought = identify::named(identify::parameters_of(rig), "offset", fault);
  identify::arrange(rig, sought);
  REQUIRE(sought.size() == 1);
  CHECK(sought.front().name == "friction.offset");
  CHECK(identify::named(identify::parameters_of(rig), sought.front().name, fault).size() == 1);
}

TEST_CASE("loop: a loop without a measured acceleration gives mass and stiffness", "[identify][fit]") {
  // 18 samples of the fast sine's period: differences of second order find 2.045 kg, a hundred standard errors off.
  for (const double rate : {100.0, 250.0})
    for (const bool has_v : {true, false}) {
      const identify::Fit fit = fit_of_loop({.rate = rate, .v = has_v}, 7);
      CAPTURE(rate, has_v, test::fitted(fit, "mass").value, test::fitted(fit, "stiffness").value);
      CHECK(std::abs(test::fitted(fit, "mass").value - 2.0) < 4.0 * test::fitted(fit, "mass").std);
      CHECK(std::abs(test::fitted(fit, "stiffness").value - 300.0) < 4.0 * test::fitted(fit, "stiffness").std);
      CHECK(test::fitted(fit, "mass").std < 2e-3);
    }
}

TEST_CASE("loop: noise of a velocity that is differentiated is filtered, and told", "[identify][fit]") {
  // 0.5 % of v. Of the difference of neighbours alone, the mass is 1.966 kg, ten standard errors off.
  const identify::Fit fit = fit_of_loop({.rate = 1000.0, .noise_v = 6.5e-4}, 8);
  CHECK(std::abs(test::fitted(fit, "mass").value - 2.0) < 4.0 * test::fitted(fit, "mass").std);
  CHECK(fit.signals.front().noise_units > 5.0);
  REQUIRE(fit.warnings.size() == 1);
  CHECK_THAT(fit.warnings.front(), Catch::Contains("though they look like noise"));
  // What was measured is not advised again.
  CHECK_THAT(fit.warnings.front(), Catch::Contains("a is a derivative of v: measure a too, or v with less noise"));
  const identify::Fit less = fit_of_loop({.rate = 1000.0, .noise_v = 1.5e-4}, 8);
  CHECK(less.signals.front().noise_units > 2.0);
  CHECK(less.signals.front().noise_units < 3.0);
  REQUIRE(less.warnings.size() == 1);
  CHECK_THAT(less.warnings.front(), Catch::Contains("though they look like noise"));
  const identify::Fit by_x = fit_of_loop({.rate = 1000.0, .v = false, .noise_x = 1.5e-5}, 8);
  REQUIRE_FALSE(by_x.warnings.empty());
  CHECK_THAT(by_x.warnings.front(), Catch::Contains("measure v and a rather than x"));
  // Noise of x alone, differentiated twice, makes the mass too small by 0.8 %.
  CHECK(test::fitted(by_x, "mass").value == Approx(2.0).epsilon(0.02));
}

TEST_CASE("loop: the filter of a loop without a velocity is no fault of the law", "[identify][fit]") {
  double chi2 = 0.0;
  constexpr int seeds = 6;
  for (int seed = 0; seed < seeds; ++seed) {
    const identify::Fit fit = fit_of_loop({.rate = 500.0, .v = false}, static_cast<std::uint64_t>(seed), 0.02);
    CAPTURE(seed, fit.signals.front().p_value, fit.signals.front().chi2_per_freedom);
    CHECK(fit.warnings.empty());
    chi2 += fit.signals.front().chi2_per_freedom / seeds;
  }
  // About 180 independent readings of each: a standard deviation of 0.05.
  CHECK(chi2 == Approx(1.0).margin(0.2));
}

TEST_CASE("loop: a loop of a velocity alone seeks its first position if there is a spring", "[identify][fit]") {
  // From zero, the stiffness is 288 N/m.
  const identify::Fit fit = fit_of_loop({.rate = 100.0, .x = false}, 9);
  CHECK(std::abs(test::fitted(fit, "mass").value - 2.0) < 4.0 * test::fitted(fit, "mass").std);
  CHECK(std::abs(test::fitted(fit, "stiffness").value - 300.0) < 4.0 * test::fitted(fit, "stiffness").std);
  const double first = 10e-3 * std::sin(0.1) + 4e-3 * std::sin(0.3);
  CHECK(test::fitted(fit, "offset").value == Approx(-first).epsilon(0.01));
  // Friction feels ways only, a stop the position itself.
  const identify::Rig free = test::loop_alone(test::rig_with(test::law_case_of("contact_compliance")));
  CHECK(!identify::feels_position(free, {}));
  CHECK(identify::feels_position(test::loop_alone(test::rig_with(test::law_case_of("gap_spring"))), {}));
}

TEST_CASE("rig: whether a rig feels its position does not depend on the size of its forces", "[identify][fit]") {
  for (const double size : {1e-9, 1.0, 1e9}) {
    const auto feels = [&](const char* law, friction::ParameterValues values) {
      return identify::feels_position(test::loop_alone(test::rig_with({law, std::move(values), {}})), {});
    };
    CAPTURE(size);
    CHECK(feels("gap_spring", {{"stiffness", 1e-2 * size}, {"gap", 1e-3}}));
    CHECK(feels("coulomb", {{"kinetic", size}, {"position_slope", 1e-3 * size}}));
    CHECK(!feels("coulomb", {{"kinetic", size}, {"drift", 1e-3}}));
    CHECK(!feels("iwan", {{"stiffness", 1.7e3 * size}, {"limit", size}, {"count", 9.0}}));
    CHECK(
        !feels("bristle", {{"stiffness", 1.7e3 * size}, {"snap_distance", 1e-6}, {"count", 20.0}, {"seed", 3.0}}));
    CHECK(!feels("attached_mass", {{"mass", 1e-3 * size}, {"stiffness", size}, {"damping", 1e-2 * size}}));
  }
}

namespace {

/// The force of friction that rises with the way as Dahl's: 2 N, 3000 N/m; samples of x = 10 mm sin(4 pi t).
identify::History loop_of_one_sine(bool has_x, double mass, double stiffness) {
  constexpr double omega = 4.0 * std::numbers::pi;
  constexpr double rate = 500.0;
  identify::History loop{.sample_rate = rate};
  const core::RandomStream draws{11, 932};
  sim::LawHost bristles(friction::Law(friction::Dahl(2.0, 3000.0, 1.0)), {});
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double t = static_cast<double>(i) / rate;
    const double x = 0.01 * std::sin(omega * t);
    bristles.move_to(x);
    if (has_x) loop.x.push_back(x);
    loop.v.push_back(0.01 * omega * std::cos(omega * t));
    loop.force.push_back((stiffness - mass * omega * omega) * x + 3.0 * loop.v.back() + bristles.force() +
                         0.01 * draws.normal(i));
  }
  return loop;
}

identify::Fit fit_of_one_sine(const identify::Rig& rig, const identify::History& loop,
                              std::vector<identify::FitParameter> parameters) {
  identify::Record record;
  record.histories.push_back(loop);
  std::string fault;
  const identify::Experiments experiments =
      identify::experiments_of(record, {.name = "loop", .loop = true, .has_mass = true}, fault);
  REQUIRE(fault.empty());
  for (const identify::RecordParameter each :
       identify::sought_of_record(*experiments.front(), identify::feels_position(rig, parameters)))
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  identify::Fit fit = identify::fit_rig(rig, parameters, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  return fit;
}

}  // namespace

TEST_CASE("loop: mass and spring of one sine are not told apart, and the search ends", "[identify][fit]") {
  // Along the direction that nothing holds, the search came to bristles that relax in a nanosecond, and never
  // ended.
  identify::Rig rig = test::loop_alone(test::rig_with(test::law_case_of("dahl")));
  rig.laws.front().values = {};
  std::vector<std::string> faults;
  const identify::Fit fit =
      fit_of_one_sine(rig, loop_of_one_sine(false, 2.0, 100.0), identify::unstated_parameters(rig, faults));
  CHECK(test::fitted(fit, "kinetic").value == Approx(2.0).epsilon(0.01));
  for (const char* name : {"mass", "stiffness"}) {
    CAPTURE(name);
    CHECK(std::isnan(test::fitted(fit, name).std));
    CHECK(std::isnan(test::fitted(fit, name).interval95[0]));
    CHECK(std::ranges::count(fit.not_identifiable.at(0).parameters, name) == 1);
  }
}

TEST_CASE("loop: a spring that is nearly zero leaves the mass of one sine open", "[identify][fit]") {
  // A factor e of 1e-3 N/m changes nothing; but what a spring up to 10 N/m does is what 0.06 kg do.
  identify::Rig rig = test::rig_with(test::law_case_of("dahl"));
  rig.known.oscillator = {.mass = 2.0, .stiffness = 1e-3, .damping = 3.0};
  rig.known.excitation = {};
  const identify::Fit fit =
      fit_of_one_sine(rig, loop_of_one_sine(true, 2.0, 1e-3), test::sought_in(rig, {"mass", "stiffness"}, 1.0));
  CHECK(std::isnan(test::fitted(fit, "mass").std));
  CHECK(std::isnan(test::fitted(fit, "stiffness").std));
}

TEST_CASE("loop: bristles follow the motion between the samples", "[identify][fit]") {
  // A straight line of velocity between samples would move them by a thousandth less.
  const identify::Rig rig = test::loop_alone(test::rig_with(test::law_case_of("dahl")));
  const auto forces = [&](double rate) {
    identify::Record record;
    record.histories.push_back(loop_of_rig({.rate = rate}, 1));
    std::string fault;
    const identify::Experiments experiments =
        identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
    REQUIRE(fault.empty());
    Eigen::VectorXd force;
    REQUIRE(experiments.front()->predict(*identify::model_of(rig), {}, force));
    return force;
  };
  constexpr Eigen::Index finer = 40;
  const Eigen::VectorXd coarse = forces(500.0);
  const Eigen::VectorXd fine = forces(500.0 * finer);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < coarse.size(); ++i)
    largest = std::max(largest, std::abs(coarse[i] - fine[i * finer]));
  CHECK(largest < 2e-4);
}

TEST_CASE("experiments: every history that cannot be used is named with its own reason", "[identify][fit]") {
  identify::Record record;
  record.histories.push_back({.sample_rate = 100.0, .x = std::vector<double>(5, 1e-3), .sweep = "short"});
  record.histories.push_back({.sample_rate = 100.0, .x = std::vector<double>(50, 1e-3), .sweep = "good"});
  record.histories.push_back({.sample_rate = 100.0, .force = std::vector<double>(50, 1.0), .sweep = "still"});
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  REQUIRE(experiments.size() == 1);
  CHECK(experiments.front()->label == "record, good");
  CHECK(fault == "short: a history needs eight samples; still: a history needs one of the columns x, v, a");
}
