/// Monodromy matrices of the smooth engine against central differences of its period map, in cases in which the
/// derivative of the computed steps is not that of the motion.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/engine/engine.hpp"
#include "sim/orbits/period_map.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using friction::ParameterValues;
using sim::ForcingPeriod;
using sim::Monodromy;

namespace {

void add_law(sim::Model& model, std::string_view name, ParameterValues values) {
  for (friction::Law& law : test::laws_of(name, std::move(values))) model.friction.push_back(std::move(law));
}

/// The third forcing period from (x, v) on.
ForcingPeriod third_period(sim::PeriodMap& map, double x, double v) {
  (void)map.from_start(x, v, Monodromy::without);
  const sim::State start = map.next(Monodromy::without).end;
  return map.from(start, Monodromy::with);
}

/// Column `j`, by a change of the start by `step` to both sides.
Eigen::VectorXd quotient(sim::PeriodMap& map, const ForcingPeriod& period, Eigen::Index j, double step) {
  const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(sim::coordinates(period.begin).size(), j);
  const sim::State above = map.from(sim::displaced(period.begin, change), Monodromy::without).end;
  const sim::State below = map.from(sim::displaced(period.begin, -change), Monodromy::without).end;
  return (sim::coordinates(above) - sim::coordinates(below)) / (2.0 * step);
}

}  // namespace

TEST_CASE("smooth engine: a perturbation passes a reversal at which the force turns over at once",
          "[sim][smooth][derivative]") {
  // rate_state: the force changes its sign within exp(-mu0/a) = 1e-28 of the reference velocity, far below the
  // rounding of the motion's velocity. Differences of 1e-5 of the motion are smooth, and good to 1e-6 of the column
  // at a tolerance of 1e-11.
  sim::Model model;
  model.oscillator = {.mass = 0.058, .stiffness = 92.8, .damping = 0.0933};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 0.0122, .frequency = 11.4, .phase = 0.633};
  ParameterValues values = {
      {"normal_force", 0.0268},       {"mu0", 0.4617}, {"a", 0.00707}, {"b", 0.00823}, {"slip_distance", 0.00255},
      {"reference_velocity", 6.49e-4}};
  values.set("evolution", "slip");
  add_law(model, "rate_state", std::move(values));
  for (const sim::SolverKind kind : {sim::SolverKind::automatic, sim::SolverKind::implicit_steps}) {
    model.solver.kind = kind;
    sim::PeriodMap map(model);
    const ForcingPeriod period = third_period(map, 0.01998, -0.618);
    for (const Eigen::Index j : {0, 1}) {
      const double step = 1e-5 * period.size * (j == 0 ? 1.0 : 40.0);
      const Eigen::VectorXd expected = quotient(map, period, j, step);
      CAPTURE(j, period.monodromy.col(j).transpose(), expected.transpose());
      CHECK((period.monodromy.col(j) - expected).norm() < 1e-5 * expected.norm());
    }
  }
}

TEST_CASE("smooth engine: the error of a creeping speed makes no acceleration of a perturbation",
          "[sim][smooth][derivative]") {
  // A dashpot that forgets a speed within 1e-9 s holds the mass at the start and the end of the period. In between
  // it reverses twice. The expected values are those of the variational equations by another integrator (SciPy's
  // Radau at 1e-10); entries below 1e-6 are at most 1e-9 there. That of the speed at the start depends on where the
  // steps lie in the creep: at a hundred tolerances from 1e-13 to 1e-9 it is 3e-8 in the median. With the error of
  // the speed it is 4e-5.
  sim::Model model;
  model.oscillator = {
      .mass = 0.5810581426852638, .stiffness = 0.04863080134767088, .damping = 0.013114710200268493};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.0060938901480726325,
                      .frequency = 0.10135740907389945};
  add_law(model, "rate_state",
          {{"normal_force", 4.7308639377526694e-05},
           {"mu0", 0.5803561889078969},
           {"a", 0.01897566260537042},
           {"b", 0.03488888491757878},
           {"slip_distance", 0.00440063882460621},
           {"reference_velocity", 5.142651890709898e-06}});
  sim::PeriodMap map(model);
  const Eigen::MatrixXd monodromy = third_period(map, 0.0, 0.0).monodromy;
  CAPTURE(monodromy);
  CHECK(monodromy(0, 0) == Approx(0.283986298).epsilon(1e-6));
  CHECK(monodromy(2, 0) == Approx(-6.12012).epsilon(1e-5));
  CHECK(monodromy(0, 2) == Approx(-5.73689e-6).epsilon(1e-5));
  CHECK(monodromy(2, 2) == Approx(0.003578686).epsilon(1e-5));
  CHECK(std::abs(monodromy(1, 0)) < 1e-8);
  CHECK(std::abs(monodromy(0, 1)) < 1e-6);
  CHECK(std::abs(monodromy(1, 1)) < 1e-12);
}

