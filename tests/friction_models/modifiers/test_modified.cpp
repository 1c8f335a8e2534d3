#include "friction_models/modifiers/modified.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/free_play.hpp"
#include "friction_models/laws/reset_integrator.hpp"
#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/friction_models/modifiers/modified_laws.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::ContactCompliance;
using friction::Coulomb;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;
using friction::ParameterValues;
using test::coulomb_with;
using test::loop_work;
using test::plus;

namespace {

const std::vector<std::string> none;

ParameterValues fluctuation(double ratio, double correlation_time, double seed) {
  const ParameterValues record{{"ratio", ratio}, {"correlation_time", correlation_time}, {"seed", seed}};
  return {{"fluctuation", std::vector<ParameterValues>{record}}};
}

Law contact(double kinetic, double stiffness, const ParameterValues& modifiers) {
  return friction::modified(Law(ContactCompliance(kinetic, kinetic, stiffness, 0.0)), modifiers, {kinetic});
}

/// The factor of a law of 1 N in each of the first cells.
std::vector<double> factors(const Law& law, int count) {
  std::vector<double> list;
  Memory memory = law.start({});
  for (int i = 0; i < count; ++i) {
    list.push_back(law.force(memory, {}, Direction::forward));
    law.jump(memory, {friction::Trigger::scheduled}, {.t = law.next_change(memory)}, Direction::forward);
  }
  return list;
}

double bisect(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2.0;
    ((f(low) < 0.0) == (f(middle) < 0.0) ? low : high) = middle;
  }
  return high;
}

}  // namespace

TEST_CASE("laws under modifiers conform to the law contract", "[friction][modified]") {
  const ParameterValues noise = fluctuation(0.4, 4.0, 3.0);
  const ParameterValues rigid{{"kinetic", 2.0}, {"static", 3.0}};
  const ParameterValues soft = plus(rigid, {{"contact_stiffness", 1e3}});
  const ParameterValues damped = plus(soft, {{"contact_damping", 20.0}});
  const ParameterValues bond{{"kinetic", 2.0}, {"stiffness", 1e3}, {"static_gain", 0.5}};
  struct {
    std::string name;
    ParameterValues values;
  } const laws[] = {
      {"coulomb", rigid}, {"contact_compliance", soft}, {"contact_compliance", damped}, {"reset_integrator", bond}};
  for (const auto& [name, values] : laws) {
    std::vector<ParameterValues> cases = {noise, {{"drift", -0.5}}};
    if (!values.has("contact_damping")) {
      cases.push_back({{"drift", 0.02}, {"position_slope", 50.0}});
      cases.push_back(plus(noise, {{"drift", -0.02}, {"position_slope", -200.0}}));
      // Steeper than the spring: the slider then stands still on the way out.
      cases.push_back({{"position_slope", 1.5e3}});
    }
    for (const ParameterValues& modified : cases) {
      sim::LawCase c = sim::law_case(name, plus(values, modified));
      c.stroke = 0.05;
      CAPTURE(name, modified.has("drift"), modified.has("position_slope"), modified.has("fluctuation"));
      CHECK(sim::nonconformities(c) == none);
    }
  }
}

TEST_CASE("bristle under a fluctuation conforms to the law contract", "[friction][modified]") {
  const ParameterValues values{{"stiffness", 500.0}, {"snap_distance", 2e-3}, {"count", 6.0}, {"seed", 42.0}};
  sim::LawCase c = sim::law_case("bristle", plus(values, fluctuation(0.5, 4.0, 3.0)));
  c.stroke = 0.02;
  c.odd = false;
  c.passive = false;
  c.random = true;
  CHECK(sim::nonconformities(c) == none);
}

