#include "friction_models/laws/bristle.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"

using namespace dualdamp;
using friction::Bristle;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;

namespace {

double stored(const sim::LawHost& host, double stiffness) {
  double sum = 0.0;
  for (const double place : host.memory().state) sum += stiffness / 2.0 * std::pow(host.now().x - place, 2);
  return sum;
}

}  // namespace

TEST_CASE("bristle conforms to the law contract", "[friction][bristle]") {
  const std::vector<std::string> none;
  for (const double count : {1.0, 6.0}) {
    sim::LawCase c =
        sim::law_case("bristle", {{"stiffness", 500.0}, {"snap_distance", 2e-3}, {"count", count}, {"seed", 42.0}});
    c.stroke = 0.02;
    c.odd = false;
    c.passive = false;  // it starts stretched
    c.random = true;
    CHECK(sim::nonconformities(c) == none);
  }
}

TEST_CASE("bristle: the same seed gives the same places, another one others", "[friction][bristle]") {
  const Memory memory = Law(Bristle(500.0, 2e-3, 20, 42)).start({.x = 1.0});
  CHECK(memory == Law(Bristle(500.0, 2e-3, 20, 42)).start({.x = 1.0}));
  CHECK(memory.state != Law(Bristle(500.0, 2e-3, 20, 43)).start({.x = 1.0}).state);
  for (const double place : memory.state) CHECK(std::abs(place - 1.0) <= 2e-3);
}

TEST_CASE("bristle: nothing snaps on a way that stretches none to its length, and the force is elastic",
          "[friction][bristle]") {
  sim::LawHost host(Law(Bristle(500.0, 2e-3, 20, 1)), {});
  const double front = host.memory().state.front() + 2e-3;
  const double force = host.force();
  host.move_to(0.999 * front);
  CHECK(host.events() == 0);
  CHECK(host.force() == Approx(force + 20 * 500.0 * 0.999 * front).epsilon(1e-12));
  host.move_to(1.001 * front);
  CHECK(host.events() >= 1);
  CHECK(host.last_event().x == Approx(front).epsilon(1e-9));
}

TEST_CASE("bristle: mean force and snaps of a long way", "[friction][bristle]") {
  // A bristle travels d on average from snap to snap, var 1/3 d^2, and loses stiffness (d^2 - d^2/3)/2 at each.
  // Over 100 d, 40 bristles snap 4000 times: 4 standard errors of their number are 4 sqrt(4000/3) = 146.
  const double stiffness = 500.0;
  const double d = 2e-3;
  const int count = 40;
  sim::LawHost host(Law(Bristle(stiffness, d, count, 3)), {});
  host.move_to(10.0 * d);
  const int events = host.events();
  const double work = host.work();
  const double energy = stored(host, stiffness);
  for (int i = 2; i <= 11; ++i) host.move_to(10.0 * d * i);
  REQUIRE_FALSE(host.broken());
  CHECK(std::abs(host.events() - events - 4000) < 146);
  // Work = energy lost + energy stored: per snap the loss deviates by sqrt(4/45)/(2/3) = 45 percent.
  const double mean = (host.work() - work - (stored(host, stiffness) - energy)) / (100.0 * d);
  CHECK(mean == Approx(count * stiffness * d / 3.0).epsilon(0.036 + 4.0 * 0.45 / std::sqrt(4000.0)));
}

TEST_CASE("bristle: shorter bristles after a step of the limit, none while it is zero", "[friction][bristle]") {
  const Law law(Bristle(500.0, 2e-3, 30, 9));
  Memory memory = law.start({});
  Instant now{.modification = {.factor = 0.25}};
  std::vector<double> guards;
  law.guards(memory, now, Direction::forward, guards);
  REQUIRE(guards.size() == 2);
  CHECK(guards[0] < 0.0);
  law.jump(memory, {0}, now, Direction::forward);
  law.jump(memory, {1}, now, Direction::forward);
  for (const double place : memory.state) CHECK(std::abs(place) <= 5e-4);
  CHECK(std::ranges::is_sorted(memory.state));
  now.modification.factor = 0.0;
  CHECK(law.force(memory, now, Direction::forward) == 0.0);
  guards.clear();
  law.guards(memory, now, Direction::forward, guards);
  CHECK(guards.empty());
  now.x = 0.7;
  law.jump(memory, {friction::Trigger::limit_change}, now, Direction::forward);
  now.modification.factor = 1.0;
  // Rounding of 30 bristles' 500 N/m * 0.7 m.
  CHECK(std::abs(law.force(memory, now, Direction::forward)) < 1e-10);
}

TEST_CASE("bristle is random, so no motion under it is periodic", "[friction][bristle]") {
  CHECK(Law(Bristle(500.0, 2e-3, 1, 1)).aperiodic() == "its bristles snap at random");
}
