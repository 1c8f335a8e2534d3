// Convergence of laws to simpler ones, with the order of the theory: the slope of the error of the steady amplitude
// of the standard system over a parameter, both logarithmic. docs/smooth-engine.md lists them.

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/law_host/law_host.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::Law;
using friction::ParameterValues;

namespace {

Law make(const std::string& name, ParameterValues values) {
  const friction::LawEntry& entry = *friction::find_law(name);
  REQUIRE(friction::complete(entry, values).empty());
  const std::vector<Law> laws = entry.make(values);
  REQUIRE(laws.size() == 1);
  return laws.front();
}

double amplitude(const sim::Model& model) {
  const sim::SteadyState orbit = sim::steady_state(model);
  REQUIRE(orbit.outcome.ok());
  return orbit.amplitude;
}

double amplitude(const Law& law) {
  sim::Model model = test::standard_system(law);
  model.solver.tolerance = 1e-13;
  return amplitude(model);
}

/// d ln(error)/d ln(parameter) between two values of the parameter.
double order(const std::function<double(double parameter)>& error, double first, double second) {
  return std::log(std::abs(error(second) / error(first))) / std::log(second / first);
}

/// The order of the error of the amplitude of a law that tends to one with the amplitude `limit`.
double order(const std::function<Law(double parameter)>& law, double limit, double first, double second) {
  return order([&](double parameter) { return amplitude(law(parameter)) - limit; }, first, second);
}

double coulomb_amplitude() { return amplitude(make("coulomb", {{"kinetic", 2.0}})); }

ParameterValues stribeck_curve(double velocity) {
  return {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", velocity}};
}

}  // namespace

TEST_CASE("limits: compliant laws tend to coulomb as stiffness^(-1/2)", "[limits]") {
  // The contact reverses its force within x = 2 F/k of a turning point, where x is parabolic: for a time of
  // k^(-1/2).
  const double rigid = coulomb_amplitude();
  const auto contact = [](double k) {
    return make("contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", k}});
  };
  CHECK(order(contact, rigid, 1e7, 1e9) == Approx(-0.5).margin(0.003));
  const auto dahl = [](double k) { return make("dahl", {{"kinetic", 2.0}, {"sigma0", k}}); };
  CHECK(order(dahl, rigid, 1e6, 1e7) == Approx(-0.5).margin(0.01));
  const auto bouc_wen = [](double k) {
    return make("bouc_wen", {{"limit", 2.0}, {"stiffness", k}, {"exponent", 2.0}});
  };
  CHECK(order(bouc_wen, rigid, 1e6, 1e7) == Approx(-0.5).margin(0.01));
  // Its damper is proportional to sqrt(sigma0), so that the bristles keep their damping ratio.
  const auto lugre = [](double k) {
    return make("lugre", {{"kinetic", 2.0}, {"stribeck_velocity", 0.05}, {"sigma0", k}, {"sigma1", std::sqrt(k)}});
  };
  CHECK(order(lugre, rigid, 1e7, 1e8) == Approx(-0.5).margin(0.01));
}

TEST_CASE("limits: lugre tends to stribeck as stiffness^(-1/2)", "[limits]") {
  const double limit = amplitude(make("stribeck", stribeck_curve(0.05)));
  const auto lugre = [](double k) {
    ParameterValues values = stribeck_curve(0.05);
    values.set("sigma0", k);
    values.set("sigma1", std::sqrt(k));
    return make("lugre", values);
  };
  CHECK(order(lugre, limit, 1e7, 1e8) == Approx(-0.5).margin(0.03));
}

