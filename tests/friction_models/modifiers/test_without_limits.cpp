// While all force limits of a law are zero it keeps the share of its force that no limit bounds, and a limit that
// comes back finds it unstretched.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "sim/motion/simulate.hpp"
#include "tests/friction_models/modifiers/modified_laws.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;
using friction::ParameterValues;
using test::plus;

namespace {

/// A fluctuation whose level is zero in a sixth of its cells of 0.1 s.
ParameterValues fluctuation() {
  const ParameterValues record{{"ratio", 1.0}, {"correlation_time", 1.0}, {"seed", 3.0}};
  return {{"fluctuation", std::vector{record}}};
}

ParameterValues warming() {
  return {{"warming", std::vector{ParameterValues{{"power", 3.0}, {"time_constant", 1.0}}}}};
}

const ParameterValues hysteretic{
    {"limit", 2.0}, {"stiffness", 1e3}, {"exponent", 2.0}, {"ratio", 0.25}, {"beta_share", 0.6}};
const ParameterValues bristles{{"kinetic", 2.0}, {"static", 3.0},  {"stribeck_velocity", 0.1},
                               {"sigma0", 1e3},  {"sigma1", 10.0}, {"sigma2", 4.0}};

/// A law, and the share of its force that no limit bounds: stiffness x + damping v.
struct Case {
  std::string name;
  ParameterValues values;
  double stiffness = 0.0;
  double damping = 0.0;
};

const std::vector<Case> laws_with_a_share = {
    {"bouc_wen", hysteretic, 250.0, 0.0},
    {"lugre", bristles, 0.0, 4.0},
    {"elasto_plastic", plus(bristles, {{"elastic_limit", 1e-3}}), 0.0, 4.0},
};

/// In place of limits that end at 0.5 s.
constexpr double end = 0.5;
const ParameterValues falling_drift{{"drift", -1.0 / end}};

}  // namespace

TEST_CASE("without force limits a law keeps the share of its force that no limit bounds", "[friction][modified]") {
  for (const auto& [name, values, stiffness, damping] : laws_with_a_share) {
    for (const ParameterValues& modifiers : {falling_drift, plus(falling_drift, warming())}) {
      CAPTURE(name, modifiers.has("warming"));
      const Law law = test::law(name, plus(values, modifiers));
      const Instant now{.t = end, .x = 0.02, .v = -0.3};
      Memory memory = law.start(now);
      memory.state[0] = 5e-4;
      law.jump(memory, {friction::Trigger::scheduled}, now, Direction::backward);
      const double share = stiffness * now.x + damping * now.v;
      const double heat = damping * now.v * now.v;  // the elastic share stores its work
      CHECK(law.force(memory, now, Direction::backward) == Approx(share).epsilon(1e-14));
      std::vector<double> rates(memory.state.size(), 1.0);
      CHECK(law.respond(memory, now, Direction::backward, rates) == Approx(share).epsilon(1e-14));
      CHECK(rates[0] == 0.0);
      // The energy of the spring has become heat, and the contact cools from there.
      if (modifiers.has("warming")) {
        const double spring = 0.5 * (1e3 - stiffness) * 5e-4 * 5e-4;  // J
        CHECK(memory.state[1] == Approx(spring).epsilon(1e-14));
        CHECK(rates[1] == Approx(heat - spring).epsilon(1e-14));
      }
      CHECK(law.dissipation(memory, now, Direction::backward) == Approx(heat).epsilon(1e-14));
    }
  }
}

TEST_CASE("a viscous share stays where a slope has taken the limits away", "[friction][modified]") {
  for (const auto& [name, values, stiffness, damping] : laws_with_a_share) {
    if (damping == 0.0) continue;
    CAPTURE(name);
    const Law law = test::law(name, plus(values, {{"position_slope", -200.0}}));
    // 3 N - 200 N/m |x| is gone beyond 15 mm.
    Instant now{.x = 0.0149, .v = 0.3};
    Memory memory = law.start(now);
    std::vector<double> guards;
    while (true) {
      guards.clear();
      law.guards(memory, now, Direction::forward, guards);
      const auto least = std::ranges::min_element(guards);
      if (*least >= 0.0 && now.x == 0.02) break;
      if (*least < 0.0)
        law.jump(memory, {static_cast<int>(least - guards.begin())}, now, Direction::forward);
      else
        now.x = 0.02;
    }
    CHECK(law.force(memory, now, Direction::forward) == Approx(damping * now.v).epsilon(1e-14));
  }
}

TEST_CASE("a limit that comes back finds the law unstretched", "[friction][modified]") {
  const std::vector<Case> laws = {
      {"bouc_wen", plus(hysteretic, {{"ratio", 0.0}})},
      {"dahl", {{"kinetic", 2.0}, {"sigma0", 1e3}}},
      {"lugre", plus(bristles, {{"sigma2", 0.0}})},
      {"elasto_plastic", plus(bristles, {{"sigma2", 0.0}, {"elastic_limit", 1e-3}})},
      {"contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e3}}},
  };
  for (const auto& [name, values, stiffness, damping] : laws) {
    const Law law = test::law(name, plus(values, fluctuation()));
    Memory memory = law.start({});
    const auto is_gone = [&] { return memory.course.level <= -1.0; };
    Instant now;
    int returns = 0;
    for (int cell = 0; cell < 100; ++cell) {
      // Stretched while there is a limit; it stands still while there is none.
      if (!is_gone() && memory.mode == 0 && !memory.state.empty() && name != "contact_compliance")
        memory.state[0] = 5e-4;
      const bool was_gone = is_gone();
      now.t = law.next_change(memory);
      now.x += 0.01;
      law.jump(memory, {friction::Trigger::scheduled}, now, Direction::none);
      if (!was_gone || is_gone()) continue;
      ++returns;
      CAPTURE(name, cell);
      CHECK(law.force(memory, now, Direction::none) == 0.0);
    }
    REQUIRE(returns >= 3);
  }
}

TEST_CASE("a free swing on a spring that yields gains no energy where the limit is gone", "[friction][modified]") {
  // m = 1 kg, k = 100 N/m. The energy of mass, spring and elastic share never grows, whatever the limit does. The
  // elastic share gives out what it stored at the start, 250 N/m x^2/2, and no more.
  sim::Model model{.oscillator = {.mass = 1.0, .stiffness = 100.0}};
  model.initial = {.position = 0.1};
  model.friction = test::laws_of("bouc_wen", plus(plus(hysteretic, {{"limit", 0.1}}), fluctuation()));
  const sim::History history = sim::simulate(model, {.duration = 6.0, .sample_rate = 200.0});
  REQUIRE(history.outcome.ok());
  CHECK(std::abs(history.energy.defect) < 1e-8);
  const auto energy = [](const sim::Sample& s) { return 0.5 * s.v * s.v + 0.5 * 350.0 * s.x * s.x; };
  // The yielding share, 750 N/m with |z| below 4 times 0.1 mm, gives back less than this.
  const double given_back = 0.5 * 750.0 * 4e-4 * 4e-4;
  double least = energy(history.samples.front());
  for (const sim::Sample& sample : history.samples) {
    least = std::min(least, energy(sample));
    CHECK(energy(sample) <= least + given_back);
  }
}
