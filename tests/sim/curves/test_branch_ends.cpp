// Where branches end and where they turn: break-away, releases that jump, releases that become grazings. The places
// are known in closed form, or from transients of a fixed-step integrator of Runge and Kutta outside this program.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <string>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/free_play.hpp"
#include "sim/curves/continuation.hpp"
#include "tests/support/base_driven.hpp"

using namespace dualdamp;
using sim::BranchParameter;
using sim::ChangeKind;
using test::base_driven;

namespace {

long changes_of(const sim::Branch& branch, ChangeKind kind) {
  return std::ranges::count(branch.changes, kind, &sim::BranchChange::kind);
}

double largest_multiplier(const sim::BranchPoint& point) {
  double largest = 0.0;
  for (const std::complex<double>& value : point.state.multipliers) largest = std::max(largest, std::abs(value));
  return largest;
}

void check_break_away(const sim::Branch& branch, double place, const std::string& words) {
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::rest);
  REQUIRE_FALSE(branch.changes.empty());
  const sim::BranchChange& last = branch.changes.back();
  CHECK(last.kind == ChangeKind::rest);
  // The motion is followed down to 1e-6 of the drive, and its middle is a rest position to less than that.
  CHECK(last.parameter == Approx(place).epsilon(1e-7));
  CHECK(last.stops_before > 0);
  CHECK(last.stops_after == 0);
  CHECK(branch.points.size() < 700);
  REQUIRE(branch.warnings.size() == 1);
  CHECK_THAT(branch.warnings[0], Catch::Contains(words));
}

/// Where the mass comes to rest that is released from rest at x at t = 0, by a fixed-step integrator of fourth
/// order.
double next_rest(const sim::Model& model, double kinetic, double x) {
  const sim::Oscillator& o = model.oscillator;
  const sim::Excitation& e = model.excitation;
  const auto acceleration = [&](double t, double at, double v) {
    return (o.stiffness * (e.amplitude * std::cos(e.frequency * t) - at) - o.damping * v - kinetic) / o.mass;
  };
  double v = 0.0;
  constexpr double h = 2e-5;
  for (long i = 0;; ++i) {
    const double t = static_cast<double>(i) * h;
    const double a1 = acceleration(t, x, v);
    const double a2 = acceleration(t + 0.5 * h, x + 0.5 * h * v, v + 0.5 * h * a1);
    const double a3 = acceleration(t + 0.5 * h, x + 0.5 * h * (v + 0.5 * h * a1), v + 0.5 * h * a2);
    const double a4 = acceleration(t + h, x + h * (v + 0.5 * h * a2), v + h * a3);
    x += h * v + h * h / 6.0 * (a1 + a2 + a3);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    if (v < 0.0) return x;  // at rest the position is stationary
  }
}

}  // namespace

TEST_CASE("a branch that runs down to break-away ends there, and says where the mass ceases to move") {
  sim::Model base = base_driven({.k = 100.0, .c = 1.0, .Y = 0.05, .w = 2.0});
  base.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  // The base pulls with k Y.
  check_break_away(continue_branch(base, BranchParameter::amplitude, 0.05, 0.01), 0.02,
                   "does not move below 0.02 m");
  base.friction = {friction::Law(friction::Coulomb(2.0, 2.0001))};
  check_break_away(continue_branch(base, BranchParameter::amplitude, 0.05, 0.01), 0.020001, "below 0.020001 m");
  sim::Model force = base_driven({.k = 100.0, .c = 1.0, .Y = 5.0, .w = 7.0});
  force.excitation.type = sim::ExcitationType::force_harmonic;
  force.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  check_break_away(continue_branch(force, BranchParameter::amplitude, 5.0, 0.5), 2.0, "does not move below 2 N");
  base.oscillator.coordinate = force.oscillator.coordinate = core::Coordinate::angle;
  check_break_away(continue_branch(base, BranchParameter::amplitude, 0.05, 0.01), 0.020001, "below 0.020001 rad");
  check_break_away(continue_branch(force, BranchParameter::amplitude, 5.0, 0.5), 2.0, "does not move below 2 N.m");
  // With the damper to the base it pulls with k Y |1 + i c w/k|.
  sim::Model damped = base_driven({.k = 100.0, .c = 4.0, .Y = 0.019, .w = 12.0});
  damped.oscillator.damper_to = sim::DamperTo::base;
  damped.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  const double slowest = 25.0 * std::sqrt(std::pow(2.0 / 1.9, 2) - 1.0);
  check_break_away(continue_branch(damped, BranchParameter::frequency, 12.0, 2.0), slowest, "below 8.2171 rad/s");
}

TEST_CASE("a branch that runs close to break-away, but not beyond, is complete") {
  sim::Model model = base_driven({.k = 100.0, .c = 4.0, .Y = 0.05, .w = 10.0});
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 0.05, 0.0200001);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::range);
  CHECK(changes_of(branch, ChangeKind::rest) == 0);
}

TEST_CASE("a branch does not fold at its end, where a release jumps") {
  // A difference quotient across the jump turned the tangent. Transients: at 0.7111 N the motion repeats itself
  // with the amplitude of the branch, at 0.7110 N it leaves it.
  sim::Model model = base_driven({.c = 0.075044541, .w = 0.49771328});
  model.excitation.type = sim::ExcitationType::force_harmonic;
  model.friction.emplace_back(friction::ContactCompliance(0.31368364, 0.60916682, 42.948855, 0.0));
  const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 1.0, 0.15684182);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::orbit);
  CHECK(changes_of(branch, ChangeKind::fold) == 0);
  CHECK(branch.changes.back().kind == ChangeKind::end);
  CHECK(branch.changes.back().parameter == Approx(0.711049).epsilon(1e-5));
  CHECK(largest_multiplier(branch.points.back()) < 0.7);
}

