// Branches of steady states: against steady states found one by one, Den Hartog's sticking boundary, and a bilinear
// spring, whose response folds.

#include "sim/curves/continuation.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/free_play.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using sim::BranchParameter;
using sim::ChangeKind;

namespace {

/// A second spring of stiffness `k` beyond x = gap, as a law: the bilinear oscillator.
struct Stop {
  double k;
  double gap;

  [[nodiscard]] friction::Memory start(const friction::Instant& now) const { return {.mode = now.x > gap ? 1 : 0}; }
  [[nodiscard]] friction::Affine affine_force(const friction::Memory& m, const friction::Instant&,
                                              friction::Direction) const {
    return m.mode == 0 ? friction::Affine{} : friction::Affine{.constant = -k * gap, .position = k};
  }
  void affine_guards(const friction::Memory& m, const friction::Instant&, friction::Direction,
                     std::vector<friction::Affine>& guards) const {
    const double side = m.mode == 0 ? 1.0 : -1.0;
    guards.push_back({.constant = side * gap, .position = -side});
  }
  void jump(friction::Memory& m, friction::Trigger trigger, const friction::Instant&, friction::Direction) const {
    if (trigger.cause == 0) m.mode = 1 - m.mode;
  }
};

sim::Model coulomb_driven(double damping, double friction, double amplitude, double frequency) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = damping};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = frequency};
  model.friction.emplace_back(friction::Coulomb(friction, friction));
  return model;
}

sim::Model compliant(double damping, double frequency, double kinetic, double ratio, double stiffness) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = damping};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = frequency};
  model.friction.emplace_back(friction::ContactCompliance(kinetic, ratio * kinetic, stiffness, 0.0));
  return model;
}

const sim::BranchChange* first(const sim::Branch& branch, ChangeKind kind) {
  const auto place = std::ranges::find(branch.changes, kind, &sim::BranchChange::kind);
  return place == branch.changes.end() ? nullptr : &*place;
}

long count(const sim::Branch& branch, ChangeKind kind) {
  return std::count_if(branch.changes.begin(), branch.changes.end(),
                       [&](const sim::BranchChange& change) { return change.kind == kind; });
}

}  // namespace

TEST_CASE("a branch in amplitude passes through the steady states found one by one") {
  sim::Model model = coulomb_driven(0.1, 1.0, 1.0, 0.5);
  const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 4.0, 1.05);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.points.back().parameter == 1.05);
  CHECK(branch.points.size() > 40);
  double worst = 0.0;
  for (const sim::BranchPoint& point : branch.points) {
    model.excitation.amplitude = point.parameter;
    const sim::SteadyState state = sim::steady_state(model);
    worst = std::max(worst, std::abs(point.state.peak - state.peak) / state.peak);
    CHECK(point.state.stops_per_cycle == state.stops_per_cycle);
    CHECK(point.state.stable());
  }
  // Both close to 1e-13, and the slowest multiplier is about 0.5.
  CHECK(worst < 1e-11);
  // Each orbit is computed at least twice, to close it and to describe it: two reversals and the end of the period.
  CHECK(branch.certificate.searches >= 6 * static_cast<long>(branch.points.size()));
  CHECK(branch.certificate.panels >= branch.certificate.searches);
}

TEST_CASE("sticking sets in where Den Hartog's boundary says") {
  for (const double ratio : {0.4, 0.7, 1.3}) {
    CAPTURE(ratio);
    const double zeta = 0.05;
    const double boundary = 1.0 / sim::analytic::non_sticking_boundary(sim::analytic::den_hartog(zeta, ratio));
    const sim::Branch branch = continue_branch(coulomb_driven(2.0 * zeta, 1.0, 1.0, ratio),
                                               BranchParameter::amplitude, 1.6 * boundary, 0.9 * boundary);
    REQUIRE(branch.outcome.ok());
    REQUIRE(count(branch, ChangeKind::sticking) == 1);
    const auto onset =
        std::find_if(branch.changes.begin(), branch.changes.end(),
                     [](const sim::BranchChange& change) { return change.kind == ChangeKind::sticking; });
    // The duration of a new stick is proportional to the root of the distance, which bisection finds to 1e-9 of the
    // range.
    CHECK(onset->parameter == Approx(boundary).epsilon(1e-8));
    CHECK(onset->stops_before == 0);
    CHECK(onset->stops_after == 2);
  }
}

