// Branches whose orbits close to the error of the engine or to rounding only.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "friction_models/laws/attached_mass.hpp"
#include "friction_models/laws/bouc_wen.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/dahl.hpp"
#include "friction_models/laws/lugre.hpp"
#include "friction_models/laws/stribeck.hpp"
#include "sim/curves/continuation.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using sim::BranchParameter;

namespace {

sim::Model smooth(friction::Law law, double tolerance) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.5, .frequency = 0.8};
  model.friction.push_back(std::move(law));
  model.solver.tolerance = tolerance;
  return model;
}

sim::Model stiff_coulomb() {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 0.011, .frequency = 6.283185307179586};
  model.friction.emplace_back(friction::Coulomb(1.0, 1.0));
  return model;
}

/// Largest relative difference between the amplitudes of the branch and steady states found one by one.
double largest_error(const sim::Branch& branch, sim::Model model, double sim::Excitation::* parameter,
                     std::size_t every) {
  model.solver.tolerance = sim::Solver{}.tolerance;
  double worst = 0.0;
  for (std::size_t i = 0; i < branch.points.size(); i += every) {
    model.excitation.*parameter = branch.points[i].parameter;
    const sim::SteadyState state = sim::steady_state(model, {.detail = sim::OrbitDetail::extremes});
    worst = std::max(worst, std::abs(branch.points[i].state.amplitude / state.amplitude - 1.0));
  }
  return worst;
}

void check_smooth(const friction::Law& law, double tolerance) {
  sim::Model model = smooth(law, tolerance);
  const sim::BranchOptions few{.largest_step = 0.2};
  for (const bool over_frequency : {true, false}) {
    // A branch sets its parameter itself.
    (over_frequency ? model.excitation.frequency : model.excitation.amplitude) = 0.0;
    (over_frequency ? model.excitation.amplitude : model.excitation.frequency) = over_frequency ? 0.5 : 0.8;
    const sim::Branch branch = over_frequency ? continue_branch(model, BranchParameter::frequency, 0.8, 1.2, few)
                                              : continue_branch(model, BranchParameter::amplitude, 0.3, 1.0, few);
    CAPTURE(tolerance, over_frequency);
    REQUIRE(branch.outcome.ok());
    CHECK(branch.end == sim::BranchEnd::range);
    CHECK(branch.changes.empty());
    CHECK(branch.points.back().parameter == (over_frequency ? 1.2 : 1.0));
    const auto parameter = over_frequency ? &sim::Excitation::frequency : &sim::Excitation::amplitude;
    CHECK(largest_error(branch, model, parameter, 5) < std::max(1e-8, 1000.0 * tolerance));
  }
}

}  // namespace

TEST_CASE("a branch of a smooth law closes its orbits to the error of the engine and passes through the response") {
  const auto [law, tolerance] = GENERATE(table<friction::Law, double>({
      {friction::Law(friction::Dahl(0.2, 10.0, 1.0)), 1e-11},
      {friction::Law(friction::Dahl(0.2, 10.0, 1.0)), 1e-9},
      {friction::Law(friction::Dahl(0.2, 10.0, 1.0)), 1e-6},
      {friction::Law(friction::Lugre(friction::StribeckCurve(0.2, 0.25, 0.05), {10.0, 0.1, 0.0})), 1e-11},
      {friction::Law(friction::BoucWen(0.2, 10.0, 2.0, 0.0, 0.5)), 1e-11},
  }));
  check_smooth(law, tolerance);
}

TEST_CASE("the smooth engine finds the changes of a branch where the exact engine does") {
  sim::Model model = stiff_coulomb();
  const sim::BranchOptions few{.largest_step = 0.1};
  const sim::Branch exact = continue_branch(model, BranchParameter::amplitude, 0.021, 0.018, few);
  REQUIRE(exact.changes.size() == 1);
  for (const double tolerance : {1e-11, 1e-7}) {
    CAPTURE(tolerance);
    model.solver = {sim::SolverKind::explicit_steps, tolerance};
    const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 0.021, 0.018, few);
    CHECK(branch.end == sim::BranchEnd::range);
    REQUIRE(branch.changes.size() == 1);
    CHECK(branch.changes[0].kind == sim::ChangeKind::sticking);
    CHECK(branch.changes[0].parameter ==
          Approx(exact.changes[0].parameter).epsilon(std::max(1e-8, 100 * tolerance)));
  }
}

TEST_CASE("a branch begins just above the onset of motion, where rounding of the forces limits the closure") {
  const sim::Branch branch = continue_branch(stiff_coulomb(), BranchParameter::amplitude, 0.01001, 0.011);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::range);
  CHECK(branch.points.front().state.amplitude < 1e-7);
  CHECK(largest_error(branch, stiff_coulomb(), &sim::Excitation::amplitude, 50) < 1e-8);
}