TEST_CASE("limits: levels that depend on speed or its past tend to constant ones at first order", "[limits]") {
  const double rigid = coulomb_amplitude();
  // (Fs - Fc) acts for times of vs/a1 before and vs/a2 after a turning point, against each other.
  const auto stribeck = [](double vs) { return make("stribeck", stribeck_curve(vs)); };
  CHECK(order(stribeck, rigid, 1e-3, 5e-4) == Approx(1.0).margin(0.02));
  // N a ln(2 V/V0...) beside N mu0.
  const auto rate_state = [](double a) {
    return make("rate_state", {{"normal_force", 10.0},
                               {"mu0", 0.2},
                               {"a", a},
                               {"b", 0.0},
                               {"slip_distance", 0.01},
                               {"reference_velocity", 0.1}});
  };
  CHECK(order(rate_state, rigid, 0.01, 0.008) == Approx(1.0).margin(0.02));
  const auto lifted = [](double lift) {
    return make("normal_vibration", {{"mu", 0.2},
                                     {"mu_static", 0.2},
                                     {"weight", 10.0},
                                     {"normal_mass", 0.1},
                                     {"static_approach", 1e-4},
                                     {"normal_damping_ratio", 0.5},
                                     {"lift", lift},
                                     {"lift_velocity", 0.5}});
  };
  CHECK(order(lifted, rigid, 0.02, 0.01) == Approx(1.0).margin(0.02));
  const double at_once = amplitude(make("stribeck", stribeck_curve(0.3)));
  const auto lagging = [](double lag) {
    ParameterValues values = stribeck_curve(0.3);
    values.set("lag", lag);
    return make("friction_lag", values);
  };
  CHECK(order(lagging, at_once, 2e-4, 1e-4) == Approx(1.0).margin(0.02));
}

TEST_CASE("limits: viscous laws tend to a dashpot at first order", "[limits]") {
  // Closed form: |k/(k - m w^2 + i w (c + C))| Y at w = sqrt(k/m).
  const double C = 1.0;
  const double dashpot = 100.0 * 0.1 / (10.0 * (4.0 + C));
  const auto power = [&](double excess) {
    return make("viscous_power", {{"coefficient", C}, {"exponent", 1.0 + excess}});
  };
  CHECK(order(power, dashpot, 2e-3, 1e-3) == Approx(1.0).margin(0.01));
  const auto saturating = [&](double flatness) {
    return make("viscous_saturating", {{"coefficient", C}, {"saturation_velocity", 1.0 / flatness}});
  };
  CHECK(order(saturating, dashpot, 2e-3, 1e-3) == Approx(1.0).margin(0.01));
  // The power 0 is coulomb; small velocities contribute by their logarithm, which is integrable.
  const auto flat = [](double exponent) {
    return make("viscous_power", {{"coefficient", 2.0}, {"exponent", exponent}});
  };
  CHECK(order(flat, coulomb_amplitude(), 0.02, 0.01) == Approx(1.0).margin(0.02));
}

TEST_CASE("limits: uniform iwan tends to its continuum as count^(-2)", "[limits]") {
  // The sum over sliders is the midpoint rule for W = k^2 A^3/(3 F). The element that is about to slip at A lies at
  // the same part of its spacing for all counts: n k A/(2 F) = n/4.
  const double k = 1e4;
  const double F = 2.0;
  const double A = 0.5 * F / k;
  const auto error = [&](double count) {
    const Law law = make("iwan", {{"stiffness", k}, {"limit", F}, {"count", count}, {"distribution", "uniform"}});
    sim::LawHost host(law, {});
    host.move_to(A);
    host.move_to(-A);
    const double before = host.work();
    host.move_to(A);
    host.move_to(-A);
    REQUIRE_FALSE(host.broken());
    return host.work() - before - k * k * A * A * A / (3.0 * F);
  };
  CHECK(order(error, 40.0, 160.0) == Approx(-2.0).margin(0.05));
}

TEST_CASE("limits: a sharper bouc_wen tends to contact_compliance as exponent^(-2)", "[limits]") {
  // The force differs by F/n over a distance of z0/n, where the slider begins to slide.
  const double k = 1e3;
  const double sharp = amplitude(make("contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", k}}));
  const auto bouc_wen = [&](double exponent) {
    return make("bouc_wen", {{"limit", 2.0}, {"stiffness", k}, {"exponent", exponent}});
  };
  CHECK(order(bouc_wen, sharp, 40.0, 80.0) == Approx(-2.0).margin(0.1));
}