TEST_CASE("the number of stops grows as the frequency falls, and every change is reported") {
  const sim::Branch branch =
      continue_branch(coulomb_driven(0.1, 0.2, 1.0, 0.5), BranchParameter::frequency, 0.5, 0.1);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.points.back().parameter == 0.1);
  CHECK(branch.points.front().state.stops_per_cycle < branch.points.back().state.stops_per_cycle);
  int stops = branch.points.front().state.stops_per_cycle;
  for (const sim::BranchChange& change : branch.changes) {
    CHECK(change.stops_before == stops);
    stops = change.stops_after;
  }
  CHECK(stops == branch.points.back().state.stops_per_cycle);
}

TEST_CASE("over decades of frequency a branch passes every resonance, and turns nowhere where one orbit lives") {
  // Below the resonance the amplitude rises and falls by a hundredth many times, each time within a tenth of the
  // frequency. A step over such a bend must not reverse the branch.
  const sim::Branch branch =
      continue_branch(coulomb_driven(0.4, 0.2, 1.0, 0.1), BranchParameter::frequency, 0.1, 30.0);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::range);
  CHECK(count(branch, ChangeKind::fold) == 0);
  CHECK(count(branch, ChangeKind::sticking) == 1);
  double farthest = 1.0;
  bool ascends = true;
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const double growth = branch.points[i].parameter / branch.points[i - 1].parameter;
    farthest = std::max(farthest, growth);
    ascends = ascends && growth > 1.0;
  }
  CHECK(ascends);
  CHECK(farthest < 1.05);
}

TEST_CASE("a branch that turns back and leaves the range where it began says so") {
  // An asymmetric orbit meets its mirror image, and the branch continues along the mirror image, back to smaller
  // amplitudes.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.0706985835};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 0.141331223, .phase = 0.227782959};
  model.friction.emplace_back(friction::FreePlay(0.389305694, 0.389305694, 0.402640675));
  const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 0.506097402, 71.5044366);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::range);
  CHECK(branch.points.back().parameter == branch.points.front().parameter);
  CHECK(branch.points.back().state.peak == Approx(-branch.points.front().state.trough));
  REQUIRE(branch.warnings.size() == 1);
  CHECK(branch.warnings.front().find("leaves the range where it began") != std::string::npos);
}

TEST_CASE("the response of a bilinear spring folds; the branch between is unstable") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.06};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.12, .frequency = 1.0};
  model.friction.emplace_back(Stop{.k = 3.0, .gap = 1.0});
  const sim::Branch branch = continue_branch(model, BranchParameter::frequency, 0.9, 1.5);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.points.back().parameter == 1.5);
  std::vector<sim::BranchChange> folds;
  for (const sim::BranchChange& change : branch.changes) {
    if (change.kind == ChangeKind::fold) folds.push_back(change);
  }
  REQUIRE(folds.size() == 2);
  CHECK(folds[0].parameter > folds[1].parameter);
  // Between the folds there are three orbits at each frequency: two attract, the middle one does not.
  const double middle = 0.5 * (folds[0].parameter + folds[1].parameter);
  int passes = 0;
  int stable = 0;
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const double before = branch.points[i - 1].parameter - middle;
    const double after = branch.points[i].parameter - middle;
    if (before * after >= 0.0) continue;
    ++passes;
    stable += branch.points[i].state.stable() ? 1 : 0;
  }
  CHECK(passes == 3);
  CHECK(stable == 2);
  // At a fold a Floquet multiplier passes 1: one place, one change.
  CHECK(count(branch, ChangeKind::stability) == 0);
  CHECK(folds[0].stable_before);
  CHECK_FALSE(folds[0].stable_after);
  CHECK_FALSE(folds[1].stable_before);
  CHECK(folds[1].stable_after);
  CHECK(branch.end == sim::BranchEnd::range);
  CHECK(branch.warnings.empty());
}