TEST_CASE("a branch under a hardening spring ends where friction holds the mass") {
  sim::Model model = stiff_coulomb();
  model.oscillator.cubic_stiffness = 1e4;
  model.friction = {friction::Law(friction::Coulomb(2.0, 2.0))};
  model.excitation.frequency = 5.0;
  const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 0.03, 0.01);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::rest);
  REQUIRE_FALSE(branch.changes.empty());
  const sim::BranchChange& last = branch.changes.back();
  CHECK(last.kind == sim::ChangeKind::rest);
  // The mass sticks at x = 0 up to the amplitude at which the spring pulls with the limit of 2 N.
  CHECK(100.0 * last.parameter + 1e4 * std::pow(last.parameter, 3) == Approx(2.0).epsilon(1e-6));
}

TEST_CASE("a steep branch under a falling friction law keeps its tangent") {
  // Static friction falls within 0.01 m/s. Neighbouring motions part by a factor of 24 in a period, and the
  // amplitude changes 200 times as fast as the frequency. A wrong tangent made a hundred steps of 1e-6 rad/s.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 0.2488};
  model.friction.emplace_back(friction::Stribeck(friction::StribeckCurve(0.2, 0.3, 0.01)));
  const sim::Branch branch =
      continue_branch(model, sim::BranchParameter::frequency, 0.2488, 1.5, {.max_points = 40});
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::points);
  REQUIRE(branch.changes.size() == 5);
  CHECK(branch.changes[0].kind == sim::ChangeKind::flip);
  CHECK(branch.changes[4].kind == sim::ChangeKind::fold);
  CHECK(branch.changes[4].parameter == Approx(0.25560071).epsilon(1e-6));
}

TEST_CASE("steps along a branch are measured by how far each state reaches in its own unit", "[sim][curves]") {
  // At 12 rad/s the attached mass moves a hundred times as far as the mass that it holds nearly at rest; the
  // delayed velocity of the lag is a velocity. Measured by the motion of the mass in metres, the steps became so
  // short that both branches ended with their work, after 2000 points.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .frequency = 12.0};
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  model.friction.emplace_back(friction::AttachedMass(0.05, 7.3, 0.002));
  const sim::Branch attached = continue_branch(model, BranchParameter::amplitude, 0.06, 0.3);
  REQUIRE(attached.outcome.ok());
  CHECK(attached.end == sim::BranchEnd::range);
  CHECK(attached.points.back().parameter == 0.3);
  CHECK(attached.points.size() < 400);
  CHECK(largest_error(attached, model, &sim::Excitation::amplitude, 60) < 1e-8);

  model.excitation.amplitude = 0.1;
  model.friction = {
      test::law("friction_lag", {{"kinetic", 2.0}, {"static", 2.2}, {"stribeck_velocity", 0.2}, {"lag", 0.01}})};
  const sim::Branch lagging = continue_branch(model, BranchParameter::frequency, 6.0, 16.0);
  REQUIRE(lagging.outcome.ok());
  CHECK(lagging.end == sim::BranchEnd::range);
  CHECK(lagging.points.back().parameter == 16.0);
  CHECK(lagging.points.size() < 800);
  CHECK(largest_error(lagging, model, &sim::Excitation::frequency, 150) < 1e-8);
}

TEST_CASE("a branch of asymmetric orbits goes on to their mirror images, and not to symmetric ones") {
  sim::Model model = smooth(friction::Law(friction::Stribeck(friction::StribeckCurve(0.02, 0.05, 0.05))), 1e-11);
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.05, .cubic_stiffness = 1.0};
  model.excitation.amplitude = 0.2;
  model.excitation.frequency = 0.0;
  const sim::Branch branch = continue_branch(model, BranchParameter::frequency, 0.5, 2.5);
  REQUIRE(branch.outcome.ok());
  const auto asymmetry = [](const sim::BranchPoint& point) { return point.state.peak + point.state.trough; };
  CHECK(asymmetry(branch.points.front()) == Approx(-asymmetry(branch.points.back())).epsilon(1e-6));
  // Where the branch of symmetric orbits, from 0.6 down, says that they cease to attract.
  CHECK(std::ranges::any_of(branch.changes, [](const sim::BranchChange& change) {
    return change.kind == sim::ChangeKind::fold && std::abs(change.parameter - 0.567504222) < 1e-6;
  }));
  REQUIRE(branch.warnings.size() == 1);
  CHECK(branch.warnings.front().find("met their mirror images") != std::string::npos);
}