TEST_CASE("smooth engine: a creep far below the tolerance of steps forgets its speed at once",
          "[sim][smooth][derivative]") {
  // The dashpot forgets a speed within 4e-22 s, and turns with the forces. SciPy's Radau: 3.746e-22, -3.810e-20 and
  // -1e-38. Over the first, the way in a first step of 1e16 such times, the slope of the dashpot changes.
  sim::Model model;
  model.oscillator = {.mass = 3.5182079681767204, .stiffness = 357.8256391009208, .damping = 34.15940244411971};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.0007991416659904486,
                      .frequency = 1645.6725734051806,
                      .phase = 5.2203636202187};
  ParameterValues values = {{"normal_force", 206.7474860631241},
                            {"mu0", 0.4667786677209173},
                            {"a", 0.013299328887202687},
                            {"b", 0.02113135118474439},
                            {"slip_distance", 2.2786787260925265e-05},
                            {"reference_velocity", 2.5574202219514857e-07}};
  values.set("evolution", "slip");
  add_law(model, "rate_state", std::move(values));
  sim::PeriodMap map(model);
  const Eigen::MatrixXd monodromy = third_period(map, 0.0, 0.0).monodromy;
  CAPTURE(monodromy);
  CHECK(monodromy(0, 1) == Approx(3.746e-22).epsilon(0.1));
  CHECK(monodromy(1, 0) == Approx(-3.81e-20).epsilon(1e-3));
  CHECK(std::abs(monodromy(1, 1)) < 1e-15);
}

TEST_CASE("smooth engine: perturbations of turning points among stiff contacts are not lost in rounding",
          "[sim][smooth][derivative]") {
  // The contacts slip after 3e-10 m, 3e-7 of the motion: the size of the states that remember turning points.
  sim::Model model;
  model.oscillator = {.mass = 15.6,
                      .stiffness = 24.2,
                      .damping = 61.5,
                      .damper_to = sim::DamperTo::base,
                      .cubic_stiffness = -2.69e6};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 1.348e-4, .frequency = 15.65, .phase = 3.05};
  add_law(model, "friction_lag",
          {{"kinetic", 1.476e-4}, {"static", 2.855e-4}, {"stribeck_velocity", 1.246e-5}, {"lag", 0.367}});
  add_law(model, "iwan", {{"stiffness", 152646.0}, {"limit", 6.127e-4}, {"count", 14.0}});
  sim::PeriodMap map(model);
  const ForcingPeriod period = third_period(map, -0.001293, 0.0003387);
  const Eigen::VectorXd expected = quotient(map, period, 0, 1e-5 * period.size);
  CAPTURE(period.monodromy.col(0).transpose(), expected.transpose());
  CHECK((period.monodromy.col(0) - expected).norm() < 1e-6 * expected.norm());
}

TEST_CASE("smooth engine: a perturbation that decays within one explicit step is gone after it",
          "[sim][smooth][derivative]") {
  // The spring of bouc_wen yields within 1e-6 m and moves by 1e-3 m: exp(-1000) of its former state remains. The
  // stability function of the steps would leave some per cent.
  sim::Model model;
  model.oscillator = {.mass = 0.00715, .stiffness = 0.0427, .damping = -6.69e-4};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.0055, .frequency = 1933.0};
  add_law(model, "bouc_wen", {{"limit", 4.99e-9}, {"stiffness", 0.00559}, {"exponent", 1.996}, {"ratio", 0.453}});
  model.solver.kind = sim::SolverKind::explicit_steps;
  sim::PeriodMap map(model);
  const ForcingPeriod period = third_period(map, 0.00154, -0.0143);
  REQUIRE(period.monodromy.rows() == 3);
  CHECK(std::abs(period.monodromy(2, 2)) < 1e-9);
}