TEST_CASE("a Floquet multiplier passes -1 at a flip") {
  const sim::Branch branch =
      continue_branch(compliant(0.0471012, 0.5, 0.193215, 1.21178, 11.47106), BranchParameter::frequency, 0.5, 0.3);
  REQUIRE(branch.outcome.ok());
  const sim::BranchChange* flip = first(branch, ChangeKind::flip);
  REQUIRE(flip != nullptr);
  CHECK(flip->parameter == Approx(0.34276919).epsilon(1e-7));
  CHECK(flip->stable_before);
  CHECK_FALSE(flip->stable_after);
  int behind = 0;
  for (const sim::BranchPoint& point : branch.points) {
    double least = 0.0;
    for (const std::complex<double>& value : point.state.multipliers) least = std::min(least, value.real());
    CHECK((least < -1.0) == (point.parameter < flip->parameter));
    behind += least < -1.0 ? 1 : 0;
  }
  CHECK(behind > 0);
}

TEST_CASE("a complex pair that leaves the unit circle is no flip and no fold") {
  const sim::Branch branch = continue_branch(compliant(0.01029022, 0.2828109, 0.06704356, 1.7833826, 4.648053),
                                             BranchParameter::amplitude, 0.6, 0.4);
  REQUIRE(branch.outcome.ok());
  const sim::BranchChange* place = first(branch, ChangeKind::neimark_sacker);
  REQUIRE(place != nullptr);
  CHECK(place->parameter == Approx(0.508036191).epsilon(1e-6));
  CHECK(place->stable_before);
  CHECK_FALSE(place->stable_after);
  CHECK(count(branch, ChangeKind::flip) == 0);
}

TEST_CASE("a branch that ends says so once") {
  // It folds, and its unstable part then meets a grazing.
  const sim::Branch branch = continue_branch(compliant(0.05144051, 1.0, 0.10326303, 2.20485448, 5.0238030),
                                             BranchParameter::frequency, 0.317, 0.2);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::orbit);
  REQUIRE(branch.warnings.size() == 1);
  CHECK(count(branch, ChangeKind::end) == 1);
  CHECK(branch.changes.back().kind == ChangeKind::end);
  CHECK(count(branch, ChangeKind::fold) == 1);
  CHECK(branch.changes.size() < 40);
}

TEST_CASE("a branch jumps where a slip continues, and not to and fro between two branches") {
  // Static friction is above kinetic. A branch that jumped back to a passed part would jump again and again.
  for (const double ratio : {1.03153634, 1.089}) {
    sim::Model model = coulomb_driven(0.0168831, 0.15343084, 1.0, 0.2257);
    model.friction = {friction::Law(friction::Coulomb(0.15343084, ratio * 0.15343084))};
    const sim::Branch branch = continue_branch(model, BranchParameter::frequency, 0.2257, 0.05);
    REQUIRE(branch.outcome.ok());
    CHECK(branch.changes.size() < 40);
    REQUIRE(count(branch, ChangeKind::jump) > 0);
    for (std::size_t i = 1; i < branch.points.size(); ++i)
      CHECK(branch.points[i].parameter < branch.points[i - 1].parameter);
    // The motion from the last orbit before the first jump settles on the orbit behind it.
    const sim::BranchChange& jump = *first(branch, ChangeKind::jump);
    const auto behind = std::ranges::find_if(
        branch.points, [&](const sim::BranchPoint& point) { return point.parameter < jump.parameter; });
    REQUIRE(behind != branch.points.begin());
    model.excitation.frequency = behind->parameter;
    const sim::SteadyState swept = sim::steady_state(model, {.from = std::prev(behind)->state.start});
    CHECK(swept.amplitude == Approx(behind->state.amplitude).epsilon(1e-9));
  }
}