TEST_CASE("modifiers that do nothing leave the law as it is", "[friction][modified]") {
  ParameterValues zero = fluctuation(0.0, 1.0, 1.0);
  zero.set("drift", 0.0);
  zero.set("position_slope", 0.0);
  const Law law = coulomb_with(2.0, 3.0, zero);
  CHECK_FALSE(law.has_memory());
  CHECK(law.aperiodic().empty());
  CHECK(coulomb_with(2.0, 3.0, {{"position_slope", 1.0}}).aperiodic().empty());
  CHECK(coulomb_with(2.0, 3.0, {{"drift", 1.0}}).aperiodic() == "its force limits drift");
  CHECK(coulomb_with(2.0, 3.0, fluctuation(0.1, 1.0, 1.0)).aperiodic() == "its force limits fluctuate at random");
}

TEST_CASE("fluctuation: mean, variance and correlation of a stationary process", "[friction][modified]") {
  // Correlation 0.905 a cell: n cells hold n/20 independent ones, so 4 standard errors of the mean of 200,000 are
  // 0.04 standard deviations, and of the variance 0.04 sqrt(2) with half the correlation time, 0.04.
  const double ratio = 0.1;
  const int count = 200'000;
  const std::vector<double> list = factors(coulomb_with(1.0, 1.0, fluctuation(ratio, 2.0, 5.0)), count);
  double mean = 0.0;
  for (const double factor : list) mean += (factor - 1.0) / ratio / count;
  CHECK(std::abs(mean) < 0.04);
  for (const int lag : {0, 1, 10, 20}) {
    double sum = 0.0;
    for (int i = 0; i + lag < count; ++i)
      sum += (list[static_cast<std::size_t>(i)] - 1.0) * (list[static_cast<std::size_t>(i + lag)] - 1.0);
    CHECK(std::abs(sum / (count - lag) / (ratio * ratio) - std::exp(-lag / 10.0)) < 0.05);
  }
  CHECK(list == factors(coulomb_with(1.0, 1.0, fluctuation(ratio, 2.0, 5.0)), count));
  CHECK(list[7] != factors(coulomb_with(1.0, 1.0, fluctuation(ratio, 2.0, 6.0)), 8)[7]);
}

TEST_CASE("fluctuation: levels below zero are zero", "[friction][modified]") {
  const std::vector<double> list = factors(coulomb_with(1.0, 1.0, fluctuation(1.0, 2.0, 5.0)), 5000);
  CHECK(*std::ranges::min_element(list) == 0.0);
  // A normal variable is below -1 in 15.87 percent of the time; 250 independent cells.
  const auto zeros = static_cast<double>(std::ranges::count(list, 0.0));
  CHECK(std::abs(zeros / 5000.0 - 0.1587) < 4.0 * std::sqrt(0.1587 * 0.8413 / 250.0));
}

TEST_CASE("fluctuation: the exact engine takes each cell's level", "[friction][modified]") {
  // The first half swing from x0: in a cell of level F_i the motion turns about F_i/k by the angle w dt.
  const double w = 10.0;
  const double cell = 0.06;
  const ParameterValues noise = fluctuation(0.5, 10.0 * cell, 8.0);
  const std::vector<double> levels = factors(coulomb_with(2.0, 2.0, noise), 8);
  double x = 1.0;
  double v = 0.0;
  double turn = 0.0;
  for (int i = 0; turn == 0.0; ++i) {
    REQUIRE(i < 8);
    const double centre = levels[static_cast<std::size_t>(i)] / (w * w);
    // x - centre + i v/w turns clockwise; v = 0 next where it reaches the negative axis.
    const double angle = std::atan2(v / w, x - centre);
    const double rest = (v == 0.0 ? 0.0 : angle) + std::numbers::pi;
    const double radius = std::hypot(x - centre, v / w);
    if (rest < w * cell) {
      turn = i * cell + rest / w;
      x = centre - radius;
    } else {
      x = centre + radius * std::cos(angle - w * cell);
      v = w * radius * std::sin(angle - w * cell);
    }
  }
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = w * w, .damping = 0.0};
  model.friction = {coulomb_with(2.0, 2.0, noise)};
  model.initial.position = 1.0;
  const sim::FreeDecay decay = sim::free_decay(model, 2);
  REQUIRE(decay.extremes.size() == 2);
  CHECK(decay.extremes[1].t == Approx(turn).epsilon(1e-13));
  CHECK(decay.extremes[1].x == Approx(x).epsilon(1e-13));
}

