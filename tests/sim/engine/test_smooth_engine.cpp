/// The smooth engine against the exact one, closed forms and published numbers.

#include "sim/engine/smooth_engine.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "sim/engine/exact_engine.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/standard_system.hpp"

namespace {

using namespace dualdamp;
using friction::ParameterValues;
using sim::SolverKind;
using test::law;

sim::Model system_with(std::string_view name, const ParameterValues& values, SolverKind kind, double tolerance) {
  sim::Model model = test::standard_system(law(name, values));
  model.solver = {kind, tolerance};
  return model;
}

/// F(t) = level, for a law without modes that depends on the velocity at an earlier time.
struct Delayed {
  double lag;
  [[nodiscard]] double force(const friction::Memory&, const friction::Instant& now, friction::Direction) const {
    return 3.0 * now.past_velocity;
  }
  [[nodiscard]] double delay() const { return lag; }
};

/// No force, and a guard that touches zero at one time.
struct Touching {
  double when;
  [[nodiscard]] friction::Memory start(const friction::Instant&) const { return {}; }
  [[nodiscard]] double force(const friction::Memory&, const friction::Instant&, friction::Direction) const {
    return 0.0;
  }
  void guards(const friction::Memory&, const friction::Instant& now, friction::Direction,
              std::vector<double>& values) const {
    values.push_back((now.t - when) * (now.t - when) + 1e-14);
  }
};

}  // namespace

TEST_CASE("smooth engine: exact laws come out as in the exact engine", "[sim][smooth]") {
  const std::vector<std::pair<std::string_view, ParameterValues>> laws = {
      {"coulomb", {{"kinetic", 2.0}}},
      {"coulomb", {{"kinetic", 5.0}, {"static", 7.0}}},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1000.0}}},
      {"contact_compliance", {{"kinetic", 2.0}, {"static", 3.0}, {"contact_stiffness", 1e4}}},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e4}, {"contact_damping", 20.0}}},
      {"iwan", {{"stiffness", 1000.0}, {"limit", 4.0}, {"count", 5.0}, {"distribution", std::string("uniform")}}},
      {"reset_integrator", {{"kinetic", 2.0}, {"stiffness", 1e4}, {"static_gain", 0.5}}},
      {"coulomb", {{"kinetic", 2.0}, {"position_slope", 5.0}}},
      {"coulomb", {{"kinetic", 2.0}, {"drift", -0.05}}},
  };
  for (const SolverKind kind : {SolverKind::explicit_steps, SolverKind::implicit_steps}) {
    for (const auto& [name, values] : laws) {
      CAPTURE(name, static_cast<int>(kind));
      const sim::Model model = system_with(name, values, SolverKind::automatic, 1e-11);
      sim::Model smooth = model;
      smooth.solver.kind = kind;
      REQUIRE(sim::is_exact(model));
      REQUIRE(!sim::is_exact(smooth));
      const double duration = 12.3 * std::numbers::pi / 5.0;
      const sim::History expected = sim::simulate(model, {.duration = duration, .sample_rate = 40.0});
      const sim::History found = sim::simulate(smooth, {.duration = duration, .sample_rate = 40.0});
      REQUIRE(found.outcome.ok());
      REQUIRE(found.events.size() == expected.events.size());
      // Motions are some 0.1 m and 1 m/s large; local errors of 1e-11 in a contracting motion. A relaxed damper
      // stops with the mass; rounding decides which is first.
      for (std::size_t i = 0; i < found.events.size(); ++i) {
        const auto beside = [&](std::size_t j) {
          return j < found.events.size() && found.events[j].kind == expected.events[i].kind &&
                 std::abs(expected.events[j].t - expected.events[i].t) < 1e-9;
        };
        CHECK((beside(i) || beside(i + 1) || beside(i - 1)));
        CHECK(std::abs(found.events[i].t - expected.events[i].t) < 1e-9);
        CHECK(std::abs(found.events[i].x - expected.events[i].x) < 1e-10);
      }
      for (std::size_t i = 0; i < found.samples.size(); ++i) {
        CHECK(std::abs(found.samples[i].x - expected.samples[i].x) < 1e-10);
        CHECK(std::abs(found.samples[i].v - expected.samples[i].v) < 1e-9);
      }
      CHECK(std::abs(found.energy.defect) < 1e-9 * found.energy.input);
      CHECK(found.energy.friction == Approx(expected.energy.friction).epsilon(1e-9));
    }
  }
}