TEST_CASE("a branch goes on where sliders slip for the first time, one after the other") {
  // Each of them turns the tangent in its own coordinate, from a slider that never slips to one that follows x.
  for (const double sliders : {20.0, 40.0}) {
    sim::Model model;
    model.oscillator = {.mass = 1.3, .stiffness = 120.0, .damping = 1.1};
    model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.005, .frequency = 8.168};
    model.friction = test::laws_of("iwan", {{"stiffness", 300.0}, {"limit", 3.0}, {"count", sliders}});
    const sim::Branch branch = continue_branch(model, BranchParameter::amplitude, 0.005, 0.02);
    REQUIRE(branch.outcome.ok());
    CHECK(branch.end == sim::BranchEnd::range);
    CHECK(branch.points.size() < 300);
    CHECK(count(branch, ChangeKind::sequence) > 5);
    for (std::size_t i = 1; i < branch.points.size(); ++i) {
      CHECK(branch.points[i].parameter > branch.points[i - 1].parameter);
      CHECK(branch.points[i].state.amplitude > branch.points[i - 1].state.amplitude);
    }
  }
}

TEST_CASE("a branch that is cut short says so") {
  const sim::Branch branch =
      continue_branch(coulomb_driven(0.1, 1.0, 1.0, 0.5), BranchParameter::amplitude, 4.0, 1.05, {.max_points = 7});
  REQUIRE(branch.outcome.ok());
  CHECK(branch.points.size() == 7);
  CHECK(branch.end == sim::BranchEnd::points);
  REQUIRE(branch.warnings.size() == 1);
  CHECK(branch.warnings[0].find("7 points") != std::string::npos);
}

TEST_CASE("a branch that begins at a mass at rest says so, and where the mass begins to move") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.019, .frequency = 10.0};
  model.oscillator.damper_to = sim::DamperTo::base;
  const auto check_rest = [&](double holding, BranchParameter parameter, double from, double to,
                              const std::string& where) {
    model.friction.clear();
    model.friction.emplace_back(friction::Coulomb(2.0, holding));
    const sim::Branch branch = continue_branch(model, parameter, from, to);
    REQUIRE(branch.outcome.ok());
    CHECK(branch.end == sim::BranchEnd::rest);
    CHECK(branch.points.size() == 1);
    REQUIRE(branch.warnings.size() == 1);
    CHECK_THAT(branch.warnings[0], Catch::Contains(where));
  };
  // k Y |1 + 0.4 i| = the holding force.
  check_rest(2.0, BranchParameter::amplitude, 0.005, 0.1, "moves above 0.01857 m");
  check_rest(3.0, BranchParameter::amplitude, 0.005, 0.1, "moves above 0.02785 m");
  check_rest(2.0, BranchParameter::amplitude, 0.005, 0.01, "nor does it move at the last value");
  check_rest(2.0, BranchParameter::frequency, 2.0, 12.0, "moves above 8.217 rad/s");
}

TEST_CASE("a branch whose search takes too long ends with a warning") {
  const sim::Branch branch = continue_branch(coulomb_driven(0.1, 1.0, 1.0, 0.5), BranchParameter::amplitude, 4.0,
                                             1.05, {.most_work = 500});
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::work);
  REQUIRE(branch.warnings.size() == 1);
  CHECK(branch.warnings[0].find("takes too long") != std::string::npos);
}

TEST_CASE("attempts that run away over the hilltop of a softening spring do not hold up its branch") {
  sim::Model model = coulomb_driven(0.02, 0.25, 0.25, 8.0);
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.4, .cubic_stiffness = -1200.0};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 2.7, .frequency = 8.0};
  const sim::Branch branch = continue_branch(model, BranchParameter::frequency, 7.5, 8.5, {.most_work = 3'000'000});
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end != sim::BranchEnd::work);
  REQUIRE(count(branch, ChangeKind::fold) == 1);
  CHECK(branch.changes[0].parameter == Approx(8.0905).epsilon(1e-4));
}

