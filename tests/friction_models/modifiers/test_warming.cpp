// The modifier warming: p' = (P - p)/tau, limits multiplied by exp(-p/power).

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/sliding.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::ParameterValues;

namespace {

constexpr double cold_kinetic = 2.0;  // N

ParameterValues warming(double power, double time_constant) {
  const ParameterValues record{{"power", power}, {"time_constant", time_constant}};
  return {{"warming", std::vector<ParameterValues>{record}}};
}

Law warm_coulomb(double power, double time_constant) {
  return friction::modified(Law(friction::Coulomb(cold_kinetic, cold_kinetic)), warming(power, time_constant),
                            {cold_kinetic});
}

/// Slides forward at this speed for this time, without a stop.
void slide_forward(sim::LawHost& host, double speed, double duration) {
  if (host.direction() != Direction::forward) host.change_direction(Direction::forward);
  test::go_on(host, speed, duration);
}

}  // namespace

TEST_CASE("laws that warm conform to the law contract", "[friction][warming]") {
  const ParameterValues curve{{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}};
  const auto with = [](ParameterValues values, const ParameterValues& more) {
    for (const auto& [name, value] : more.values()) values.set(name, value);
    return values;
  };
  struct {
    std::string name;
    ParameterValues values;
  } const laws[] = {
      {"coulomb", {{"kinetic", 2.0}, {"static", 3.0}}},
      {"coulomb", {{"kinetic", 2.0}, {"position_slope", -30.0}}},
      {"contact_compliance", {{"kinetic", 2.0}, {"static", 3.0}, {"contact_stiffness", 1e3}}},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e3}, {"contact_damping", 20.0}}},
      {"stribeck", curve},
      {"friction_lag", with(curve, {{"lag", 0.05}})},
      {"dahl", {{"kinetic", 2.0}, {"sigma0", 1e3}}},
      {"lugre", with(curve, {{"sigma0", 1e3}, {"sigma1", 1.0}, {"sigma2", 1.0}})},
      {"bouc_wen", {{"limit", 2.0}, {"stiffness", 1e3}, {"exponent", 2.0}}},
      {"viscous_power", {{"coefficient", 2.0}, {"exponent", 2.0}}},
  };
  for (const auto& [name, values] : laws) {
    sim::LawCase c = sim::law_case(name, with(values, warming(0.5, 0.3)));
    c.stroke = 0.05;
    CAPTURE(name, values.has("contact_damping"), values.has("position_slope"));
    CHECK(sim::nonconformities(c) == std::vector<std::string>{});
  }
}

TEST_CASE("warming: a law of the smooth engine, whose motions may be periodic", "[friction][warming]") {
  const Law law = warm_coulomb(1.0, 1.0);
  CHECK_FALSE(law.is_affine());
  CHECK(law.aperiodic().empty());
}

TEST_CASE("warming: steady sliding", "[friction][warming]") {
  // F = cold_kinetic exp(-F v/power): F v/power = W(cold_kinetic v/power), here by bisection of an increasing
  // function.
  const double power = 0.7;
  for (const double v : {0.05, 0.5, 3.0}) {
    double low = 0.0;
    double high = cold_kinetic;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (middle * std::exp(middle * v / power) < cold_kinetic ? low : high) = middle;
    }
    sim::LawHost host(warm_coulomb(power, 0.1), {.v = v});
    // The slowest approach is exp(-t/0.1).
    slide_forward(host, v, 4.0);
    CHECK(host.force() == Approx(low).epsilon(1e-9));
  }
}

TEST_CASE("warming: no heat is lost in a time short against the time constant", "[friction][warming]") {
  // p' = cold_kinetic v exp(-p/power)/tau: F = cold_kinetic/(1 + cold_kinetic v t/(tau power)). What cools away is
  // t/tau of it.
  const double tau = 1e8;
  const double capacity = 3.0;  // J: tau power
  const double v = 0.5;
  sim::LawHost host(warm_coulomb(capacity / tau, tau), {.v = v});
  for (const double t : {1.0, 4.0, 9.0}) {
    slide_forward(host, v, t - host.now().t);
    CHECK(host.force() == Approx(cold_kinetic / (1.0 + cold_kinetic * v * t / capacity)).epsilon(1e-7));
  }
}

