#include "identify/fit/parallel_elements.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "identify/fit/fit.hpp"
#include "identify/fit/search/steps.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

using List = std::vector<friction::ParameterValues>;

struct Spring {
  double stiffness;
  double limit;
};

/// A loop of springs that slip, each followed on its own: its force changes by k dx and stays within its limit.
identify::Record loop_of_springs(const std::vector<Spring>& springs, double noise, std::uint64_t seed) {
  identify::History loop{.sample_rate = 500.0};
  const core::RandomStream draws{seed, 905};
  std::vector<double> forces(springs.size(), 0.0);
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / loop.sample_rate;
    constexpr double slow = 4.0 * std::numbers::pi;
    constexpr double fast = 2.7 * slow;
    const double before = loop.x.empty() ? 0.0 : loop.x.back();
    loop.x.push_back(5e-3 * (std::sin(slow * t) + 0.4 * std::sin(fast * t)));
    loop.v.push_back(5e-3 * (slow * std::cos(slow * t) + 0.4 * fast * std::cos(fast * t)));
    double sum = 0.0;
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const auto& [k, limit] = springs[s];
      forces[s] = std::clamp(forces[s] + k * (loop.x.back() - before), -limit, limit);
      sum += forces[s];
    }
    loop.force.push_back(sum + noise * draws.normal(static_cast<std::uint64_t>(i)));
  }
  identify::Record record;
  record.histories = {loop};
  return record;
}

identify::Fit fit_to(const identify::Record& record, const test::LawCase& law) {
  std::string fault;
  const identify::Experiments loops = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  REQUIRE(fault.empty());
  identify::Rig rig = test::loop_alone(test::rig_with(law));
  return identify::fit_rig(rig, test::sought_in(rig, law.sought, 1.0), loops, {.profile = false});
}

}  // namespace

TEST_CASE("parallel elements: equal start values lead to springs that differ, told in the order in which they slip",
          "[identify][fit][loop]") {
  const std::vector<Spring> truth = {{3000.0, 1.0}, {1500.0, 2.0}, {400.0, 1.6}};  // slip at 0.33, 1.33 and 4 mm
  const friction::ParameterValues equal = {{"stiffness", 1000.0}, {"limit", 1.0}};
  const identify::Fit fit =
      fit_to(loop_of_springs(truth, 0.02, 3), {"iwan", {{"elements", List{equal, equal, equal}}}, {"elements"}});
  REQUIRE(fit.outcome.ok());
  CHECK(fit.warnings.empty());
  CHECK(fit.noise_units == Approx(1.0).margin(0.1));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::string item = "elements[" + std::to_string(i) + "].";
    const identify::FittedParameter& stiffness = test::fitted(fit, item + "stiffness");
    const identify::FittedParameter& limit = test::fitted(fit, item + "limit");
    CAPTURE(item, stiffness.value, limit.value);
    CHECK(stiffness.value == Approx(truth[i].stiffness).margin(4.0 * stiffness.std));
    CHECK(limit.value == Approx(truth[i].limit).margin(4.0 * limit.std));
    CHECK(stiffness.std < 0.05 * truth[i].stiffness);
  }
}

TEST_CASE("parallel elements: a level that falls with speed is found from equal start values",
          "[identify][fit][loop]") {
  const friction::ParameterValues equal = {{"stiffness", 1000.0}, {"share", 0.5}};
  const identify::Record record =
      test::loop_of(test::rig_with(test::law_case_of("generalized_maxwell_slip")), 5e-3, 0.01, 4);
  const test::LawCase law{"generalized_maxwell_slip",
                          {{"elements", List{equal, equal}},
                           {"kinetic", 0.3},
                           {"static", 0.6},
                           {"stribeck_velocity", 0.2},
                           {"attraction", 20.0}},
                          {"elements", "kinetic", "static", "stribeck_velocity", "attraction"}};
  const identify::Fit fit = fit_to(record, law);
  REQUIRE(fit.outcome.ok());
  CHECK(fit.signals.front().rms == Approx(0.01).epsilon(0.1));
  CHECK(test::fitted(fit, "elements[0].stiffness").value == Approx(6000.0).epsilon(0.1));
  CHECK(test::fitted(fit, "elements[0].share").value == Approx(0.4).epsilon(0.05));
  CHECK(test::fitted(fit, "elements[1].stiffness").value == Approx(1000.0).epsilon(0.05));
  CHECK(test::fitted(fit, "kinetic").value == Approx(1.0).epsilon(0.02));
}

