#include "friction_models/laws/friction_lag.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "sim/motion/simulate.hpp"

using namespace dualdamp;
using friction::DelayedFriction;
using friction::Direction;
using friction::FrictionLag;
using friction::Instant;
using friction::Law;
using friction::StribeckCurve;

namespace {

constexpr double lag = 0.02;

StribeckCurve curve(double factor = 1.0) { return {factor * 2.0, factor * 3.0, 0.05}; }

double level(double speed) { return 2.0 + std::exp(-speed * speed / 0.0025); }

sim::LawCase lagging(bool delayed) {
  sim::LawCase c = sim::law_case(
      "friction_lag",
      {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}, {"lag", lag}, {"delay", delayed}});
  c.scaled = [=](double factor) {
    return delayed ? Law(DelayedFriction(curve(factor), lag)) : Law(FrictionLag(curve(factor), lag));
  };
  return c;
}

/// From rest at the time 0 with this acceleration, its past included.
sim::Path accelerating(double a) {
  return [=](double t) {
    return Instant{.t = t, .x = a * t * t / 2.0, .v = a * t, .past_velocity = a * std::max(0.0, t - lag)};
  };
}

}  // namespace

TEST_CASE("friction_lag conforms to the law contract", "[friction][friction_lag]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(lagging(false)) == none);
  CHECK(sim::nonconformities(lagging(true)) == none);
}

TEST_CASE("friction_lag: the parameter delay chooses the kind of lag", "[friction][friction_lag]") {
  CHECK(lagging(false).law.delay() == 0.0);
  CHECK(lagging(true).law.delay() == lag);
  CHECK(lagging(false).law.start({.v = 0.3}).state == std::vector<double>{0.3});
  CHECK(lagging(true).law.start({.v = 0.3}).state.empty());
}

TEST_CASE("friction_lag: the level in a steady acceleration from rest", "[friction][friction_lag]") {
  // First order: w = a (t - lag (1 - exp(-t/lag))); delay: v(t - lag). The states are kept to 1e-11.
  const double a = 2.0;
  for (const double side : {-1.0, 1.0}) {
    const Direction direction = side > 0.0 ? Direction::forward : Direction::backward;
    sim::LawHost first(Law(FrictionLag(curve(), lag)), {});
    sim::LawHost delayed(Law(DelayedFriction(curve(), lag)), {});
    first.change_direction(direction);
    delayed.change_direction(direction);
    for (const double t : {0.01, 0.03, 0.06}) {
      first.move_along(t, accelerating(side * a));
      delayed.move_along(t, accelerating(side * a));
      const double w = a * (t + lag * std::expm1(-t / lag));
      CHECK(first.force() == Approx(side * level(w)).epsilon(1e-9));
      CHECK(delayed.force() == Approx(side * level(a * std::max(0.0, t - lag))).epsilon(1e-15));
    }
  }
}

TEST_CASE("friction_lag: higher while the mass accelerates than while it decelerates", "[friction][friction_lag]") {
  // Half a period of v = 0.2 sin(20 t), from rest, and the same speeds on the way up and down.
  const auto path = [](double t) {
    return Instant{.t = t, .x = 0.01 * (1.0 - std::cos(20.0 * t)), .v = 0.2 * std::sin(20.0 * t)};
  };
  const double half = std::numbers::pi / 20.0;
  for (const double part : {0.05, 0.15, 0.3}) {
    sim::LawHost host(Law(FrictionLag(curve(), lag)), {});
    host.change_direction(Direction::forward);
    host.move_along(part * half, path);
    const double up = host.force();
    host.move_along((1.0 - part) * half, path);
    INFO(part);
    CHECK(up > host.force() + 1e-3);
  }
  // It stops at less than the static level, which is regained as w = w0 exp(-t/lag) fades.
  sim::LawHost host(Law(FrictionLag(curve(), lag)), {});
  host.change_direction(Direction::forward);
  host.move_along(half, path);
  CHECK(host.force() < 2.5);
  const double w = host.memory().state[0];
  const Instant stop = host.now();
  host.change_direction(Direction::none);
  host.move_along(half + lag, [&](double t) { return Instant{.t = t, .x = stop.x}; });
  CHECK(host.law().static_limit(host.memory(), host.now()) == Approx(level(w / std::numbers::e)).epsilon(1e-9));
}

TEST_CASE("friction_lag: the level peaks where w changes its sign", "[friction][friction_lag]") {
  // At 1 m/s for ever, then at -1 m/s: w = 2 exp(-t/lag) - 1 is 0 at lag ln 2, where the level is the static one.
  sim::LawHost host(Law(FrictionLag(curve(), lag)), {.v = 1.0});
  host.change_direction(Direction::backward);
  host.move_along(lag, [](double t) { return Instant{.t = t, .x = -t, .v = -1.0}; });
  CHECK(host.events() == 1);
  CHECK(host.last_event().t == Approx(lag * std::numbers::ln2).epsilon(1e-9));
  CHECK(host.memory().mode == -1);
  CHECK(host.force() == Approx(-level(1.0 - 2.0 / std::numbers::e)).epsilon(1e-9));
}

TEST_CASE("friction_lag: the late velocity of a mass at rest makes no events", "[friction][friction_lag]") {
  // It dies out and keeps its sign; of its rounding, thousands of zeros were events.
  sim::Model model;
  model.oscillator = {.mass = 5.7, .stiffness = 15400.0, .damping = 229.0};
  model.friction = {Law(FrictionLag({20.0, 44.0, 0.0075}, 1e-3))};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 0.0045, .frequency = 12.0, .phase = 1.16};
  model.solver.kind = sim::SolverKind::explicit_steps;
  const std::vector<sim::Event> events = sim::simulate(model, {.duration = 5.0}).events;
  bool rests = false;
  int while_at_rest = 0;
  int stops = 0;
  for (const sim::Event& event : events) {
    while_at_rest += rests && event.kind == sim::EventKind::switching ? 1 : 0;
    stops += event.kind == sim::EventKind::stop ? 1 : 0;
    if (event.kind != sim::EventKind::switching) rests = event.kind == sim::EventKind::stop;
  }
  CHECK(stops > 10);
  CHECK(while_at_rest == 0);
}