TEST_CASE("warming: at rest the contact cools", "[friction][warming]") {
  const double power = 0.7;
  const double tau = 0.4;
  sim::LawHost host(warm_coulomb(power, tau), {.v = 0.5});
  slide_forward(host, 0.5, 1.0);
  const double warm = power * std::log(cold_kinetic / host.force());
  REQUIRE(warm > 0.1);
  host.change_direction(Direction::none);
  const Instant from = host.now();
  const double wait = 0.9;
  host.move_along(from.t + wait, [=](double t) { return Instant{.t = t, .x = from.x}; });
  const double limit = cold_kinetic * std::exp(-warm * std::exp(-wait / tau) / power);
  CHECK(host.law().static_limit(host.memory(), host.now()) == Approx(limit).epsilon(1e-9));
}

TEST_CASE("warming: a compliant contact is heated by its slider only", "[friction][warming]") {
  // The loop 4 cold_kinetic (A - cold_kinetic/kt), whatever the spring holds; a power so large does not change the
  // limit.
  const double tau = 1e8;
  const double power = 1e9;
  const double A = 0.05;
  const Law contact(friction::ContactCompliance(cold_kinetic, cold_kinetic, 1e3, 0.0));
  sim::LawHost host(friction::modified(contact, warming(power, tau), {cold_kinetic}), {});
  host.move_to(A);
  const double before = host.memory().state.back();
  host.move_to(-A);
  host.move_to(A);
  REQUIRE_FALSE(host.broken());
  const double heat = tau * (host.memory().state.back() - before);
  CHECK(heat == Approx(4.0 * cold_kinetic * (A - cold_kinetic / 1e3)).epsilon(1e-7));
}

TEST_CASE("warming: the heat is the work less the energy of the spring, also where a change is sudden",
          "[friction][warming]") {
  // No heat is lost in a time so short: tau p is all the heat. The springs hold force^2/(2 stiffness).
  const double tau = 1e8;
  const double capacity = 0.5;  // J: tau power
  const auto fluctuation = [](double ratio) {
    const ParameterValues record{{"ratio", ratio}, {"correlation_time", 0.5}, {"seed", 3.0}};
    return std::vector<ParameterValues>{record};
  };
  const auto contact = [](double static_level, double stiffness) {
    return ParameterValues{{"kinetic", 2.0}, {"static", static_level}, {"contact_stiffness", stiffness}};
  };
  const auto with = [](ParameterValues values, const std::string& name, const auto& value) {
    values.set(name, value);
    return values;
  };
  const std::vector<ParameterValues> one_element{{{"stiffness", 200.0}, {"share", 1.0}}};
  const ParameterValues curve{{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}};
  struct {
    std::string name;
    ParameterValues values;
    double stiffness;  // N/m
  } const cases[] = {
      {"contact_compliance", contact(2.0, 200.0), 200.0},
      {"contact_compliance", contact(3.0, 200.0), 200.0},
      // So soft that the heat of the slip that it causes makes it slip on: the slider falls below kinetic friction.
      {"contact_compliance", contact(2.0, 6.0), 6.0},
      {"contact_compliance", contact(3.0, 6.0), 6.0},
      {"contact_compliance", with(contact(3.0, 200.0), "position_slope", 10.0), 200.0},
      {"contact_compliance", with(contact(3.0, 200.0), "load_gradient", 4.0), 200.0},
      {"contact_compliance", with(contact(3.0, 200.0), "fluctuation", fluctuation(0.4)), 200.0},
      // The limits vanish for a while: what the springs hold then is heat.
      {"contact_compliance", with(contact(3.0, 200.0), "fluctuation", fluctuation(1.0)), 200.0},
      {"dahl", {{"kinetic", 2.0}, {"sigma0", 200.0}, {"fluctuation", fluctuation(1.0)}}, 200.0},
      {"generalized_maxwell_slip",
       with(with(with(curve, "elements", one_element), "attraction", 50.0), "fluctuation", fluctuation(1.0)),
       200.0},
  };
  for (const auto& [name, values, stiffness] : cases) {
    ParameterValues all = values;
    all.set("warming", *warming(capacity / tau, tau).find("warming"));
    CAPTURE(name, stiffness, values.has("fluctuation"));
    sim::LawHost host(test::law(name, all), {});
    for (const double x : {0.6, 0.3, 0.7, -0.2}) {
      host.move_to(x);
      REQUIRE_FALSE(host.broken());
      const double heat = tau * host.memory().state.back();
      const double stored = host.force() * host.force() / (2.0 * stiffness);
      CHECK(heat == Approx(host.work() - stored).epsilon(1e-6));
    }
  }
}