TEST_CASE("smooth engine: a guard that passes zero within what a step lands by changes the mode once",
          "[sim][smooth]") {
  // At t = 114.54 s the late velocity passes zero, where its rate is as small as its remainder: 1.6e-17 m/s.
  sim::Model model;
  model.oscillator = {.mass = 17.099728675595408,
                      .stiffness = 3.292623622011964,
                      .damping = -0.9813737370539959,
                      .cubic_stiffness = 436092.00283127645};
  model.friction = {law("friction_lag", {{"kinetic", 1.5695147575818305e-07},
                                         {"static", 6.042287471029727e-07},
                                         {"stribeck_velocity", 1.1957276805978776e-05},
                                         {"form", std::string("lorentz")},
                                         {"lag", 0.024788305151357798}})};
  model.initial = {.position = 0.0018834253952637234, .velocity = 0.0};
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::implicit_steps}) {
    model.solver.kind = kind;
    const sim::History history = sim::simulate(model, {.duration = 120.0});
    INFO(history.outcome.reason);
    CHECK(history.outcome.ok());
    CHECK(std::abs(history.energy.defect) < 1e-9 * std::abs(history.energy.viscous));
  }
}

TEST_CASE("smooth engine: the monodromy matrix is that of the exact engine", "[sim][smooth]") {
  const std::vector<std::pair<std::string_view, ParameterValues>> laws = {
      {"coulomb", {{"kinetic", 2.0}}},
      {"coulomb", {{"kinetic", 7.0}, {"static", 7.5}}},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1000.0}}},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e4}, {"contact_damping", 20.0}}},
      {"reset_integrator", {{"kinetic", 2.0}, {"stiffness", 1e4}, {"static_gain", 0.5}}},
  };
  for (const auto& [name, values] : laws) {
    CAPTURE(name);
    const sim::Model model = system_with(name, values, SolverKind::automatic, 1e-12);
    sim::Model smooth = model;
    smooth.solver.kind = SolverKind::implicit_steps;
    sim::PeriodMap exact_map(model);
    sim::PeriodMap smooth_map(smooth);
    const sim::ForcingPeriod expected = exact_map.from_start(0.03, 0.5, sim::Monodromy::with);
    const sim::ForcingPeriod found = smooth_map.from_start(0.03, 0.5, sim::Monodromy::with);
    REQUIRE(found.monodromy.rows() == expected.monodromy.rows());
    // Central differences of steps: relative error 1e-8 at worst over some twenty steps.
    CHECK((found.monodromy - expected.monodromy).cwiseAbs().maxCoeff() <
          1e-7 * expected.monodromy.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("smooth engine: known peaks at the default and at the tightest tolerance", "[sim][smooth]") {
  struct Known {
    std::string_view name;
    ParameterValues values;
    double cubic;
    double peak;
  };
  // Peaks of steady states of the standard system, computed independently to 14 digits or more.
  const std::vector<Known> known = {
      {"coulomb", {{"kinetic", 2.0}}, 0.0, 0.18607809795678620},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e3}}, 0.0, 0.18715434612621097},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e4}}, 0.0, 0.186333154800891},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e5}}, 0.0, 0.186150328050063},
      {"lugre",
       {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}, {"sigma0", 1e4}, {"sigma1", 20.0}},
       0.0,
       0.18620999673692603},
      {"dahl", {{"kinetic", 2.0}, {"sigma0", 1000.0}}, 0.0, 0.18713706894086113},
      {"stribeck", {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}}, 0.0, 0.18605173376427311},
      {"coulomb", {{"kinetic", 2.0}}, 2000.0, 0.21228804531802404},
  };
  for (const Known& k : known) {
    for (const double tolerance : {sim::Solver{}.tolerance, 1e-13}) {
      CAPTURE(k.name, tolerance);
      sim::Model model = system_with(k.name, k.values, SolverKind::automatic, tolerance);
      model.oscillator.cubic_stiffness = k.cubic;
      const sim::SteadyState state = sim::steady_state(model);
      REQUIRE(state.outcome.ok());
      CHECK(std::abs(state.peak / k.peak - 1.0) < (tolerance < 1e-12 ? 1e-11 : 1e-9));
      CHECK(std::abs(state.energy.defect) < 1e-9 * state.energy.input);
      CHECK(state.stable());
    }
  }
}