TEST_CASE("drift: the first half swing has a closed form, and friction ends", "[friction][modified]") {
  // x'' + w^2 x = w^2 f (1 + d t), f = F/k, from rest at x0:
  // x = f (1 + d t) + (x0 - f) cos wt - (f d/w) sin wt
  const double x0 = 1.0;
  const double w = 10.0;
  const double f = 0.02;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.0};
  model.initial.position = x0;
  for (const double d : {0.7, -0.9}) {
    const auto v = [&](double t) { return f * d - (x0 - f) * w * std::sin(w * t) - f * d * std::cos(w * t); };
    const double turn = bisect(0.3, 0.33, v);
    const double x = f * (1.0 + d * turn) + (x0 - f) * std::cos(w * turn) - f * d / w * std::sin(w * turn);
    model.friction = {coulomb_with(2.0, 2.0, {{"drift", d}})};
    const sim::FreeDecay decay = sim::free_decay(model, 2);
    REQUIRE(decay.extremes.size() == 2);
    CHECK(decay.extremes[1].t == Approx(turn).epsilon(1e-13));
    CHECK(decay.extremes[1].x == Approx(x).epsilon(1e-13));
  }
  model.friction = {coulomb_with(2.0, 2.0, {{"drift", -2.0}})};
  const sim::History free = sim::simulate(model, {.duration = 0.5});
  const sim::History later = sim::simulate(model, {.duration = 30.0});
  REQUIRE(later.outcome.ok());
  CHECK(free.energy.friction > 0.0);
  CHECK(later.energy.friction == Approx(free.energy.friction).epsilon(1e-12));
}

TEST_CASE("drift: a slider under a growing limit stops before the mass", "[friction][modified]") {
  // a' = v - F d/kt, along x = X cos wt, is zero at the speed F d/kt.
  const double w = 3.0;
  const double X = 0.02;
  const double d = 1.5;
  sim::LawHost host(contact(2.0, 1000.0, {{"drift", d}}), {.x = X});
  const sim::Path path = [&](double t) { return Instant{t, X * std::cos(w * t), -X * w * std::sin(w * t)}; };
  host.change_direction(Direction::backward);
  host.move_along(0.8, path);
  REQUIRE(host.events() == 1);
  host.move_along(3.14 / w, path);
  REQUIRE(host.events() == 2);
  // Guards may overrun by 1e-12 of the greatest, 4 N: here a speed.
  CHECK(std::abs(host.last_event().v + 2.0 * d / 1000.0) < 1e-11);
  // The force goes on without a step: at the stop it was the limit of that time.
  const double stop = host.last_event().t;
  const double force = -2.0 * (1.0 + d * stop) + 1000.0 * (host.now().x - host.last_event().x);
  CHECK(host.force() == Approx(force).epsilon(1e-12));
}

TEST_CASE("fluctuation: a step downward relaxes a spring that is being unloaded, and leaves it stuck",
          "[friction][modified]") {
  const double stiffness = 1000.0;
  for (const bool bond : {false, true}) {
    const Law law = bond ? Law(friction::ResetIntegrator(2.0, stiffness, 0.0, 0.0))
                         : Law(ContactCompliance(2.0, 2.0, stiffness, 0.0));
    sim::LawHost host(law, {});
    host.move_to(0.01);
    host.move_to(0.0095);
    REQUIRE(host.force() == Approx(1.5).epsilon(1e-12));
    // The limit steps to 1 N; the mass goes on backwards.
    const auto path = [from = host.now()](double t) {
      return Instant{t, from.x - (t - from.t), -1.0, {.factor = 0.5}};
    };
    host.move_along(host.now().t + 1e-9, path);
    CHECK(host.force() == Approx(1.0).epsilon(1e-5));
    host.move_along(host.now().t + 5e-4, path);
    CHECK(host.force() == Approx(0.5).epsilon(1e-5));
    REQUIRE_FALSE(host.broken());
  }
}