TEST_CASE("warming: without damper the motion is the limit of those with less and less", "[friction][warming]") {
  // The difference is a1 c + a2 c^2: extrapolated from three values of c to none.
  for (const double static_level : {5.0, 9.0}) {
    const auto end = [=](double damping) {
      sim::Model model;
      model.oscillator = {.mass = 1.0, .stiffness = 160.0, .damping = 0.3};
      model.initial.position = -0.2;
      ParameterValues values = warming(0.37, 1.1);
      for (const auto& [name, value] : {std::pair{"kinetic", 5.0},
                                        {"static", static_level},
                                        {"contact_stiffness", 1200.0},
                                        {"contact_damping", damping}})
        values.set(name, value);
      model.friction = {test::law("contact_compliance", values)};
      const sim::History history = sim::simulate(model, {.duration = 1.2});
      REQUIRE(history.outcome.ok());
      return history.final.x;
    };
    const double c = 0.05;
    const double limit = 3.0 * end(c) - 3.0 * end(2.0 * c) + end(3.0 * c);
    CAPTURE(static_level);
    CHECK(end(0.0) == Approx(limit).epsilon(3e-6));
  }
}

TEST_CASE("warming: in steady vibration a compliant contact is as warm as the work of a period makes it",
          "[friction][warming]") {
  // tau is a hundred periods, so p differs from its mean by the swing of a period at most.
  ParameterValues values = warming(1.0, 60.0);
  for (const auto& [name, value] :
       {std::pair{"kinetic", 1.0}, {"static", 3.0}, {"contact_stiffness", 200.0}, {"contact_damping", 0.0}})
    values.set(name, value);
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.03, .frequency = 9.0};
  model.friction = {test::law("contact_compliance", values)};
  const sim::SteadyState orbit = sim::steady_state(model);
  REQUIRE(orbit.outcome.ok());
  const double mean = orbit.energy.friction / orbit.period;
  CHECK(orbit.start.memories.front().state.back() == Approx(mean).epsilon(2e-3));
}

TEST_CASE("warming: a slow contact in steady vibration is coulomb at the mean power", "[friction][warming]") {
  // Over a period p' adds up to nothing, so the mean of p is the friction work over the period, W/T. With tau >> T
  // it hardly varies: the motion is that under F = cold_kinetic exp(-W/(T power)), W = 4 F x, up to T/tau.
  const double T = std::numbers::pi / 5.0;
  const double power = 3.0;
  double F = cold_kinetic;
  double x = 0.0;
  for (int i = 0; i < 60; ++i) {
    x = sim::steady_state(test::standard_system(Law(friction::Coulomb(F, F)))).amplitude;
    F = cold_kinetic * std::exp(-4.0 * F * x / (T * power));
  }
  REQUIRE(F < 0.6 * cold_kinetic);
  const auto error = [&](double tau) {
    const sim::SteadyState orbit = sim::steady_state(test::standard_system(warm_coulomb(power, tau)));
    REQUIRE(orbit.outcome.ok());
    CHECK(orbit.stable());
    return std::abs(orbit.amplitude - x);
  };
  const double coarse = error(20.0 * T);
  const double fine = error(80.0 * T);
  CHECK(coarse < 1e-3 * x);
  CHECK(std::log(coarse / fine) / std::log(4.0) == Approx(1.0).margin(0.15));
}