TEST_CASE("a branch goes on where neighbouring motions part thousandfold in a period") {
  // Four slips with static friction above kinetic: each passes on the place of its release. The orbit beyond the
  // fold does not attract; its largest Floquet multiplier is 19,010 at the end of the range.
  sim::Model model = coulomb_driven(0.1, 0.2, 0.6, 0.2);
  model.excitation.type = sim::ExcitationType::force_harmonic;
  model.friction = {friction::Law(friction::Coulomb(0.2, 0.3))};
  const sim::Branch branch = continue_branch(model, BranchParameter::frequency, 0.2, 1.5);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::range);
  REQUIRE(branch.changes.size() == 1);
  CHECK(branch.changes[0].kind == ChangeKind::fold);
  CHECK(branch.points.size() < 150);
  const sim::BranchPoint& last = branch.points.back();
  CHECK(last.parameter == 0.2);
  CHECK(last.state.stops_per_cycle == 4);
  CHECK(std::abs(last.state.multipliers[0]) == Approx(19010.0).epsilon(1e-3));
  // It is the orbit of the points before, not another one at the same frequency.
  const sim::BranchPoint& before = branch.points[branch.points.size() - 2];
  CHECK(last.state.amplitude == Approx(before.state.amplitude).epsilon(1e-3));
}

TEST_CASE("an undamped resonance ends a branch because its amplitude grows without bound") {
  const sim::Branch branch =
      continue_branch(coulomb_driven(0.0, 0.2, 1.0, 1.5), BranchParameter::frequency, 1.5, 0.5);
  REQUIRE(branch.outcome.ok());
  CHECK(branch.end == sim::BranchEnd::growth);
  CHECK(branch.points.back().parameter == Approx(1.0).epsilon(1e-7));
  CHECK(branch.points.back().state.amplitude > 1e7);
  REQUIRE(branch.warnings.size() == 1);
  CHECK(branch.warnings[0].find("grows without bound") != std::string::npos);
}

TEST_CASE("a branch is the same in any units of length, force and time") {
  // Powers of two change no digit of a motion. A length of 1e-16 m or 1e16 m had stopped a branch at its first
  // point; in microseconds the entries of the monodromy matrix were 1e-8 off.
  struct Units {
    double force, length, time;
  };
  const bool is_damped_contact = GENERATE(false, true);
  const BranchParameter parameter = GENERATE(BranchParameter::amplitude, BranchParameter::frequency);
  const bool by_frequency = parameter == BranchParameter::frequency;
  const auto branch_in = [&](const Units& u) {
    sim::Model model;
    model.oscillator = {.mass = u.force * u.time * u.time / u.length,
                        .stiffness = 100.0 * u.force / u.length,
                        .damping = 4.0 * u.force * u.time / u.length};
    model.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = 0.1 * u.length, .frequency = 10.0 / u.time};
    if (is_damped_contact)
      model.friction.emplace_back(friction::ContactCompliance(
          2.0 * u.force, 2.5 * u.force, 1000.0 * u.force / u.length, u.force * u.time / u.length));
    else
      model.friction.emplace_back(friction::Coulomb(2.0 * u.force, 2.0 * u.force));
    return by_frequency ? continue_branch(model, parameter, 3.0 / u.time, 20.0 / u.time)
                        : continue_branch(model, parameter, 0.05 * u.length, 0.2 * u.length);
  };
  const sim::Branch first = branch_in({1.0, 1.0, 1.0});
  REQUIRE(first.end == sim::BranchEnd::range);
  for (const Units u : {Units{1.0, 0x1p-53, 1.0}, Units{1.0, 0x1p53, 1.0}, Units{0x1p60, 1.0, 1.0},
                        Units{1.0, 1.0, 0x1p-20}, Units{1.0, 1.0, 0x1p30}, Units{0x1p20, 0x1p-30, 0x1p-15}}) {
    CAPTURE(is_damped_contact, by_frequency, u.force, u.length, u.time);
    const sim::Branch other = branch_in(u);
    CHECK(other.end == first.end);
    REQUIRE(other.points.size() == first.points.size());
    CHECK(other.changes.size() == first.changes.size());
    for (std::size_t i = 0; i < first.points.size(); ++i) {
      const double unit = by_frequency ? 1.0 / u.time : u.length;
      CHECK(other.points[i].parameter / unit == Approx(first.points[i].parameter).epsilon(1e-9));
      CHECK(other.points[i].state.peak / u.length == Approx(first.points[i].state.peak).epsilon(1e-9));
    }
  }
}
