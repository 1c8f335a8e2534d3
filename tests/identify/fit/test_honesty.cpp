#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "identify/fit/comparison.hpp"
#include "identify/fit/fit.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/records/rest_samples.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using identify::Fit;
using identify::FittedParameter;

namespace {

struct RestingLoop {
  bool x = true;
  bool v = true;
  double noise_v = 0.0;       // m/s
  double static_level = 2.0;  // N
};

/// Moves of 0.25 s, at rest for 0.15 s between them: m = 1 kg, c = 2 N.s/m, k = 300 N/m, 2 N of friction. At rest
/// the friction holds the mass with a force that the law does not tell.
identify::History resting_loop(const RestingLoop& plan) {
  constexpr double rate = 500.0;
  constexpr double move = 0.25;
  constexpr double rest = 0.15;
  const core::RandomStream draws{17, 2026};
  identify::History loop{.sample_rate = rate};
  double from = 0.0;
  for (std::uint64_t stroke = 0; stroke < 12; ++stroke) {
    const double to = (stroke % 2 == 0 ? 1.0 : -1.0) * (4e-3 + 0.5e-3 * static_cast<double>(stroke % 5));
    const double way = to - from;
    const double held = plan.static_level * (0.98 * std::cos(2.0 * static_cast<double>(stroke)));
    for (int i = 0; i < static_cast<int>((move + rest) * rate); ++i) {
      const double s = std::min(1.0, i / (move * rate));
      const double x = from + way * s * s * s * (10.0 + s * (6.0 * s - 15.0));
      const double v = way / move * s * s * (30.0 + s * (30.0 * s - 60.0));
      const double a = way / (move * move) * s * (60.0 + s * (120.0 * s - 180.0));
      const double at_rest = (i / rate - move) / rest;
      const double friction = s < 1.0 ? std::copysign(2.0, way) : held * at_rest;
      const auto sample = static_cast<std::uint64_t>(loop.force.size());
      if (plan.x) loop.x.push_back(x);
      if (plan.v) loop.v.push_back(v + plan.noise_v * draws.normal(2 * sample + 1));
      loop.force.push_back(a + 2.0 * v + 300.0 * x + friction + 0.01 * draws.normal(2 * sample));
    }
    from = to;
  }
  return loop;
}

Fit fit_of_resting_loop(const RestingLoop& plan, bool robust = false, bool profile = false,
                        double most_damping = core::infinity) {
  identify::Record record;
  record.histories.push_back(resting_loop(plan));
  std::string fault;
  const identify::Experiments experiments =
      identify::experiments_of(record, {.name = "loop", .loop = true, .has_mass = true}, fault);
  REQUIRE(fault.empty());
  identify::Rig rig = test::rig_with({"coulomb", {{"kinetic", 2.0}}, {"kinetic"}});
  rig.known.oscillator = {.mass = 1.0, .stiffness = 300.0, .damping = 2.0};
  rig.known.excitation = {};
  std::vector<identify::FitParameter> parameters =
      test::sought_in(rig, {"mass", "stiffness", "damping", "kinetic"}, 1.3);
  for (const identify::RecordParameter each : identify::sought_of_record(*experiments.front(), true))
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  std::ranges::find(parameters, "damping", &identify::FitParameter::name)->range.high = most_damping;
  Fit fit = identify::fit_rig(rig, parameters, experiments, {.robust = robust, .profile = profile});
  REQUIRE(fit.outcome.ok());
  return fit;
}

}  // namespace

TEST_CASE("loop: a mass at rest says nothing about rigid friction", "[identify][fit]") {
  // With 0 N of friction at rest, the mass is 1.4 kg and the stiffness 390 N/m.
  for (const RestingLoop& plan :
       {RestingLoop{}, RestingLoop{.x = false}, RestingLoop{.v = false}, RestingLoop{.noise_v = 2e-4}})
    for (const bool robust : {false, true}) {
      const Fit fit = fit_of_resting_loop(plan, robust);
      CAPTURE(plan.x, plan.v, plan.noise_v, robust);
      for (const auto& [name, truth] :
           {std::pair{"mass", 1.0}, {"stiffness", 300.0}, {"damping", 2.0}, {"kinetic", 2.0}}) {
        CAPTURE(name, test::fitted(fit, name).value, test::fitted(fit, name).std);
        CHECK(std::abs(test::fitted(fit, name).value - truth) < 4.0 * test::fitted(fit, name).std);
      }
      CHECK(test::fitted(fit, "mass").std < 4e-3);
      CHECK(fit.signals.front().freedom < 0.8 * static_cast<double>(fit.signals.front().rows.end));
    }
}