TEST_CASE("a contact whose limit vanishes begins anew, unstretched, where it returns", "[friction][modified]") {
  // 2 N - 200 N/m |x| is gone beyond 10 mm; the spring stands unstretched where the mass comes back.
  for (const bool bond : {false, true}) {
    const Law stiff =
        bond ? Law(friction::ResetIntegrator(2.0, 1e5, 0.5, 0.0)) : Law(ContactCompliance(2.0, 2.0, 1e5, 0.0));
    sim::LawHost host(friction::modified(stiff, {{"position_slope", -200.0}}, {2.0}), {});
    host.move_to(0.03);
    CHECK(host.force() == 0.0);
    CHECK(host.guards().size() == 2);
    host.move_to(0.0101);
    CHECK(host.force() == 0.0);
    host.move_to(0.005);
    CHECK(host.force() == Approx(-1.0).epsilon(1e-12));
    REQUIRE_FALSE(host.broken());
  }
}

TEST_CASE("a law sees the limit that falls to zero as zero, whatever rounding leaves of it",
          "[friction][modified]") {
  const Law play =
      friction::modified(Law(friction::FreePlay(2.0, 3.0, 0.1)), {{"position_slope", -200.0}}, {2.0, 3.0});
  for (const double x : {0.015, 0.015 * (1.0 - 1e-15), 0.015 * (1.0 + 1e-15)}) {
    CAPTURE(x);
    Instant now{.v = 1.0};
    Memory memory = play.start(now);
    play.jump(memory, {2}, now, Direction::forward);  // behind the guards of the limits: pushed forward
    REQUIRE(play.force(memory, now, Direction::forward) == 2.0);
    now.x = x;
    play.jump(memory, {1}, now, Direction::forward);  // 2 N less 200 N/m x
    play.jump(memory, {1}, now, Direction::forward);  // 3 N less 200 N/m x: none is left
    CHECK(memory.state == std::vector<double>{x});
    CHECK(play.force(memory, now, Direction::forward) == 0.0);
  }
}

TEST_CASE("fluctuation: a step that leaves a sloping limit below zero leaves none", "[friction][modified]") {
  // f 2 N - 200 N/m 5 mm and f 3 N - 1 N: by the factor f none, one or both of them are gone.
  const Law law = coulomb_with(2.0, 3.0, plus(fluctuation(0.8, 1.0, 3.0), {{"position_slope", -200.0}}));
  const std::vector<double> factor = factors(coulomb_with(1.0, 1.0, fluctuation(0.8, 1.0, 3.0)), 400);
  Instant now{.x = 0.005};
  Memory memory = law.start({});
  int steps[3] = {};
  for (std::size_t i = 1; i < factor.size(); ++i) {
    now.t = law.next_change(memory);
    law.jump(memory, {friction::Trigger::scheduled}, now, Direction::none);
    CAPTURE(i, factor[i]);
    CHECK(law.force(memory, now, Direction::forward) ==
          Approx(std::max(0.0, 2.0 * factor[i] - 1.0)).epsilon(1e-12));
    CHECK(law.static_limit(memory, now) == Approx(std::max(0.0, 3.0 * factor[i] - 1.0)).epsilon(1e-12));
    std::vector<double> guards;
    law.guards(memory, now, Direction::forward, guards);
    CHECK(*std::ranges::min_element(guards) >= 0.0);
    ++steps[(2.0 * factor[i] > 1.0 ? 1 : 0) + (3.0 * factor[i] > 1.0 ? 1 : 0)];
  }
  CHECK(*std::ranges::min_element(steps) > 10);
}

