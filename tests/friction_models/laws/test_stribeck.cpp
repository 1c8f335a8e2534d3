#include "friction_models/laws/stribeck.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/motion/simulate.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Stribeck;
using friction::StribeckCurve;

namespace {

using Form = StribeckCurve::Form;

sim::LawCase stribeck(double static_level, const std::string& form, double exponent) {
  sim::LawCase c = sim::law_case("stribeck", {{"kinetic", 2.0},
                                              {"static", static_level},
                                              {"stribeck_velocity", 0.05},
                                              {"form", form},
                                              {"exponent", exponent}});
  c.scaled = [=](double factor) {
    return Law(Stribeck(StribeckCurve(factor * 2.0, factor * static_level, 0.05,
                                      form == "gaussian"      ? Form::gaussian
                                      : form == "exponential" ? Form::exponential
                                                              : Form::lorentz,
                                      exponent)));
  };
  return c;
}

}  // namespace

TEST_CASE("stribeck conforms to the law contract", "[friction][stribeck]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(stribeck(3.0, "gaussian", 2.0)) == none);
  CHECK(sim::nonconformities(stribeck(3.0, "gaussian", 3.0)) == none);
  CHECK(sim::nonconformities(stribeck(2.0, "gaussian", 2.0)) == none);
  CHECK(sim::nonconformities(stribeck(3.0, "exponential", 2.0)) == none);
  CHECK(sim::nonconformities(stribeck(3.0, "lorentz", 2.0)) == none);
}

TEST_CASE("stribeck: levels of the three forms", "[friction][stribeck]") {
  const auto level = [](Form form, double exponent, double v) {
    return Law(Stribeck(StribeckCurve(2.0, 3.0, 0.05, form, exponent))).force({}, {.v = v}, Direction::forward);
  };
  // At the Stribeck velocity and at twice that: 1/e, e^-4; e^-2; 1/2, 1/5.
  CHECK(level(Form::gaussian, 2.0, 0.05) == Approx(2.367879441171442).epsilon(1e-15));
  CHECK(level(Form::gaussian, 2.0, 0.1) == Approx(2.018315638888734).epsilon(1e-15));
  CHECK(level(Form::gaussian, 0.5, 0.2) == Approx(2.135335283236613).epsilon(1e-15));
  CHECK(level(Form::exponential, 2.0, 0.1) == Approx(2.135335283236613).epsilon(1e-15));
  CHECK(level(Form::lorentz, 2.0, 0.05) == Approx(2.5).epsilon(1e-15));
  CHECK(level(Form::lorentz, 2.0, 0.1) == Approx(2.2).epsilon(1e-15));
  for (const Form form : {Form::gaussian, Form::exponential, Form::lorentz}) CHECK(level(form, 2.0, 0.0) == 3.0);
}

TEST_CASE("stribeck: the steepest fall of exp(-(v/vs)^2)", "[friction][stribeck]") {
  // (static - kinetic) sqrt(2/e)/vs, at v = vs/sqrt(2). The central difference errs by h^2 F'''/6, 1e-8 relative.
  const Law law(Stribeck(StribeckCurve(2.0, 3.0, 0.05)));
  const double v = 0.05 / std::sqrt(2.0);
  const double h = 0.05e-4;
  const auto force = [&](double speed) { return law.force({}, {.v = speed}, Direction::forward); };
  CHECK((force(v + h) - force(v - h)) / (2.0 * h) == Approx(-std::sqrt(2.0 / std::exp(1.0)) / 0.05).epsilon(1e-7));
}

TEST_CASE("stribeck: a vanishing Stribeck velocity leaves coulomb with static above kinetic",
          "[friction][stribeck]") {
  const Law law(Stribeck(StribeckCurve(2.0, 3.0, 1e-9)));
  for (const double v : {1e-7, 1e-3, 1.0}) {
    CHECK(law.force({}, {.v = v}, Direction::forward) == 2.0);
    CHECK(law.force({}, {.v = -v}, Direction::backward) == -2.0);
  }
  CHECK(law.static_limit({}, {}) == 3.0);
}

TEST_CASE("stribeck: a level that falls with an infinite slope at v = 0 lets the mass go at once",
          "[friction][stribeck]") {
  // Just after the release m dv/dt = (static - kinetic) (v/vs)^n, so v = vs ((1 - n) t (static - kinetic)/(m
  // vs))^p, p = 1/(1 - n): from there Runge and Kutta's method with steps that grow in proportion to the time.
  const double kinetic = 0.3, level = 1.0, vs = 0.02, mass = 0.5, stiffness = 100.0, slope = 1e-3;
  const double release = 0.1, slip = 0.05;
  const double from = slope * release - level / stiffness;
  for (const double n : {0.11, 0.2, 0.35, 0.6}) {
    const auto rate = [&](double t, double x, double v) {
      const double friction = kinetic + (level - kinetic) * std::exp(-std::pow(v / vs, n));
      return (stiffness * (slope * (release + t) - x) - friction) / mass;
    };
    double t = 1e-11;
    double v = vs * std::pow((1.0 - n) * t * (level - kinetic) / (mass * vs), 1.0 / (1.0 - n));
    double x = from;
    constexpr int steps = 20'000;
    const double growth = std::pow(slip / t, 1.0 / steps);
    for (int i = 0; i < steps; ++i) {
      const double h = (growth - 1.0) * t;
      const double a1 = rate(t, x, v);
      const double v2 = v + 0.5 * h * a1;
      const double a2 = rate(t + 0.5 * h, x + 0.5 * h * v, v2);
      const double v3 = v + 0.5 * h * a2;
      const double a3 = rate(t + 0.5 * h, x + 0.5 * h * v2, v3);
      const double v4 = v + h * a3;
      const double a4 = rate(t + h, x + h * v3, v4);
      x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      t += h;
    }
    for (const sim::SolverKind kind : {sim::SolverKind::explicit_steps, sim::SolverKind::implicit_steps}) {
      CAPTURE(n, static_cast<int>(kind));
      sim::Model model;
      model.oscillator = {.mass = mass, .stiffness = stiffness};
      model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = slope};
      model.initial.position = from;
      model.friction = {Law(Stribeck(StribeckCurve(kinetic, level, vs, StribeckCurve::Form::gaussian, n)))};
      model.solver = {kind, 1e-12};
      const sim::History history = sim::simulate(model, {.duration = release + slip});
      REQUIRE(history.outcome.ok());
      REQUIRE(history.events.size() == 1);
      CHECK(history.events.front().t == Approx(release).epsilon(1e-9));
      // A velocity within the tolerance of zero is a time lost: here the motion forgets nothing.
      CHECK(history.final.v == Approx(v).epsilon(1e-4));
      CHECK(history.final.x == Approx(x).epsilon(1e-4));
    }
  }
}

TEST_CASE("stribeck: an exponent belongs to the form gaussian", "[friction][stribeck]") {
  const friction::LawEntry& entry = *friction::find_law("stribeck");
  const auto faults = [&](const std::string& form, double exponent) {
    friction::ParameterValues values = {
        {"kinetic", 2.0}, {"stribeck_velocity", 0.05}, {"form", form}, {"exponent", exponent}};
    return friction::complete(entry, values);
  };
  CHECK(faults("gaussian", 1.5).empty());
  CHECK(faults("lorentz", 2.0).empty());
  const auto found = faults("lorentz", 1.5);
  REQUIRE(found.size() == 1);
  CHECK(found[0].name == "exponent");
  CHECK(found[0].found == "1.5");
}