TEST_CASE("fit: an interval without a profile, beside a parameter at the end of its range, comes with a warning",
          "[identify][fit]") {
  const auto warns = [](bool profile, double most_damping) {
    const Fit fit = fit_of_resting_loop({}, false, profile, most_damping);
    CHECK(test::fitted(fit, "damping").at_bound == (most_damping < 2.0));
    return std::ranges::any_of(fit.warnings, [](const std::string& warning) {
      return warning.starts_with("damping is at the end of the range: without profiles");
    });
  };
  CHECK(warns(false, 1.9));
  CHECK_FALSE(warns(true, 1.9));
  CHECK_FALSE(warns(false, core::infinity));
}

TEST_CASE("loop: a mass that sticks under more than the friction holds is told", "[identify][fit]") {
  CHECK(fit_of_resting_loop({}).warnings.empty());
  const Fit fit = fit_of_resting_loop({.static_level = 3.0});
  REQUIRE(fit.warnings.size() == 1);
  CHECK_THAT(fit.warnings.front(), Catch::Contains("the friction of the fit holds at most 2 N"));
}

TEST_CASE("loop: a contact that reverses within some samples is told where the acceleration was not measured",
          "[identify][fit]") {
  // At some 3 m/s^2 the contact of 2 N reverses within 0.8 samples at 1e6 N/m, and within 18 at 2e3 N/m.
  const auto objections = [](double stiffness, bool has_mass) {
    const identify::Rig rig = test::rig_with(
        {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", stiffness}}, {"contact_stiffness"}});
    std::string fault;
    const identify::Experiments experiments = identify::experiments_of(
        test::loop_of(rig, 5e-3, 0.0, 1), {.name = "loop", .loop = true, .has_mass = has_mass}, fault);
    REQUIRE(fault.empty());
    return experiments.front()->objections(*identify::model_of(test::loop_alone(rig)), {});
  };
  const std::vector<std::string> fast = objections(1e6, true);
  REQUIRE(fast.size() == 1);
  CHECK_THAT(fast.front(), Catch::Contains("measure a, or sample faster"));
  CHECK(objections(2e3, true).empty());
  CHECK(objections(1e6, false).empty());
}

TEST_CASE("loop: samples rest at zero speed, or where noise stays at one level", "[identify][fit]") {
  const auto resting = [](const std::vector<double>& v, double noise, std::size_t spread) {
    std::string marks;
    for (const bool rests : identify::rest_samples(v, noise, spread)) marks += rests ? 'r' : '.';
    return marks;
  };
  CHECK(resting({5.0, 0.0, 4.9, 0.0, 0.0, 0.0, 6.0, 0.2}, 0.0, 0) == ".r.rrr..");
  CHECK(resting({5.0, 4.0, 4.9, 0.0, 0.0, 0.0, 6.0, 0.2}, 0.0, 1) == "..rrrrr.");
  // A lone sample above the noise between two below it rests as well; a reversal does not.
  CHECK(resting({9.0, 0.1, -0.2, 0.1, 0.1, 0.5, -0.1, 0.2, 0.02, -0.1, 9.0}, 0.1, 0) == ".rrrrrrrrr.");
  CHECK(resting({9.0, 0.4, 0.3, 0.2, 0.1, 0.05, -0.1, -0.2, -0.3, -0.4, -9.0}, 0.1, 0) == "...........");
}

TEST_CASE("fit: intervals beside a parameter at its bound hold what trades with it", "[identify][fit]") {
  // Of v alone, a constant force is a displacement: the levels of both directions and the first position are known
  // up to one number. The search ends where a level is zero. The profiles stayed there, because the static level
  // has nearly no effect and ran away: position 0.99 to 1.001 mm, true 2 mm.
  identify::Rig truth = test::rig_with(
      {"asymmetric_coulomb",
       {{"kinetic_forward", 2.0}, {"kinetic_backward", 1.0}, {"static_forward", 2.5}, {"static_backward", 1.2}},
       {"kinetic_forward"}});
  identify::Record record = test::history_of(truth, {.duration = 3.0, .noise_v = 4e-4, .initial = {2e-3, 0.01}}, 1);
  record.histories.front().x.clear();
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  REQUIRE(fault.empty());
  identify::Rig sought = truth;
  sought.laws.front().values = {};
  std::vector<std::string> faults;
  std::vector<identify::FitParameter> parameters = identify::unstated_parameters(sought, faults);
  for (const char* name : {"static_forward", "static_backward"})
    for (identify::FitParameter& parameter : identify::named(identify::parameters_of(sought), name, fault))
      parameters.push_back(std::move(parameter));
  identify::arrange(sought, parameters);
  for (const identify::RecordParameter each : experiments.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  const Fit fit = identify::fit_rig(sought, parameters, experiments);
  REQUIRE(fit.outcome.ok());
  for (const auto& [name, true_value] : {std::pair{"kinetic_forward", 2.0},
                                         {"kinetic_backward", 1.0},
                                         {"static_backward", 1.2},
                                         {"position", 2e-3}}) {
    const FittedParameter& fitted = test::fitted(fit, name);
    CAPTURE(name, fitted.value, fitted.interval95[0], fitted.interval95[1], fitted.reason);
    CHECK((std::isnan(fitted.interval95[0]) || fitted.interval95[0] <= true_value));
    CHECK((std::isnan(fitted.interval95[1]) || fitted.interval95[1] >= true_value));
  }
}

TEST_CASE("fit: robust fits are compared by Huber's sum", "[identify][fit]") {
  // Two laws of equal outliers, one of which misses the other readings by a tenth of their deviation.
  const core::RandomStream draws{5, 1985};
  constexpr Eigen::Index count = 1000;
  std::vector<Fit> fits(2);
  for (std::size_t f = 0; f < 2; ++f) {
    Eigen::VectorXd misses(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto draw = static_cast<std::uint64_t>(i);
      misses[i] = draws.normal(draw) + (f == 0 ? 0.4 : 0.0);
      if (i % 50 == 0) misses[i] = 300.0 * draws.normal(draw);
    }
    const double rms = misses.norm() / std::sqrt(static_cast<double>(count));
    fits[f].signals.push_back({.rows = {.end = count},
                               .rms = f == 0 ? 0.999 * rms : rms,
                               .range = 100.0,
                               .independent = static_cast<double>(count),
                               .freedom = static_cast<double>(count - 1),
                               .misses = misses});
    fits[f].parameters.resize(f == 0 ? 1 : 2);
    fits[f].log_likelihood_count = static_cast<double>(count);
  }
  identify::compare_fits(fits);
  CHECK(fits[0].AICc < fits[1].AICc);
  identify::compare_fits(fits, true);
  CHECK(fits[0].AICc > fits[1].AICc + 50.0);
  // A parameter counts 2 E(psi^2)/E(psi'): 1.73 for normal residuals, 1.82 with 2 % of outliers.
  fits[0].signals = fits[1].signals;
  identify::compare_fits(fits, true);
  CHECK(fits[1].AICc - fits[0].AICc == Approx(1.82).epsilon(0.05));
}

TEST_CASE("fit: a history shorter than one period is told", "[identify][fit]") {
  const auto warned = [](double duration) {
    const test::LawCase law = test::law_case_of("coulomb");
    const Fit fit = test::fit_of(law, 3, {.duration = duration}, false);
    return std::ranges::count_if(fit.warnings, [](const std::string& warning) {
      return warning.find("less than one period of the drive, 0.25 s") != std::string::npos;
    });
  };
  CHECK(warned(0.2) == 1);
  CHECK(warned(0.5) == 0);
}