TEST_CASE("smooth engine: the stick-slip example of the LuGre paper", "[sim][smooth]") {
  // Canudas de Wit et al. 1995, section IV: a unit mass pulled at 0.1 m/s by a spring of 2 N/m.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 2.0, .damping = 0.0};
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = 0.1};
  model.friction = {law("lugre", {{"kinetic", 1.0},
                                  {"static", 1.5},
                                  {"stribeck_velocity", 0.001},
                                  {"sigma0", 1e5},
                                  {"sigma1", std::sqrt(1e5)},
                                  {"sigma2", 0.4}})};
  const sim::History history = sim::simulate(model, {.duration = 60.0, .sample_rate = 200.0});
  REQUIRE(history.outcome.ok());
  double low = 1e9;
  double high = -1e9;
  std::vector<double> rises;  // the spring force crosses 1 N upwards once a period
  double before = 0.0;
  for (const sim::Sample& sample : history.samples) {
    const double spring = 2.0 * (sample.y - sample.x);
    if (sample.t > 25.0) {
      low = std::min(low, spring);
      high = std::max(high, spring);
      if (before < 1.0 && spring >= 1.0) rises.push_back(sample.t - 0.005 * (spring - 1.0) / (spring - before));
    }
    before = spring;
  }
  REQUIRE(rises.size() >= 4);
  // Extremes between samples: the spring force is flat there to 2 (0.0025)^2/2 N.
  CHECK(low == Approx(0.741239).margin(2e-5));
  CHECK(high == Approx(1.507988).margin(2e-5));
  CHECK((rises[3] - rises[0]) / 3.0 == Approx(6.36272).margin(1e-5));
}

TEST_CASE("smooth engine: explicit steps give up a motion that is too sharp, implicit ones do not",
          "[sim][smooth]") {
  // Near v = 0 the force of rock changes its sign within exp(-0.6/0.01) of the reference velocity.
  sim::Model model = test::standard_system(law("rate_state", {{"normal_force", 5.0},
                                                              {"mu0", 0.6},
                                                              {"a", 0.01},
                                                              {"b", 0.015},
                                                              {"slip_distance", 1e-4},
                                                              {"reference_velocity", 1e-3}}));
  model.excitation.amplitude = 0.035;  // m: beyond break-away for a part of each period
  const sim::SteadyState automatic = sim::steady_state(model);
  REQUIRE(automatic.outcome.ok());
  CHECK(automatic.stops_per_cycle == 0);
  model.solver = {.kind = sim::SolverKind::implicit_steps, .tolerance = 1e-12};
  CHECK(automatic.amplitude == Approx(sim::steady_state(model).amplitude).epsilon(1e-9));
  model.solver.kind = sim::SolverKind::explicit_steps;
  const sim::SteadyState state = sim::steady_state(model);
  CHECK(state.outcome.kind == core::OutcomeKind::event_limit);
  CHECK(state.outcome.reason.find("too fast") != std::string::npos);
}

TEST_CASE("smooth engine: a free vibration that creeps for ever ends after its last reversal", "[sim][smooth]") {
  // Rock creeps more and more slowly and neither reverses nor sticks; a ninth reversal would take minutes.
  sim::Model model;
  model.oscillator = {.mass = 1.042, .stiffness = 1568.0, .damping = 8.0};
  model.initial = {.position = 0.04};
  model.friction = {law("rate_state", {{"normal_force", 10.0},
                                       {"mu0", 0.2},
                                       {"a", 0.05},
                                       {"b", 0.075},
                                       {"slip_distance", 0.01},
                                       {"reference_velocity", 0.01}})};
  const sim::FreeDecay decay = sim::free_decay(model, 20);
  CHECK(decay.outcome.ok());
  CHECK_FALSE(decay.came_to_rest);
  CHECK(decay.extremes.size() == 8);
}

TEST_CASE("smooth engine: what a guard touches behind an event is not reported before it", "[sim][smooth]") {
  // The free mass turns at pi/10. The step that finds this extends to the place where the guard touches zero, and
  // so does the interval that begins there. Both must not report the grazing. A loose tolerance makes long steps.
  int touches = 0;
  for (int i = 1; i <= 30; ++i) {
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.0};
    model.initial = {.position = 0.1};
    model.solver = {SolverKind::implicit_steps, 1e-6};
    const double when = std::numbers::pi / 10.0 + 1e-3 * i;
    model.friction = {friction::Law(Touching{when})};
    const sim::History history = sim::simulate(model, {.duration = 0.4});
    REQUIRE(history.outcome.ok());
    long reported = 0;
    for (const sim::Event& event : history.events) {
      if (event.kind != sim::EventKind::grazing) continue;
      ++reported;
      CHECK(std::abs(event.t - when) < 1e-6);
    }
    CHECK(reported <= 1);
    CHECK(history.certificate.grazings == reported);
    touches += static_cast<int>(reported);
  }
  CHECK(touches > 10);
}