TEST_CASE("smooth engine: springs under a force limit that vanished and comes back are those of no stretch",
          "[sim][smooth][derivative]") {
  // Where the limit vanishes, the rate of a spring's force is 0/0. If the remainder of its derivative grew again
  // with the limit, the error of the monodromy matrix would be 5 %.
  sim::Model model;
  model.oscillator = {.mass = 0.0555, .stiffness = 4.224, .damping = 0.0019};
  model.excitation = {
      .type = sim::ExcitationType::force_harmonic, .amplitude = 0.014946, .frequency = 2.4473, .phase = 4.834};
  const std::vector<ParameterValues> elements = {{{"stiffness", 100.67}, {"share", 1.0}}};
  add_law(model, "generalized_maxwell_slip",
          {{"kinetic", 0.0013},
           {"stribeck_velocity", 0.002208},
           {"elements", elements},
           {"attraction", 0.01587},
           {"position_slope", -2.666}});
  add_law(model, "reset_integrator", {{"kinetic", 0.001454}, {"stiffness", 9295.0}, {"static_gain", 0.743}});
  sim::PeriodMap map(model);
  const ForcingPeriod period = third_period(map, -0.0004, 0.0231);
  for (const Eigen::Index j : {0, 1}) {
    const double step = 1e-6 * period.size * (j == 0 ? 1.0 : 8.7);
    const Eigen::VectorXd expected = quotient(map, period, j, step);
    REQUIRE(expected.size() == period.monodromy.rows());
    CAPTURE(j, period.monodromy.col(j).transpose(), expected.transpose());
    CHECK((period.monodromy.col(j) - expected).head(2).norm() < 1e-3 * expected.head(2).norm());
  }
}

TEST_CASE("smooth engine: a mode change is differentiated along each perturbation and in the sizes of its states",
          "[sim][smooth][derivative]") {
  // The heat of a contact is a state of 1e-6 W beside positions of 1 m: a displacement by a small part of a
  // position would be many times this heat.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 0.8};
  ParameterValues values = {
      {"kinetic", 1e-3}, {"static", 1e-3}, {"contact_stiffness", 1.0}, {"contact_damping", 0.3}};
  const std::vector<ParameterValues> warming = {{{"power", 1e-6}, {"time_constant", 1e4}}};
  values.set("warming", warming);
  add_law(model, "contact_compliance", std::move(values));
  model.solver.tolerance = 1e-12;
  sim::PeriodMap map(model);
  const ForcingPeriod period = third_period(map, 0.3, 0.2);
  REQUIRE(period.monodromy.rows() == 4);
  const Eigen::Index heat = 3;
  const Eigen::VectorXd expected = quotient(map, period, heat, 1e-9);
  CAPTURE(period.monodromy.col(heat).transpose(), expected.transpose());
  CHECK((period.monodromy.col(heat) - expected).norm() < 1e-5 * expected.norm());
}