TEST_CASE("a branch does not pass to another one that is close at the start of the period only") {
  // Behind its fold the orbit does not attract, and its Floquet multiplier grows until a release jumps. Beyond lies
  // the motion with two stops, which attracts, on both sides of the fold too: another branch.
  sim::Model model = base_driven({.c = 0.099156161, .w = 0.1303711});
  model.friction.emplace_back(friction::Coulomb(0.069762387, 0.073399176));
  const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 0.25, 0.034881194);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::orbit);
  REQUIRE(changes_of(branch, ChangeKind::fold) == 1);
  const auto fold = std::ranges::find(branch.changes, ChangeKind::fold, &sim::BranchChange::kind);
  CHECK(fold->parameter == Approx(0.2216707).epsilon(1e-6));
  CHECK(fold->stable_before);
  CHECK_FALSE(fold->stable_after);
  CHECK(branch.changes.back().kind == ChangeKind::end);
  CHECK(branch.points.back().state.stops_per_cycle == 4);
  CHECK(largest_multiplier(branch.points.back()) > 1.0);
}

TEST_CASE("a jump from one orbit that attracts to another is no mere change of the sequence") {
  // Where the slowest point of a slip touches v = 0, static friction holds the mass for a while.
  sim::Model model = base_driven({.c = 0.12234632, .w = 0.34560027});
  model.friction.emplace_back(friction::Coulomb(0.089831725, 0.13277403));
  const sim::Branch branch = continue_branch(model, BranchParameter::frequency, 0.34560027, 1.0368008);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::range);
  REQUIRE(branch.changes.size() == 1);
  CHECK(branch.changes[0].kind == ChangeKind::jump);
  CHECK(branch.changes[0].stops_before == 2);
  CHECK(branch.changes[0].stops_after == 0);
  // From below the orbit with sticks is followed up to that place, from above the one without.
  const double place = branch.changes[0].parameter;
  const sim::Branch below = continue_branch(model, BranchParameter::frequency, 0.35, place * (1.0 - 1e-7));
  const sim::Branch above = continue_branch(model, BranchParameter::frequency, 0.45, place * (1.0 + 1e-7));
  CHECK(below.points.back().state.stops_per_cycle == 2);
  CHECK(above.points.back().state.stops_per_cycle == 0);
  CHECK(above.points.back().state.amplitude > 1.01 * below.points.back().state.amplitude);
}

TEST_CASE("a branch ends where a release becomes a grazing, however fast neighbouring motions part there") {
  // Behind the fold the mass sticks at -X and X. The release comes ever later and ceases at k(Y + X) = static, the
  // peak of the pull. The steps became ever shorter, and 561 points ended with `step`.
  sim::Model model = base_driven({.k = 100.0, .c = 1.0, .Y = 0.03, .w = 2.0});
  model.friction.emplace_back(friction::Coulomb(2.0, 3.0));
  const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 0.055, 0.01);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::orbit);
  CHECK(branch.points.size() < 420);
  REQUIRE(branch.changes.size() == 2);
  CHECK(branch.changes[0].kind == ChangeKind::fold);
  CHECK(branch.changes[1].kind == ChangeKind::end);
  double low = 0.0215;
  double high = 0.022;
  for (int i = 0; i < 30; ++i) {
    model.excitation.amplitude = 0.5 * (low + high);
    const double x = 0.03 - model.excitation.amplitude;
    (next_rest(model, 2.0, -x) > x ? high : low) = model.excitation.amplitude;
  }
  // It is extrapolated over at most 3e-4 of the amplitude.
  CHECK(branch.changes[1].parameter == Approx(low).epsilon(2e-5));
}

TEST_CASE("a branch that stops because neighbouring motions part too fast says how fast") {
  // With this tolerance orbits are lost long before the end of the branch can be foreseen.
  sim::Model model = base_driven({.c = 0.1, .w = 0.2});
  model.friction.emplace_back(friction::Coulomb(0.2, 0.5));
  model.solver = {sim::SolverKind::explicit_steps, 1e-7};
  const sim::Branch branch = continue_branch(model, BranchParameter::frequency, 0.2, 1.5);
  REQUIRE(branch.outcome.ok());
  CHECK(largest_multiplier(branch.points.back()) > 1e4);
  CHECK(branch.end == sim::BranchEnd::step);
  REQUIRE(branch.warnings.size() == 1);
  CHECK_THAT(branch.warnings[0], Catch::Contains("largest Floquet multiplier is"));
}

TEST_CASE(
    "Where an orbit ceases to exist and the motion goes on to one far away, the branch jumps as a sweep does") {
  sim::Model model;
  model.oscillator = {.mass = 1.3, .stiffness = 120.0, .damping = 1.1};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.04, .frequency = 3.2};
  model.friction.emplace_back(friction::FreePlay(2.0, 3.0, 0.02));
  const sim::Branch branch = sim::continue_branch(model, BranchParameter::frequency, 3.2, 3.6);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::range);
  CHECK(branch.points.back().parameter == 3.6);
  REQUIRE(changes_of(branch, ChangeKind::jump) == 1);
  const auto jump = std::ranges::find(branch.changes, ChangeKind::jump, &sim::BranchChange::kind);
  CHECK(jump->parameter == Approx(3.349576).epsilon(1e-6));
  CHECK(jump->stable_before);
  CHECK(jump->stable_after);
  // A sweep with levels 5e-5 rad/s apart: 23.190 mm before, 22.237 mm after the jump.
  CHECK(jump->amplitude == Approx(0.022237).epsilon(1e-3));
}