TEST_CASE("position_slope: loops of a rigid and of a compliant contact", "[friction][modified]") {
  const double F = 2.0;
  const double c = 30.0;
  const double A = 0.05;
  // Rigid: F + c |x| over 4 A.
  CHECK(loop_work(coulomb_with(F, F, {{"position_slope", c}}), -A, A) ==
        Approx(4.0 * F * A + 2.0 * c * A * A).epsilon(1e-12));
  // Limits that fall to zero at |x| = F/200 = 10 mm.
  CHECK(loop_work(coulomb_with(F, F, {{"position_slope", -200.0}}), -A, A) ==
        Approx(4.0 * F * 0.01 / 2.0).epsilon(1e-12));
  // Compliant: from the turn the force falls by k (A - x) until it is -(F + c x1), if that is before x = 0; then it
  // slides. The stuck part gives back c (A - x1)^2/2 a half loop.
  const double k = 1000.0;
  const double x1 = (k * A - 2.0 * F - c * A) / (k + c);
  REQUIRE(x1 > 0.0);
  const double slides = F * (x1 + A) + c * (x1 * x1 + A * A) / 2.0;
  const double stuck = -c * (A - x1) * (A - x1) / 2.0;
  CHECK(loop_work(contact(F, k, {{"position_slope", c}}), -A, A) == Approx(2.0 * (slides + stuck)).epsilon(1e-12));
}

TEST_CASE("position_slope: friction work of a steady motion", "[friction][modified]") {
  const test::SettledMotion motion = test::settled_motion(coulomb_with(2.0, 2.0, {{"position_slope", 5.0}}));
  const double A = motion.peak;
  CHECK(A == Approx(-motion.trough).epsilon(1e-13));
  CHECK(motion.friction_work == Approx(8.0 * A + 10.0 * A * A).epsilon(1e-11));
}

TEST_CASE("factor first, slope after", "[friction][modified]") {
  const Law law = coulomb_with(2.0, 3.0, {{"drift", 0.5}, {"position_slope", 10.0}});
  const Memory memory = law.start({});
  const Instant now{.t = 1.0, .x = 0.1};
  CHECK(law.force(memory, now, Direction::forward) == Approx(2.0 * 1.5 + 1.0).epsilon(1e-15));
  CHECK(law.static_limit(memory, now) == Approx(3.0 * 1.5 + 1.0).epsilon(1e-15));
}

TEST_CASE("iwan under modifiers is its elements with one common factor", "[friction][modified]") {
  ParameterValues values{
      {"stiffness", 1e4}, {"limit", 2.0}, {"count", 5.0}, {"distribution", "uniform"}, {"drift", 0.5}};
  const ParameterValues noise = fluctuation(0.2, 1.0, 4.0);
  values = plus(values, noise);
  const friction::LawEntry& entry = *friction::find_law("iwan");
  REQUIRE(friction::complete(entry.parameters, values).empty());
  const std::vector<Law> laws = entry.make(values);
  REQUIRE(laws.size() == 5);
  double sliding = 0.0;
  for (const Law& law : laws) {
    sim::LawHost host(law, {});
    host.change_direction(Direction::forward);
    host.move_along(0.09, [](double t) { return Instant{t, t, 1.0}; });
    sliding += host.force();
  }
  const double factor = factors(coulomb_with(1.0, 1.0, noise), 1)[0];
  CHECK(sliding == Approx(2.0 * (1.0 + 0.5 * 0.09) * factor).epsilon(1e-12));
}

TEST_CASE("position_slope is refused beside a damped contact", "[friction][modified]") {
  const friction::LawEntry& entry = *friction::find_law("contact_compliance");
  ParameterValues values{
      {"kinetic", 2.0}, {"contact_stiffness", 1e3}, {"contact_damping", 1.0}, {"position_slope", 1.0}};
  const auto faults = friction::complete(entry.parameters, values);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].message == "'position_slope' is not possible beside 'contact_damping'");
  values.set("contact_damping", 0.0);
  CHECK(friction::complete(entry.parameters, values).empty());
}
