#include "sim/engine/exact_engine.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/motion/simulate.hpp"
#include "tests/sim/engine/exact_motions.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using namespace dualdamp::sim;
using namespace dualdamp::test;
using friction::Direction;

TEST_CASE(
    "Free Coulomb decay loses 4F/k a period, to the last bit, and stops inside the set of positions that friction "
    "holds",
    "[exact]") {
  // k = 64, F = 1, so F/k = 2^-6 and all turning points are exact numbers.
  for (const double static_level : {1.0, 1.75}) {
    for (const double start : {5.0, -5.0, 12.25, 40.0, -3.5, 1.0, 0.75, -1.0, 1.5, 2.0}) {
      Model model = ramped(1.0, 64.0, 0.0, ExcitationType::none, 0.0);
      model.friction.push_back(coulomb(1.0, static_level));
      model.initial.position = start / 64.0;
      CAPTURE(static_level, start);
      ExactEngine engine(model);
      const auto events = events_of(engine, 1e3);
      // x_(n+1) = -(x_n - 2 sgn x_n) in units of F/k, until |x| <= static.
      double x = start;
      std::size_t n = 0;
      while (std::abs(x) > static_level) {
        x = -(x - std::copysign(2.0, x));
        REQUIRE(n < events.size());
        CHECK(std::abs(events[n].x * 64.0 - x) <= 8 * epsilon * std::abs(start));
        CHECK(std::abs(events[n].t - static_cast<double>(n + 1) * pi / 8.0) <= 16 * epsilon * events[n].t);
        CHECK(events[n].kind == (std::abs(x) > static_level ? EventKind::reversal : EventKind::stop));
        ++n;
      }
      CHECK(events.size() == n);
      CHECK(engine.direction() == Direction::none);
      CHECK(std::abs(engine.position()) * 64.0 <= static_level * (1.0 + 16 * epsilon));
      CHECK(engine.time() == 1e3);
    }
  }
}

TEST_CASE("Without friction the engine is the linear oscillator", "[exact]") {
  // Position against 50 digits at many times of 50 periods. Intervals end at turning points, each of which adds a
  // few eps.
  Random random(22);
  for (const double zeta : {0.0, 0.02, 0.7, 1.0, 3.0}) {
    for (const DamperTo damper : {DamperTo::ground, DamperTo::base}) {
      Model model = base_driven({.m = 2.0, .k = 50.0, .c = 2.0 * zeta * 10.0, .Y = 0.1, .w = 3.7, .phase = 0.4});
      model.oscillator.damper_to = damper;
      model.excitation.harmonics = {{.order = 2, .amplitude = 0.02, .phase = 1.0}};
      model.initial = {0.2, -0.3};
      ExactEngine engine(model);
      const double duration = 50.0 * 2.0 * pi / 3.7;
      double largest = 0.0;
      double worst = 0.0;
      while (const Interval* interval = engine.next(duration)) {
        const double t = interval->begin + random.uniform(0.0, 1.0) * interval->duration;
        const sim::Sample sample = interval->state_at(t);
        const oracle::State expected = linear(model, t);
        largest = std::max(largest, std::abs(expected.x));
        worst = std::max({worst, std::abs(sample.x - expected.x), std::abs(sample.v - expected.v) / 5.0});
        CHECK(sample.force == 0.0);
        if (interval->ending) CHECK(*interval->ending == EventKind::reversal);
      }
      CAPTURE(zeta);
      CHECK(worst <= 2e-13 * largest);
      CHECK(engine.time() == Approx(duration).epsilon(4 * epsilon));
    }
  }
}

TEST_CASE("A free undamped oscillator keeps time over a thousand periods", "[exact]") {
  Model model = ramped(1.0, 100.0, 0.0, ExcitationType::none, 0.0);
  model.initial.position = 1.0;
  const auto events = events_of(model, 1000.25 * 2.0 * pi / 10.0);
  REQUIRE(events.size() == 2000);
  for (std::size_t n = 0; n < events.size(); n += 111) {
    const double expected = static_cast<double>(n + 1) * pi / 10.0;
    // Every half period adds a few relative eps and the rounding of the sum of times.
    CHECK(std::abs(events[n].t - expected) <= 4 * epsilon * expected * std::sqrt(static_cast<double>(n + 1)));
    CHECK(std::abs(std::abs(events[n].x) - 1.0) <= 4 * epsilon * static_cast<double>(n + 1));
  }
}

TEST_CASE("An overdamped free oscillator creeps home without an event", "[exact]") {
  for (const double c : {20.0, 25.0, 200.0, 2e4}) {
    Model model = ramped(1.0, 100.0, c, ExcitationType::none, 0.0);
    model.initial.position = 1.0;
    CAPTURE(c);
    ExactEngine engine(model);
    const Interval* interval = engine.next(1e5);
    REQUIRE(interval != nullptr);
    CHECK_FALSE(interval->ending);
    CHECK(engine.grazings().empty());
    CHECK(interval->duration == 1e5);
    CHECK(engine.next(1e5) == nullptr);
    CHECK(engine.outcome().ok());
  }
}

TEST_CASE("A motion that grows without bound ends with an outcome", "[exact]") {
  for (const double c : {-0.5, -25.0}) {
    Model model = ramped(1.0, 100.0, c, ExcitationType::none, 0.0);
    model.initial.velocity = 10.0;  // enough to outgrow the friction
    model.friction.push_back(coulomb(0.5, 0.5));
    const sim::History history = sim::simulate(model, {.duration = 1e5});
    CHECK(history.outcome.kind == core::OutcomeKind::not_finite);
  }
}