TEST_CASE("smooth engine: a delayed viscous force", "[sim][smooth]") {
  // m x'' + c x' + k x + 3 x'(t - lag) = k Y cos w t has a steady state in closed form.
  const double w = 10.0;
  for (const double lag : {0.01, 0.05, 0.8}) {
    for (const SolverKind kind : {SolverKind::explicit_steps, SolverKind::implicit_steps}) {
      CAPTURE(lag, static_cast<int>(kind));
      sim::Model model = test::standard_system(friction::Law(Delayed{lag}));
      model.solver = {kind, 1e-11};
      const std::complex<double> i(0.0, 1.0);
      const double expected = std::abs(10.0 / (100.0 - w * w + i * w * 4.0 + i * w * 3.0 * std::exp(-i * w * lag)));
      const sim::SteadyState state = sim::steady_state(model);
      REQUIRE(state.outcome.ok());
      CHECK(state.peak == Approx(expected).epsilon(1e-8));
    }
  }
}

TEST_CASE("smooth engine: free hardening spring", "[sim][smooth]") {
  // x'' + 100 x + 5000 x^3 = 0 from x = 0.2 m: the quarter period is the complete elliptic integral
  //   T = 4 K(m) / sqrt(100 + 5000 A^2), m = 5000 A^2 / (2 (100 + 5000 A^2)).
  const double A = 0.2;
  const double hardening = 5000.0 * A * A;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.0};
  model.oscillator.cubic_stiffness = 5000.0;
  model.initial = {.position = A};
  const double modulus = std::sqrt(hardening / (2.0 * (100.0 + hardening)));
  const double period = 4.0 * std::comp_ellint_1(modulus) / std::sqrt(100.0 + hardening);
  const sim::FreeDecay decay = sim::free_decay(model, 5);
  REQUIRE(decay.extremes.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(std::abs(decay.extremes[i].t - 0.5 * period * static_cast<double>(i)) < 1e-10);
    CHECK(std::abs(std::abs(decay.extremes[i].x) - A) < 1e-10);
  }
}

TEST_CASE("smooth engine: a motion that a ramp begins from rest is as exact in every unit", "[sim][smooth]") {
  // At first neither spring nor contact is stretched: the size of the motion is that of the ramp's end. If forces
  // and lengths are 2^-30 times as large, so are all numbers of the motion, and its times are the same.
  const auto times = [](double unit) {
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.5};
    model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = 0.01 * unit};
    model.friction = {
        law("contact_compliance", {{"kinetic", 2.0 * unit}, {"static", 3.0 * unit}, {"contact_stiffness", 1e4}})};
    model.solver.kind = sim::SolverKind::explicit_steps;
    const std::unique_ptr<sim::Engine> engine = sim::make_engine(model);
    std::vector<double> result;
    while (const sim::Interval* interval = engine->next(6.0))
      if (interval->ending) result.push_back(interval->end());
    return result;
  };
  const std::vector<double> large = times(1.0);
  CHECK(large.size() > 5);
  CHECK(large == times(0x1p-30));
}

TEST_CASE("smooth engine: a release just after the start or before the end of a step is not passed over",
          "[sim][smooth]") {
  // While the mass sticks, a step takes an eighth of the period T of the drive, and guards are watched every T/32,
  // 0.196 rad. The pull exceeds the limit for 0.04 to 0.1 rad only, between two of these points and near an end of
  // the step.
  constexpr double push = 2.0;
  constexpr double omega = 5.0;
  constexpr double end = std::numbers::pi / 4.0;
  for (const auto& [largest_at, half_width] :
       {std::pair{0.08, 0.05}, std::pair{0.03, 0.02}, std::pair{end - 0.03, 0.02}, std::pair{end + 0.03, 0.02}}) {
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1};
    model.excitation = {
        .type = sim::ExcitationType::force_harmonic, .amplitude = push, .frequency = omega, .phase = -largest_at};
    model.friction = {law("coulomb", {{"kinetic", push * std::cos(half_width)}})};
    for (const SolverKind kind : {SolverKind::automatic, SolverKind::explicit_steps, SolverKind::implicit_steps}) {
      model.solver.kind = kind;
      const sim::History history = sim::simulate(model, {.duration = 0.3});
      REQUIRE_FALSE(history.events.empty());
      CHECK(history.events[0].kind == sim::EventKind::release);
      CHECK(history.events[0].t == Approx((largest_at - half_width) / omega).epsilon(1e-9));
    }
  }
}