TEST_CASE("smooth engine: a perturbation that has died out to a subnormal number passes a mode change",
          "[sim][smooth][derivative]") {
  // The derivative of a slider's speed decays while it slides, to numbers by which nothing can be divided; rounding
  // decides at which positions.
  sim::Model model;
  model.oscillator = {.mass = 1.446, .stiffness = 256.156, .damping = 45.93, .damper_to = sim::DamperTo::base};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 7.384e-3,
                      .frequency = 49.292,
                      .harmonics = {{4, 2.08e-4, 4.672},
                                    {5, 1.244e-4, 3.701},
                                    {6, 3.46e-3, 4.44},
                                    {8, 1.833e-3, 6.19},
                                    {13, 8.748e-4, 1.117}}};
  add_law(model, "normal_vibration",
          {{"mu", 0.547},
           {"weight", 0.33},
           {"static_approach", 2.495e-6},
           {"normal_mass", 7.182},
           {"normal_damping_ratio", 0.4573},
           {"lift_velocity", 0.0289},
           {"lift", 1.535}});
  add_law(model, "contact_compliance",
          {{"kinetic", 0.2083}, {"static", 0.2706}, {"contact_stiffness", 2.2e6}, {"contact_damping", 0.1534}});
  const auto engine = sim::make_engine(model);
  engine->start(0.00173, 0.2267);
  sim::State sliding = engine->state();
  sliding.memories[1] = {.mode = 1, .state = {0.0}};
  engine->track_sensitivity(true);
  for (int i = 0; i < 20; ++i) {
    sliding.x += 1e-6;
    engine->restart(sliding);
    engine->reset_sensitivity();
    while (engine->next(0.02) != nullptr) continue;
    CAPTURE(sliding.x);
    CHECK(engine->outcome().ok());
    CHECK(engine->sensitivity().allFinite());
  }
}

TEST_CASE("smooth engine: a perturbation turns as often as it does where the motion that it leaves does not turn",
          "[sim][smooth][derivative]") {
  // A mass that friction holds, and one attached to it: z'' = -stiffness/mass (z - x) - damping/mass z', which
  // oscillates five times in a forcing period in which nothing moves. Steps that depend on the motion alone are
  // half an oscillation long.
  sim::Model model;
  model.oscillator = {.mass = 50.0, .stiffness = 75.0, .damping = 5.0};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.7, .frequency = 10.0};
  add_law(model, "coulomb", {{"kinetic", 60.0}, {"static", 120.0}});
  add_law(model, "attached_mass", {{"mass", 0.003}, {"stiffness", 7.5}, {"damping", 0.006}});
  sim::PeriodMap map(model);
  const ForcingPeriod period = map.from_start(0.005, 0.0, Monodromy::with);
  REQUIRE(period.monodromy.rows() == 4);
  // exp(A t) of z'' + 2 z' + 2500 z = 2500 x.
  const double t = 0.2 * std::numbers::pi;
  const double w = std::sqrt(2499.0);
  const double left = std::exp(-t);
  const double c = std::cos(w * t);
  const double s = std::sin(w * t) / w;
  Eigen::Matrix4d expected = Eigen::Matrix4d::Zero();
  expected(0, 0) = 1.0;
  expected.bottomRightCorner<2, 2>() << left * (c + s), left * s, -2500.0 * left * s, left * (c - s);
  expected(2, 0) = 1.0 - expected(2, 2);
  expected(3, 0) = -expected(3, 2);
  CAPTURE(period.monodromy, expected);
  CHECK((period.monodromy - expected).cwiseAbs().maxCoeff() < 1e-5 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE(
    "smooth engine: the derivative of a motion that follows its drive on a stiff contact is that of the exact "
    "engine",
    "[sim][smooth][derivative]") {
  // The contact never slips. Perturbations oscillate on it, 32 times in a forcing period, or decay on it. The
  // motion itself does neither, and implicit steps are longer than both.
  for (const double contact_damping : {0.0, 3.0, 100.0, 600.0}) {
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 2.0};
    model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 1.0, .frequency = 10.0};
    add_law(model, "contact_compliance",
            {{"kinetic", 2.0}, {"contact_stiffness", 1e5}, {"contact_damping", contact_damping}});
    sim::PeriodMap exact(model);
    ForcingPeriod expected = exact.from_start(0.0, 0.0, Monodromy::without);
    for (int i = 0; i < 40; ++i) expected = exact.next(Monodromy::without);
    expected = exact.from(expected.end, Monodromy::with);
    for (const sim::SolverKind kind : {sim::SolverKind::explicit_steps, sim::SolverKind::implicit_steps}) {
      model.solver.kind = kind;
      sim::PeriodMap map(model);
      const ForcingPeriod found = map.from(expected.begin, Monodromy::with);
      REQUIRE(found.monodromy.rows() == expected.monodromy.rows());
      CAPTURE(contact_damping, static_cast<int>(kind), found.monodromy, expected.monodromy);
      CHECK((found.monodromy - expected.monodromy).cwiseAbs().maxCoeff() <
            1e-5 * std::max(1.0, expected.monodromy.cwiseAbs().maxCoeff()));
    }
  }
}