TEST_CASE("parallel elements: two that slip close to each other are not taken for one", "[identify][fit][loop]") {
  // The grid alone prefers one element for both, and another one for the rise of the force at low speed.
  const auto element = [](double stiffness, double share) {
    return friction::ParameterValues{{"stiffness", stiffness}, {"share", share}};
  };
  const std::vector<std::string> sought = {"elements", "kinetic", "static", "stribeck_velocity", "attraction"};
  const auto law = [&](const List& elements) {
    return test::LawCase{"generalized_maxwell_slip",
                         {{"elements", elements},
                          {"kinetic", 1.1161},
                          {"static", 1.7831},
                          {"stribeck_velocity", 4.174e-3},
                          {"attraction", 190.2}},
                         sought};
  };
  const identify::Record record = test::loop_of(
      test::rig_with(law({element(5736.2, 0.23723), element(5122.8, 0.38299), element(1168.8, 0.37978)})), 1.1e-3,
      0.01, 4);
  const double third = 1.0 / 3.0;
  const identify::Fit fit =
      fit_to(record, law({element(4000.0, third), element(4000.0, third), element(4000.0, 1.0 - 2.0 * third)}));
  REQUIRE(fit.outcome.ok());
  CHECK(fit.signals.front().rms == Approx(0.01).epsilon(0.1));
  CHECK(test::fitted(fit, "elements[0].stiffness").value == Approx(5736.2).epsilon(0.1));
  CHECK(test::fitted(fit, "elements[0].share").value == Approx(0.23723).epsilon(0.1));
  CHECK(test::fitted(fit, "elements[1].stiffness").value == Approx(5122.8).epsilon(0.1));
}

TEST_CASE("parallel elements: three elements and their level are found with nothing stated but their number",
          "[identify][fit][loop]") {
  const auto element = [](double stiffness, double share) {
    return friction::ParameterValues{{"stiffness", stiffness}, {"share", share}};
  };
  const identify::Record record = test::loop_of(
      test::rig_with({"generalized_maxwell_slip",
                      {{"elements", List{element(9000.0, 0.3), element(1500.0, 0.4), element(500.0, 0.3)}},
                       {"kinetic", 1.0},
                       {"static", 1.4},
                       {"stribeck_velocity", 0.03},
                       {"attraction", 60.0}},
                      {}}),
      5e-3, 0.01, 6);
  std::string fault;
  const identify::Experiments loops = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  identify::Rig rig = test::loop_alone(test::rig_with(test::law_case_of("generalized_maxwell_slip")));
  rig.laws.front().values = {{"elements", List(3)}};
  std::vector<std::string> faults;
  std::vector<identify::FitParameter> sought = identify::unstated_parameters(rig, faults);
  CHECK(faults.empty());
  std::erase_if(sought, [](const identify::FitParameter& one) { return one.owner != identify::Owner::law; });
  CHECK(std::ranges::all_of(sought, [](const identify::FitParameter& one) { return std::isnan(one.stated); }));
  identify::arrange(rig, sought);
  REQUIRE(sought.size() == 9);
  const identify::Fit fit = identify::fit_rig(rig, sought, loops, {.profile = false});
  REQUIRE(fit.outcome.ok());
  CHECK(fit.signals.front().rms == Approx(0.01).epsilon(0.1));
  CHECK(test::fitted(fit, "kinetic").value == Approx(1.0).epsilon(0.03));
  CHECK(test::fitted(fit, "elements[0].stiffness").value == Approx(9000.0).epsilon(0.1));
}

TEST_CASE("steps: a fall that is over before the lowest speed is no parameter that acts in steps",
          "[identify][fit][loop]") {
  const identify::Rig whole = test::rig_with(test::law_case_of("stribeck"));
  std::string fault;
  const identify::Experiments loops =
      identify::experiments_of(test::loop_of(whole, 5e-3, 0.01, 3), {.name = "loop", .loop = true}, fault);
  identify::Rig rig = test::loop_alone(whole);
  const std::vector<identify::FitParameter> sought =
      test::sought_in(rig, {"kinetic", "static", "stribeck_velocity"}, 1.0);
  const identify::FitProblem problem(rig, sought, loops, {1.0, 1.6, 0.05});
  for (double velocity = 1e-5; velocity < 1e-2; velocity *= 1.15) {
    CAPTURE(velocity);
    const std::vector<bool> stepped =
        identify::stepped_parameters(problem, problem.space().point(Eigen::Vector3d(1.0, 1.6, velocity)));
    CHECK(std::ranges::count(stepped, true) == 0);
  }
}