TEST_CASE("limits: a mass that a small power of speed nearly holds creeps, as its closed form says", "[limits]") {
  // The speed is (pull/1 N)^20 m/s: 5e-7 of the speed without friction, and far below rounding where the pull
  // changes its sign.
  sim::Model model = test::standard_system(make("viscous_power", {{"coefficient", 1.0}, {"exponent", 0.05}}));
  model.excitation.amplitude = 0.005;
  const sim::SteadyState creep = sim::steady_state(model);
  INFO(creep.outcome.reason);
  REQUIRE(creep.outcome.ok());
  const double stroke = std::pow(0.5, 20.0) * std::numbers::pi * 184756.0 / 1048576.0 / model.excitation.frequency;
  CHECK(creep.peak == Approx(0.5 * stroke).epsilon(2e-4));
  // Nearly Coulomb friction; the largest pull is 0.999 to 1.1 of it.
  for (const double amplitude : {0.00999, 0.011}) {
    for (const double exponent : {0.2, 0.1, 0.05, 0.02}) {
      INFO(amplitude << " m, exponent " << exponent);
      model.friction = {make("viscous_power", {{"coefficient", 1.0}, {"exponent", exponent}})};
      model.excitation.amplitude = amplitude;
      const sim::SteadyState state = sim::steady_state(model);
      INFO(state.outcome.reason);
      CHECK(state.outcome.ok());
      CHECK(state.energy.defect == Approx(0.0).margin(1e-8 * state.energy.input));
    }
  }
}

TEST_CASE("limits: random and varying laws agree in both engines", "[limits]") {
  // Other affine laws: tests/sim/engine/test_smooth_engine.cpp.
  const auto noise = [](const std::string& correlation, double value) {
    const ParameterValues record{{"ratio", 0.3}, {correlation, value}, {"seed", 5.0}};
    return ParameterValues{{"kinetic", 2.0}, {"fluctuation", std::vector<ParameterValues>{record}}};
  };
  const std::vector<Law> laws = {
      make("bristle", {{"stiffness", 80.0}, {"snap_distance", 5e-3}, {"count", 15.0}, {"seed", 1.0}}),
      make("coulomb", noise("correlation_time", 0.5)), make("coulomb", noise("correlation_length", 0.05))};
  for (const Law& law : laws) {
    sim::Model model = test::standard_system(law);
    const sim::History exact = sim::simulate(model, {.duration = 1.51});
    model.solver.kind = sim::SolverKind::explicit_steps;
    const sim::History smooth = sim::simulate(model, {.duration = 1.51});
    REQUIRE(smooth.outcome.ok());
    REQUIRE(smooth.events.size() == exact.events.size());
    for (std::size_t i = 0; i < exact.events.size(); ++i) {
      CHECK(smooth.events[i].kind == exact.events[i].kind);
      CHECK(std::abs(smooth.events[i].t - exact.events[i].t) < 1e-9);
    }
    CHECK(std::abs(smooth.final.x - exact.final.x) < 1e-9);
  }
}

TEST_CASE("limits: elements that are laws of their own under a vanishing drift move like one law", "[limits]") {
  // The limits change by a relative 1e-13 in 1.26 s. 60 elements: more than a file may have laws.
  ParameterValues values{{"stiffness", 1e3}, {"limit", 2.0}, {"count", 60.0}};
  sim::Model model = test::standard_system(make("iwan", values));
  const sim::History together = sim::simulate(model, {.duration = 1.26});
  values.set("drift", 1e-13);
  const friction::LawEntry& entry = *friction::find_law("iwan");
  REQUIRE(friction::complete(entry, values).empty());
  model.friction = entry.make(values);
  REQUIRE(model.friction.size() == 60);
  const sim::History apart = sim::simulate(model, {.duration = 1.26});
  REQUIRE(apart.outcome.ok());
  CHECK(std::abs(apart.final.x - together.final.x) < 1e-12);
  CHECK(std::abs(apart.final.v - together.final.v) < 1e-11);
}