TEST_CASE("smooth engine: the delay of a mode change that leaves the force as it is drowns no derivative",
          "[sim][smooth][derivative]") {
  // The late velocity w follows within 1.1 s, 15 forcing periods. A perturbation of it delays the instant at which
  // its sign changes by more than a period, and the force, the level of |w|, does not depend on that instant. The
  // effect on the velocity nearly cancels between the quarters of the period.
  sim::Model model;
  model.oscillator = {.mass = 215.2919240753114, .stiffness = 5.660864323429163};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.0002379403056107849,
                      .frequency = 81.46603743655687};
  add_law(model, "friction_lag",
          {{"kinetic", 5.3547509097241304e-08},
           {"static", 2.5578152106979646e-07},
           {"stribeck_velocity", 7.260599837169515e-06},
           {"exponent", 1.7727264744854236},
           {"lag", 1.1441100468953922}});
  sim::PeriodMap map(model);
  sim::State start = map.from_start(-9.42695685e-10, 2.29035936e-11, Monodromy::without).begin;
  start.memories[0] = {.mode = -1, .state = {-8.23858427e-10}};
  const ForcingPeriod period = map.from(start, Monodromy::with);
  // The variational equation with saltation matrices, in units of the motion, by DOP853 of SciPy at a tolerance of
  // 3e-14.
  CAPTURE(period.monodromy);
  CHECK(period.monodromy(0, 2) == Approx(-1.24540e-10).epsilon(1e-3));
  CHECK(period.monodromy(1, 0) == Approx(-2.02674716e-3).epsilon(1e-6));
  CHECK(period.monodromy(1, 1) == Approx(9.99162544e-1).epsilon(1e-7));
  CHECK(std::abs(period.monodromy(1, 2) + 4.6e-12) < 1e-12);
}

TEST_CASE("smooth engine: a perturbation that turns a million times in a forcing period is followed at once",
          "[sim][smooth][derivative]") {
  // A mass on a contact that never slips rings at 53,000 rad/s under a drive of 0.19 rad/s; nothing of that is left
  // after the period. Another rings at 600 rad/s, hardly damped. The motion follows the drive in steps of up to
  // 0.012 s. Halved until a perturbation turns by less than 1 rad, these were millions of parts.
  const auto [decay, contact] = GENERATE(std::pair(60.0, 5e7), std::pair(0.03, 6.4e3));
  sim::Model model;
  model.oscillator = {.mass = 0.0177, .stiffness = 79.1};
  model.oscillator.damping = 2.0 * decay * model.oscillator.mass;
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 5e-4, .frequency = 0.19, .phase = 1.0};
  add_law(model, "contact_compliance", {{"kinetic", 0.3}, {"contact_stiffness", contact}});
  model.solver.kind = sim::SolverKind::implicit_steps;
  // On the linear response, which does not ring.
  const double w = model.excitation.frequency;
  const std::complex<double> response =
      model.oscillator.stiffness * std::polar(model.excitation.amplitude, model.excitation.phase) /
      std::complex(model.oscillator.stiffness + contact - model.oscillator.mass * w * w,
                   model.oscillator.damping * w);
  sim::PeriodMap motion(model);
  (void)motion.from_start(response.real(), -w * response.imag(), Monodromy::without);
  const long alone = motion.engine().work();
  sim::PeriodMap map(model);
  const ForcingPeriod period = map.from_start(response.real(), -w * response.imag(), Monodromy::with);
  REQUIRE(period.monodromy.rows() == 3);
  // exp(A t) of x'' + 2 decay x' + ringing^2 x = 0. Its phase of 2e4 rad is known to 1e-8 of itself, and what has
  // died out to the rounding of what was there.
  const double ringing = std::sqrt((model.oscillator.stiffness + contact) / model.oscillator.mass - decay * decay);
  const double t = 2.0 * std::numbers::pi / w;
  const double left = std::exp(-decay * t);
  const double c = std::cos(ringing * t);
  const double s = std::sin(ringing * t);
  CAPTURE(decay, period.monodromy, map.engine().work(), alone, left, c, s);
  const double allowed = 2e-4 * left + 1e-12;
  CHECK(std::abs(period.monodromy(0, 0) - left * c) < allowed);
  CHECK(std::abs(period.monodromy(0, 1) * ringing - left * s) < allowed);
  CHECK(std::abs(period.monodromy(1, 0) / ringing + left * s) < allowed);
  CHECK(std::abs(period.monodromy(1, 1) - left * c) < allowed);
  CHECK(map.engine().work() < 4 * alone);
}