TEST_CASE("smooth engine: a short stop between two points of a long step is not passed over", "[sim][smooth]") {
  // At constant speed of the base, without damping, the mass stops once in a natural period for 3e-3 of it; an
  // implicit step takes an eighth of a period.
  sim::Model model;
  model.oscillator = {.mass = 3.269733373405227, .stiffness = 84697.72196089235};
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = 0.0007309319467578027};
  model.friction = {law(
      "stribeck",
      {{"kinetic", 1.3785613066002025}, {"static", 1.601828132078246}, {"stribeck_velocity", 0.1073732287243963}})};
  model.initial = {.position = -0.0006610374322015665, .velocity = 0.0};
  const auto stops = [&](SolverKind kind, double tolerance) {
    model.solver = {kind, tolerance};
    const sim::History history = sim::simulate(model, {.duration = 3.6});
    REQUIRE(history.outcome.ok());
    std::vector<double> times;
    for (const sim::Event& event : history.events)
      if (event.kind == sim::EventKind::stop) times.push_back(event.t);
    return times;
  };
  const std::vector<double> expected = stops(SolverKind::explicit_steps, 1e-13);
  CHECK(expected.size() > 80);
  for (const double tolerance : {1e-9, 1e-10, 1e-11, 1e-12}) {
    const std::vector<double> found = stops(SolverKind::implicit_steps, tolerance);
    CAPTURE(tolerance);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 1e-6);
  }
}

TEST_CASE("smooth engine: a contact that slips on from a release lets go at once", "[sim][smooth]") {
  // At the release velocity and acceleration are zero, and the contact is at its limit: its guard begins with t^3,
  // which exceeds rounding only after 2e-5 s. The force of reset_integrator falls when it slips, so a contact that
  // lets go late delays the motion.
  sim::Model model;
  model.oscillator = {.mass = 129.3146724807495, .stiffness = 299.89158568978326, .damping = 12.17478077146789};
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = -0.00016729442226503976};
  model.friction = {
      law("contact_compliance", {{"kinetic", 3.859777841421688}, {"contact_stiffness", 9310.375183939914}}),
      law("reset_integrator",
          {{"kinetic", 0.6759532619933236}, {"stiffness", 810.3244052908267}, {"static_gain", 0.4698049133118544}}),
      law("coulomb", {{"kinetic", 1.0971191359842283}})};
  model.initial = {.position = -0.004851120814833448, .velocity = 0.0};
  const sim::History exact = sim::simulate(model, {.duration = 200.0});
  for (const SolverKind kind : {SolverKind::explicit_steps, SolverKind::implicit_steps}) {
    model.solver = {kind, 1e-13};
    const sim::History smooth = sim::simulate(model, {.duration = 200.0});
    REQUIRE(smooth.events.size() == exact.events.size());
    for (std::size_t i = 0; i < exact.events.size(); ++i) {
      CHECK(smooth.events[i].kind == exact.events[i].kind);
      CHECK(std::abs(smooth.events[i].t - exact.events[i].t) < 1e-7);
    }
  }
}

TEST_CASE("smooth engine: implicit steps set the mass in motion where friction turns over at one speed alone",
          "[sim][smooth]") {
  // Under rate and state friction the force changes its sign within exp(-mu0/a) = 1e-47 of the reference velocity,
  // and at the reversal at 0.0288 s the pull exceeds it. A Newton iteration that stops on small corrections alone
  // finds the mass at rest for a microsecond.
  sim::Model model;
  model.oscillator = {.mass = 0.0015479497110449162,
                      .stiffness = 0.02717608397763958,
                      .damping = 6.247133037644546e-05,
                      .damper_to = sim::DamperTo::base};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 0.40966318236012367, .frequency = 65.03368582382979};
  model.friction = {law("rate_state", {{"normal_force", 0.00796703962137542},
                                       {"mu0", 0.5429974851068973},
                                       {"a", 0.005037328023914032},
                                       {"b", 0.009206654940370073},
                                       {"slip_distance", 0.3975453288041012},
                                       {"reference_velocity", 0.000266482794560415},
                                       {"evolution", std::string("aging")}})};
  const auto final_of = [&](SolverKind kind, double tolerance) {
    model.solver = {kind, tolerance};
    const sim::History history = sim::simulate(model, {.duration = 0.0345});
    REQUIRE(history.outcome.ok());
    return history.final;
  };
  const sim::Sample expected = final_of(SolverKind::explicit_steps, 1e-13);
  for (const double tolerance : {1e-11, 1e-12, 1e-13}) {
    const sim::Sample found = final_of(SolverKind::implicit_steps, tolerance);
    CAPTURE(tolerance);
    CHECK(std::abs(found.v - expected.v) < 1e-7 * 0.04);
    CHECK(std::abs(found.x - expected.x) < 1e-7 * 8e-4);
  }
}