TEST_CASE(
    "smooth engine: a perturbation that turns fast on a stiffness that changes is followed in parts of a step",
    "[sim][smooth][derivative]") {
  // It turns 100 times in a forcing period on a contact that never slips, beside a spring whose stiffness changes
  // by 0.75 % of the contact's: 2.4 rad more or less.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 2.0, .cubic_stiffness = 1e6};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.05, .frequency = 10.0};
  add_law(model, "contact_compliance", {{"kinetic", 1e5}, {"contact_stiffness", 1e6}});
  model.solver.kind = sim::SolverKind::implicit_steps;
  sim::PeriodMap map(model);
  ForcingPeriod period = map.from_start(0.0, 0.0, Monodromy::without);
  for (int i = 0; i < 20; ++i) period = map.next(Monodromy::without);
  period = map.from(period.end, Monodromy::with);
  model.solver.kind = sim::SolverKind::explicit_steps;
  sim::PeriodMap quick(model);
  for (const Eigen::Index j : {0, 1}) {
    const Eigen::VectorXd expected = quotient(quick, period, j, 1e-3 * period.size * (j == 0 ? 1.0 : 1000.0));
    CAPTURE(j, period.monodromy.col(j).transpose(), expected.transpose());
    // In units of the ringing: velocities are 1000 times positions.
    CHECK(std::abs(period.monodromy(0, j) - expected[0]) <
          1e-5 * std::abs(expected[1]) / 1000.0 + 1e-5 * std::abs(expected[0]));
    CHECK(std::abs(period.monodromy(1, j) - expected[1]) <
          1e-5 * std::abs(expected[1]) + 1e-5 * 1000.0 * std::abs(expected[0]));
  }
}

TEST_CASE("smooth engine: bristles close to their limit have the slope that they have there",
          "[sim][smooth][derivative]") {
  // After a long slip they are 4e-8 of their deflection below it, closer than the usual difference for a Jacobian
  // is long, and with an exponent of 1.21 the slope over that difference is a multiple of the slope there.
  sim::Model model;
  model.oscillator = {
      .mass = 0.8806702910810212, .stiffness = 0.014102179157980819, .damping = 0.05446339049698237};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.057864806271325245,
                      .frequency = 0.09029009909957765};
  add_law(model, "dahl",
          {{"kinetic", 0.00017935416166372928}, {"sigma0", 0.22817271123673333}, {"exponent", 1.210412389144714}});
  sim::PeriodMap map(model);
  sim::State start = map.from_start(0.052532921475056039, 0.0054608610952225712, Monodromy::without).begin;
  start.memories[0].state = {0.00078604559350362372};
  const ForcingPeriod period = map.from(start, Monodromy::with);
  // The variational equations in 1 -+ sigma0 z/kinetic, in which nothing cancels, by SciPy's DOP853 at 1e-13.
  CAPTURE(period.monodromy);
  CHECK(period.monodromy(0, 2) == Approx(-0.891594710).epsilon(1e-5));
  CHECK(period.monodromy(1, 2) == Approx(0.0370911506).epsilon(1e-5));
  CHECK(period.monodromy(2, 2) == Approx(-3.63466e-9).epsilon(1e-2));
  CHECK(period.monodromy(2, 0) == Approx(1.83104e-11).epsilon(5e-2));
  CHECK(period.monodromy(0, 0) == Approx(-2.45939581e-3).epsilon(1e-6));
  CHECK(period.monodromy(0, 1) == Approx(0.609837176).epsilon(1e-7));
}
