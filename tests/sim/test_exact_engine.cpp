#include "sim/exact_engine.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "friction_models/contact_compliance.hpp"
#include "friction_models/coulomb.hpp"
#include "sim/simulate.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/exponential_sum.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace dualdamp;
using friction::Direction;
using sim::DamperTo;
using sim::EventKind;
using sim::ExactEngine;
using sim::ExcitationType;
using sim::Interval;
using sim::Model;
using test::Random;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

friction::Law coulomb(double kinetic, double static_level) {
  return friction::Law(friction::Coulomb(kinetic, static_level));
}

struct Event {
  double t = 0.0;
  EventKind kind = EventKind::reversal;
  double x = 0.0;
};

/// Events until `duration`, at most `count` of them.
std::vector<Event> events_of(ExactEngine& engine, double duration, std::size_t count = 1'000'000) {
  std::vector<Event> events;
  while (events.size() < count) {
    const Interval* interval = engine.next(duration);
    if (interval == nullptr) break;
    if (interval->ending) events.push_back({interval->end(), *interval->ending, engine.position()});
  }
  return events;
}

std::vector<Event> events_of(const Model& model, double duration, std::size_t count = 1'000'000) {
  ExactEngine engine(model);
  return events_of(engine, duration, count);
}

Model base_driven(double m, double k, double c, double amplitude, double w, double phase = 0.0) {
  Model model;
  model.oscillator = {m, k, c, DamperTo::ground};
  model.excitation = {
      .type = ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = w, .phase = phase};
  return model;
}

Model ramped(double m, double k, double c, ExcitationType type, double slope) {
  Model model;
  model.oscillator = {m, k, c, DamperTo::ground};
  model.excitation = {.type = type, .slope = slope};
  return model;
}

/// The seed system of the paper: m = 1 kg, k = 100 N/m, c = 4 N.s/m, w = 10 rad/s, Y = 0.1 m, F = 2 N.
Model standard(double kinetic = 2.0, double static_level = 2.0) {
  Model model = base_driven(1.0, 100.0, 4.0, 0.1, 10.0);
  model.friction.push_back(coulomb(kinetic, static_level));
  return model;
}

/// x and v of the linear oscillator in 50 digits.
oracle::State linear(const Model& model, double t) {
  const sim::Oscillator& o = model.oscillator;
  oracle::LinearProblem problem{.mass = o.mass,
                                .damping = o.damping,
                                .stiffness = o.stiffness,
                                .x0 = model.initial.position,
                                .v0 = model.initial.velocity};
  const sim::Excitation& e = model.excitation;
  const double c = o.damper_to == DamperTo::base ? o.damping : 0.0;
  const bool base = e.type == ExcitationType::base_harmonic;
  const auto add = [&](int order, double amplitude, double phase) {
    const double w = order * e.frequency;
    const oracle::Complex gain = base ? oracle::Complex(o.stiffness, c * w) : oracle::Complex(1.0);
    problem.harmonics.push_back({w, gain * std::polar(amplitude, phase)});
  };
  if (e.is_harmonic()) {
    add(1, e.amplitude, e.phase);
    for (const sim::Harmonic& h : e.harmonics) add(h.order, h.amplitude, h.phase);
  }
  if (e.type == ExcitationType::force_harmonic) problem.constant = e.offset;
  return oracle::solve(problem, t);
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------------
// Rest and release

TEST_CASE("A start exactly at the limit stays while the pull falls and slips while it grows", "[exact]") {
  // k x0 = -5 N and static = 5 N, all exact in binary: |pull| = static to the last bit.
  for (const double side : {1.0, -1.0}) {
    for (const double static_level : {5.0, 5.5}) {
      Model model = ramped(1.0, 100.0, 0.5, ExcitationType::force_ramp, side * 2.0);
      model.friction.push_back(coulomb(5.0, static_level));
      model.initial.position = -side * static_level / 100.0;
      CAPTURE(side, static_level);
      const ExactEngine growing(model);
      CHECK(growing.direction() == (side > 0.0 ? Direction::forward : Direction::backward));

      model.excitation.slope = -side * 2.0;
      ExactEngine falling(model);
      CHECK(falling.direction() == Direction::rest);
      // Released on the other side, when the pull has come down by twice the limit.
      const auto events = events_of(falling, 10.0, 1);
      REQUIRE(events.size() == 1);
      CHECK(events[0].kind == EventKind::release);
      CHECK(events[0].t == Approx(static_level).epsilon(4 * epsilon));
      CHECK(falling.direction() == (side > 0.0 ? Direction::backward : Direction::forward));
    }
  }
  // A constant pull at the limit holds.
  Model still = ramped(1.0, 100.0, 0.5, ExcitationType::none, 0.0);
  still.friction.push_back(coulomb(5.0, 5.0));
  still.initial.position = 0.05;
  ExactEngine engine(still);
  CHECK(engine.direction() == Direction::rest);
  CHECK(events_of(engine, 1e6).empty());
}

TEST_CASE("Beside a mass at rest a contact at its limit neither breaks away nor holds on again", "[exact]") {
  // The contact was dragged along until the mass stopped: it stands stretched to its limit, within rounding.
  Random random(27);
  int stretched = 0;
  for (int i = 0; i < 200; ++i) {
    Model model = ramped(1.0, 100.0, 1.0, ExcitationType::none, 0.0);
    const double limit = random.uniform(0.1, 2.0);
    model.friction = {coulomb(4.0, 5.0),
                      friction::Law(friction::ContactCompliance(limit, limit, random.uniform(100.0, 1e4), 0.0))};
    model.initial = {random.uniform(-0.01, 0.01), random.sign() * random.uniform(0.5, 2.0)};
    const auto events = events_of(model, 1e3);
    const auto stop = std::find_if(events.begin(), events.end(),
                                   [](const Event& event) { return event.kind == EventKind::stop; });
    CAPTURE(i);
    REQUIRE(stop != events.end());
    CHECK(stop + 1 == events.end());
    stretched += stop != events.begin() && (stop - 1)->kind == EventKind::switching ? 1 : 0;
  }
  CHECK(stretched > 100);
}

TEST_CASE("A release is not taken back by the rounding of a contact that lets go with it", "[exact]") {
  // The contact still stands at its limit on the side to which the mass is released: it lets go at once, and with
  // it goes a force k x a thousand times those that decide between slip and rest. With static = kinetic the slip
  // then begins without acceleration.
  Random random(28);
  int together = 0;
  for (int i = 0; i < 300; ++i) {
    Model model = base_driven(1.0, 100.0, random.uniform(0.0, 5.0), 0.1, random.uniform(1.0, 8.0), random.angle());
    const double level = random.uniform(1.0, 5.0);
    const double limit = random.uniform(0.01, 2.0);
    model.friction = {coulomb(level, level),
                      friction::Law(friction::ContactCompliance(limit, limit, random.logarithmic(1e4, 1e7), 0.0))};
    model.initial.velocity = 0.3;
    const double period = 2.0 * pi / model.excitation.frequency;
    const auto events = events_of(model, 10.0 * period);
    CAPTURE(i);
    for (std::size_t j = 0; j + 2 < events.size(); ++j) {
      if (events[j].kind != EventKind::release || events[j + 1].t != events[j].t) continue;
      ++together;
      CHECK(events[j + 1].kind == EventKind::switching);
      CHECK(events[j + 2].t - events[j].t > 1e-6 * period);
    }
  }
  CHECK(together > 100);
}

TEST_CASE("A harmonic pull at the limit at the start: growing, falling and at its turning point", "[exact]") {
  // pull = 10 cos(w t + phi) + 5 N with phi = -+90 degrees: 5 N with the rate +-100 N/s; cos(pi/2) = 6e-17 in
  // double.
  for (const double rate : {1.0, -1.0}) {
    Model model = base_driven(1.0, 100.0, 4.0, 0.1, 10.0, -rate * pi / 2.0);
    model.friction.push_back(coulomb(5.0, 5.0));
    model.initial.position = -0.05;
    const ExactEngine engine(model);
    CHECK(engine.direction() == (rate > 0.0 ? Direction::forward : Direction::rest));
  }
  // At the crest, pull = static = 10 N: equality holds and the pull falls on both sides.
  Model crest = base_driven(1.0, 100.0, 4.0, 0.1, 10.0);
  crest.friction.push_back(coulomb(10.0, 10.0));
  ExactEngine engine(crest);
  CHECK(engine.direction() == Direction::rest);
  // And it comes back to the crest, once a period, without ever crossing.
  CHECK(events_of(engine, 10.0).empty());
}

TEST_CASE("Release is where the pull reaches the limit: one arc cosine", "[exact]") {
  Random random(21);
  for (int i = 0; i < 200; ++i) {
    const double static_level = random.uniform(0.5, 9.5);
    const double phase = random.angle();
    Model model = base_driven(random.logarithmic(0.1, 10.0), 100.0, random.uniform(0.0, 20.0), 0.1,
                              random.logarithmic(0.1, 100.0), phase);
    model.friction.push_back(coulomb(static_level * random.uniform(0.2, 1.0), static_level));
    model.initial.position = random.uniform(-1.0, 1.0) * static_level / 100.0 + 0.1 * std::cos(phase);
    // cos(w t + phi) = (x0 +- static/k)/Y: the earliest of up to four candidates.
    double expected = std::numeric_limits<double>::infinity();
    double slope = 0.0;
    for (const double side : {1.0, -1.0}) {
      const double level = (model.initial.position + side * static_level / 100.0) / 0.1;
      if (std::abs(level) > 0.9999) continue;
      // Growing outwards: -side sin(angle) > 0.
      const double angle = -side * std::acos(level);
      double t = std::fmod(angle - phase, 2.0 * pi);
      if (t < 0.0) t += 2.0 * pi;
      if (t / model.excitation.frequency < expected) slope = std::sqrt(1.0 - level * level);
      expected = std::min(expected, t / model.excitation.frequency);
    }
    if (!std::isfinite(expected)) continue;
    const auto events = events_of(model, 2.0 * expected + 1.0, 1);
    REQUIRE(events.size() == 1);
    CHECK(events[0].kind == EventKind::release);
    CHECK(std::abs(events[0].t - expected) <= 32 * epsilon / slope / model.excitation.frequency);
  }
}

TEST_CASE("Release under a ramp with static = kinetic: a double root at the start of slip", "[exact]") {
  // f = R t; after release at F/R without damping x = (R/k)(s - sin(w s)/w), v = (R/k)(1 - cos w s): v touches zero
  // once a period without crossing it, and the mass goes on.
  Model model = ramped(2.0, 50.0, 0.0, ExcitationType::force_ramp, 3.0);
  model.friction.push_back(coulomb(1.5, 1.5));
  const double w = 5.0;
  ExactEngine engine(model);
  std::vector<Event> events;
  long grazings = 0;
  while (const Interval* interval = engine.next(10.0)) {
    grazings += static_cast<long>(engine.grazings().size());
    if (interval->ending) events.push_back({interval->end(), *interval->ending, engine.position()});
    const double end = interval->end();
    if (interval->begin < 0.5) continue;
    for (int i = 0; i <= 20; ++i) {
      const double t = interval->begin + (end - interval->begin) * i / 20.0;
      const double s = t - 0.5;
      CHECK(std::abs(interval->state_at(t).x - 0.06 * (s - std::sin(w * s) / w)) <= 1e-13);
      CHECK(std::abs(interval->state_at(t).v - 0.06 * (1.0 - std::cos(w * s))) <= 1e-13);
    }
  }
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == EventKind::release);
  CHECK(events[0].t == Approx(0.5).epsilon(4 * epsilon));
  // 9.5 s hold seven periods of 1.2566 s.
  CHECK(grazings == 7);
  CHECK(engine.time() == Approx(10.0).epsilon(4 * epsilon));
}

TEST_CASE("Release under a ramp with damping never comes to rest again", "[exact]") {
  for (const ExcitationType type : {ExcitationType::force_ramp, ExcitationType::base_ramp}) {
    Model model = ramped(2.0, 50.0, 1.0, type, type == ExcitationType::force_ramp ? -3.0 : -0.06);
    model.friction.push_back(coulomb(1.5, 1.5));
    ExactEngine engine(model);
    const auto events = events_of(engine, 200.0);
    REQUIRE(events.size() == 1);
    CHECK(events[0].t == Approx(0.5).epsilon(4 * epsilon));
    // The own motion has fallen by exp(-200/4): x = (f - F_friction - c v)/k with v = -0.06.
    CHECK(engine.velocity() == Approx(-0.06).epsilon(1e-12));
    CHECK(engine.position() == Approx((-600.0 + 1.5 + 0.06) / 50.0).epsilon(1e-12));
  }
}

TEST_CASE("Stick-slip under a base ramp with static > kinetic, every slip and stick in closed form", "[exact]") {
  // No damping. In the frame of the moving base the slip is an arc of a circle: v = V (1 - cos s) + D/(m w) sin s
  // with D = static - kinetic. It ends at w s = 2 (pi - atan(D w/(k V))) with the spring D below kinetic, as far as
  // it began above: x moves by V s + 2 D/k, and rest lasts 2 D/(k V).
  const double m = 0.5;
  const double k = 200.0;
  const double speed = 0.03;
  const double kinetic = 1.0;
  for (const double static_level : {1.0 + 1e-6, 1.01, 1.5, 4.0}) {
    for (const double side : {1.0, -1.0}) {
      Model model = ramped(m, k, 0.0, ExcitationType::base_ramp, side * speed);
      model.friction.push_back(coulomb(kinetic, static_level));
      const double w = std::sqrt(k / m);
      const double excess = static_level - kinetic;
      const double slip = 2.0 * (pi - std::atan(excess * w / (k * speed))) / w;
      const double stick = 2.0 * excess / (k * speed);
      const double first = static_level / (k * speed);
      CAPTURE(static_level, side);
      const auto events = events_of(model, first + 20.5 * (slip + stick) + slip);
      REQUIRE(events.size() >= 40);
      for (int n = 0; n < 20; ++n) {
        const double begin = first + n * (slip + stick);
        const Event& release = events[static_cast<std::size_t>(2 * n)];
        const Event& stop = events[static_cast<std::size_t>(2 * n + 1)];
        CHECK(release.kind == EventKind::release);
        CHECK(stop.kind == EventKind::stop);
        // Pull and speed are known to a few eps of static and of static/(m w): as times, over their rates k V and
        // D/m; the errors of all cycles add up.
        const double allowed =
            64 * epsilon * (n + 1) * (begin + static_level / (k * speed) + static_level / (excess * w));
        CHECK(std::abs(release.t - begin) <= allowed);
        CHECK(std::abs(stop.t - begin - slip) <= allowed);
        CHECK(std::abs(stop.x - side * (n + 1) * (speed * slip + 2.0 * excess / k)) <=
              allowed * speed + 64 * epsilon * stop.t * speed);
      }
    }
  }
}

// ---------------------------------------------------------------------------------------------------------------
// Free vibration

TEST_CASE("Free Coulomb decay loses 4F/k a cycle, to the last bit, and stops inside the rest set", "[exact]") {
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
      CHECK(engine.direction() == Direction::rest);
      CHECK(std::abs(engine.position()) * 64.0 <= static_level * (1.0 + 16 * epsilon));
      CHECK(engine.time() == 1e3);
    }
  }
}

TEST_CASE("Without friction the engine is the linear oscillator", "[exact]") {
  // Position against 50 digits at many times of 50 periods. Phases end at turning points, each of which adds a few
  // eps.
  Random random(22);
  for (const double zeta : {0.0, 0.02, 0.7, 1.0, 3.0}) {
    for (const DamperTo damper : {DamperTo::ground, DamperTo::base}) {
      Model model = base_driven(2.0, 50.0, 2.0 * zeta * 10.0, 0.1, 3.7, 0.4);
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
    // Every half period adds a few eps of itself and rounding of the sum of times.
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

// ---------------------------------------------------------------------------------------------------------------
// Forced vibration

TEST_CASE("The engine follows brute-force integration event by event", "[exact]") {
  struct Case {
    const char* what;
    Model model;
    double kinetic;
    double static_level;
    double periods;
  };
  std::vector<Case> cases;
  cases.push_back({"standard", base_driven(1.0, 100.0, 4.0, 0.1, 10.0), 2.0, 2.0, 8.0});
  cases.push_back({"sticking", base_driven(1.0, 100.0, 4.0, 0.1, 10.0), 7.0, 7.0, 8.0});
  cases.push_back({"static > kinetic", base_driven(1.0, 100.0, 4.0, 0.1, 4.0), 4.0, 6.5, 8.0});
  cases.push_back({"slow drive, many stops", base_driven(1.0, 100.0, 0.5, 0.1, 1.0), 1.5, 2.5, 4.0});
  cases.push_back({"fast drive", base_driven(1.0, 100.0, 1.0, 0.1, 35.0), 2.0, 3.0, 20.0});
  Case to_base{"damper to base", base_driven(1.0, 100.0, 6.0, 0.1, 12.0), 3.0, 4.5, 8.0};
  to_base.model.oscillator.damper_to = DamperTo::base;
  cases.push_back(to_base);
  Case distorted{"distorted drive", base_driven(2.0, 100.0, 3.0, 0.1, 5.0, 0.3), 3.0, 4.0, 8.0};
  distorted.model.excitation.harmonics = {{.order = 2, .amplitude = 0.03, .phase = 1.0},
                                          {.order = 3, .amplitude = 0.02, .phase = -2.0},
                                          {.order = 7, .amplitude = 0.005, .phase = 0.5}};
  cases.push_back(distorted);
  Case force{"force with offset", base_driven(1.0, 100.0, 2.0, 10.0, 8.0), 2.0, 3.0, 8.0};
  force.model.excitation.type = ExcitationType::force_harmonic;
  force.model.excitation.offset = 3.0;
  cases.push_back(force);
  Case heavy{"overdamped", base_driven(1.0, 100.0, 60.0, 0.1, 6.0), 2.0, 2.5, 8.0};
  cases.push_back(heavy);
  for (Case& c : cases) {
    c.model.initial = {0.03, 0.2};
    c.model.friction.push_back(coulomb(c.kinetic, c.static_level));
    const double duration = c.periods * 2.0 * pi / c.model.excitation.frequency;
    test::PlainFriction plain;
    plain.add_coulomb(c.kinetic, c.static_level);
    const test::BruteForce expected = test::follow(c.model, plain, duration);
    ExactEngine engine(c.model);
    const auto events = events_of(engine, duration);
    CAPTURE(c.what);
    REQUIRE(events.size() == expected.events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      CHECK(events[i].kind == expected.events[i].kind);
      // Fixed steps of a 400th of the shortest period leave 1e-13 of the motion; a time is that over the
      // acceleration.
      CHECK(std::abs(events[i].t - expected.events[i].t) <= 1e-10);
      CHECK(std::abs(events[i].x - expected.events[i].x) <= 1e-11);
    }
    CHECK(std::abs(engine.position() - expected.x) <= 1e-11);
    CHECK(std::abs(engine.velocity() - expected.v) <= 1e-10);
  }
}

TEST_CASE("Random oscillators follow brute-force integration event by event", "[exact]") {
  // DUALDAMP_WALK_CASES for a longer run. Brute force looks at the velocity 400 times a period of the fastest part:
  // it cannot see slips and stops shorter than that. The comparison ends at the first of them, and where a touch of
  // the limits is decided by less than its errors.
  const long cases = test::case_count("DUALDAMP_WALK_CASES", 150);
  Random random(25);
  long compared = 0;
  long cut_short = 0;
  for (long i = 0; i < cases; ++i) {
    const double wn = random.logarithmic(1.0, 30.0);
    const double w = wn * random.logarithmic(0.15, 4.0);
    Model model = base_driven(random.logarithmic(0.2, 5.0), 100.0, 0.0, 0.1, w, random.angle());
    model.oscillator.stiffness = model.oscillator.mass * wn * wn;
    const double k = model.oscillator.stiffness;
    if (random.chance(0.8))
      model.oscillator.damping = 2.0 * model.oscillator.mass * wn * random.logarithmic(1e-3, 2.0);
    if (random.chance(0.3)) model.oscillator.damper_to = DamperTo::base;
    if (random.chance(0.3)) {
      model.excitation.type = ExcitationType::force_harmonic;
      model.excitation.amplitude = 0.1 * k;
      model.excitation.offset = random.uniform(-0.05, 0.05) * k;
    }
    for (int order = 2; order < 5; ++order) {
      if (!random.chance(0.25)) continue;
      model.excitation.harmonics.push_back({.order = order,
                                            .amplitude = model.excitation.amplitude * random.uniform(0.0, 0.4),
                                            .phase = random.angle()});
    }
    const double kinetic = 0.1 * k * random.logarithmic(1e-2, 0.9);
    const double static_level = random.chance(0.5) ? kinetic : kinetic * random.uniform(1.0, 1.8);
    model.friction.push_back(coulomb(kinetic, static_level));
    model.initial = {random.uniform(-0.15, 0.15), wn * random.uniform(-0.1, 0.1)};
    const double duration = 6.0 * 2.0 * pi / w;
    const double blind =
        2.0 * pi / std::max({wn, w, 2.0 * model.oscillator.damping / model.oscillator.mass}) / 50.0;

    test::PlainFriction plain;
    plain.add_coulomb(kinetic, static_level);
    const test::BruteForce expected = test::follow(model, plain, duration);
    const auto events = events_of(model, duration);
    CAPTURE(i, model.oscillator.mass, k, model.oscillator.damping, w, model.excitation.phase, kinetic, static_level,
            model.initial.position, model.initial.velocity, model.excitation.harmonics.size());
    bool blinded = false;
    for (std::size_t j = 0; j < events.size() && !blinded; ++j) {
      blinded = j + 1 < events.size() && events[j + 1].t - events[j].t < blind;
      const bool same = j < expected.events.size() && expected.events[j].kind == events[j].kind &&
                        std::abs(expected.events[j].t - events[j].t) <= 1e-8 / w;
      if (blinded && !same) break;
      REQUIRE(j < expected.events.size());
      CHECK(expected.events[j].kind == events[j].kind);
      CHECK(std::abs(expected.events[j].t - events[j].t) <= 1e-8 / w);
      CHECK(std::abs(expected.events[j].x - events[j].x) <= 1e-9);
      ++compared;
    }
    cut_short += blinded ? 1 : 0;
    if (!blinded) CHECK(expected.events.size() == events.size());
  }
  WARN(compared << " events of " << cases << " oscillators compared, " << cut_short << " walks cut short");
}

TEST_CASE("Two Coulomb laws are one with the sums", "[exact]") {
  Model one = standard(2.0, 3.0);
  one.excitation.frequency = 4.0;
  Model two = one;
  two.friction = {coulomb(1.25, 1.5), coulomb(0.75, 1.5)};
  const auto expected = events_of(one, 20.0);
  const auto found = events_of(two, 20.0);
  REQUIRE(expected.size() > 20);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].kind == expected[i].kind);
    CHECK(found[i].t == expected[i].t);
    CHECK(found[i].x == expected[i].x);
  }
}

TEST_CASE("A strong drive reverses the mass without stick, twice a period", "[exact]") {
  const Model model = standard();
  const auto events = events_of(model, 40.0 * 2.0 * pi / 10.0);
  std::vector<Event> late(events.end() - 20, events.end());
  for (std::size_t i = 0; i < late.size(); ++i) {
    CHECK(late[i].kind == EventKind::reversal);
    // Peaks of the closed form; 20 half periods have contracted by exp(-pi zeta/...) each below rounding.
    CHECK(std::abs(std::abs(late[i].x) - 0.186078097956786198557) <= 1e-15);
    if (i > 0) CHECK(late[i].t - late[i - 1].t == Approx(pi / 10.0).epsilon(1e-13));
  }
}

TEST_CASE("A periodic motion keeps its phase over a thousand periods", "[exact]") {
  // With stops, so that every period starts afresh: events fall at the same place of every period.
  Model model = standard(6.0, 7.0);
  model.excitation.frequency = 7.3;
  const double period = 2.0 * pi / 7.3;
  ExactEngine engine(model);
  const auto early = events_of(engine, 40.0 * period);
  const auto late = events_of(engine, 1040.0 * period);
  REQUIRE(late.size() % 1000 == 0);
  const std::size_t each = late.size() / 1000;
  for (std::size_t i = 0; i < each; ++i) {
    const Event& a = late[i];
    const Event& b = late[late.size() - each + i];
    CHECK(a.kind == b.kind);
    CHECK(a.x == Approx(b.x).epsilon(1e-13));
    // Times themselves round at eps t.
    CHECK(std::abs(b.t - a.t - 999.0 * period) <= 8 * epsilon * b.t + 1e-14 * period);
  }
}

TEST_CASE("Events on a period boundary are neither lost nor doubled", "[exact]") {
  // The same motion seen from another origin of time, put so that each event in turn falls on the boundary: the
  // phase of the drive and the state are those of the first run one period before the event.
  for (const Model& model : {standard(), standard(5.0, 6.5)}) {
    const double period = 2.0 * pi / model.excitation.frequency;
    ExactEngine engine(model);
    const auto all = events_of(engine, 30.0 * period);
    const std::size_t settled = all.size() - 30;
    for (std::size_t i = settled; i < settled + 8; ++i) {
      for (const double offset : {0.0, 1e-15, -1e-15, 1e-12, -1e-12}) {
        const double origin = all[i].t - period + offset * period;
        ExactEngine to_origin(model);
        while (to_origin.next(origin) != nullptr) {
        }
        Model shifted = model;
        shifted.initial = {to_origin.position(), to_origin.velocity()};
        shifted.excitation.phase = std::remainder(model.excitation.frequency * origin, 2.0 * pi);
        const auto seen = events_of(shifted, 3.0 * period);
        CAPTURE(i, offset);
        // The first event behind the origin that is surely seen: those within rounding of it may belong to either
        // run.
        std::size_t k = 0;
        while (k < seen.size() && seen[k].t < 0.01 * period) ++k;
        std::size_t j = settled - 10;
        while (all[j].t - origin < 0.01 * period) ++j;
        for (int n = 0; n < 4; ++n, ++j, ++k) {
          REQUIRE(k < seen.size());
          CHECK(seen[k].kind == all[j].kind);
          CHECK(std::abs(seen[k].t + origin - all[j].t) <= 1e-12);
          CHECK(std::abs(seen[k].x - all[j].x) <= 1e-13);
        }
      }
    }
  }
}

TEST_CASE("Walking in small steps gives the events of walking in large ones", "[exact]") {
  const Model model = standard(4.0, 6.0);
  const auto expected = events_of(model, 6.0);
  ExactEngine engine(model);
  std::vector<Event> found;
  for (int i = 1; i <= 600; ++i) {
    for (const Event& event : events_of(engine, 0.01 * i)) found.push_back(event);
  }
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].kind == expected[i].kind);
    CHECK(std::abs(found[i].t - expected[i].t) <= 1e-12);
    CHECK(std::abs(found[i].x - expected[i].x) <= 1e-13);
  }
}

TEST_CASE("Walking by periods gives the events of walking by time", "[exact]") {
  const Model model = standard(4.0, 6.0);
  const double period = 2.0 * pi / 10.0;
  const auto expected = events_of(model, 10.0 * period);
  ExactEngine engine(model);
  std::vector<Event> found;
  while (engine.cycle() < 10) {
    const Interval* interval = engine.next_in_period();
    REQUIRE(interval != nullptr);
    if (interval->ending) found.push_back({interval->end(), *interval->ending, engine.position()});
  }
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].kind == expected[i].kind);
    CHECK(std::abs(found[i].t - expected[i].t) <= 1e-12);
  }
}

TEST_CASE("A friction of zero and a drive of zero are no friction and no drive", "[exact]") {
  Model none = base_driven(1.0, 100.0, 1.0, 0.1, 7.0);
  none.initial = {0.1, 0.5};
  Model zero = none;
  zero.friction.push_back(coulomb(0.0, 0.0));
  const auto expected = events_of(none, 20.0);
  const auto found = events_of(zero, 20.0);
  REQUIRE(expected.size() > 20);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].t == Approx(expected[i].t).epsilon(1e-14));

  Model still = ramped(1.0, 100.0, 1.0, ExcitationType::none, 0.0);
  still.friction.push_back(coulomb(0.5, 0.7));
  still.initial = {0.1, 0.5};
  Model undriven = base_driven(1.0, 100.0, 1.0, 0.0, 7.0);
  undriven.friction = still.friction;
  undriven.initial = still.initial;
  const auto free = events_of(still, 20.0);
  const auto driven_by_nothing = events_of(undriven, 20.0);
  REQUIRE(free.size() > 3);
  REQUIRE(driven_by_nothing.size() == free.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    CHECK(driven_by_nothing[i].kind == free[i].kind);
    CHECK(driven_by_nothing[i].t == Approx(free[i].t).epsilon(1e-14));
  }
}

TEST_CASE("Without friction a mass in equilibrium stays until the drive moves it", "[exact]") {
  Model model = ramped(1.0, 100.0, 1.0, ExcitationType::none, 0.0);
  ExactEngine resting(model);
  CHECK(events_of(resting, 1e3).empty());
  CHECK(resting.position() == 0.0);
  model.excitation = {.type = ExcitationType::base_ramp, .slope = -0.01};
  ExactEngine moving(model);
  CHECK(moving.direction() == Direction::backward);
  // y = sin(w t): force zero and growing at the start.
  Model driven = base_driven(1.0, 100.0, 1.0, 0.1, 7.0, -pi / 2.0);
  CHECK(ExactEngine(driven).direction() == Direction::forward);
}

TEST_CASE("The sensitivity is the derivative of the end state by the start", "[exact]") {
  // Central differences of second order: (relative step)^2 = 1e-12 and rounding 1e-15/1e-6 leave 1e-8 of the
  // largest entry. A stop makes the map forget the direction of the perturbation: its determinant is zero.
  Random random(26);
  int stopped = 0;
  for (int i = 0; i < 60; ++i) {
    Model model = base_driven(1.0, 100.0, 4.0, 0.1, random.uniform(4.0, 20.0));
    const double kinetic = random.uniform(0.5, 8.0);
    model.friction.push_back(coulomb(kinetic, kinetic * random.uniform(1.0, 1.5)));
    model.initial = {random.uniform(-0.1, 0.1), random.sign() * random.uniform(0.2, 1.0)};
    const double duration = 1.7 * 2.0 * pi / model.excitation.frequency;
    ExactEngine engine(model);
    engine.track_sensitivity(true);
    const auto events = events_of(engine, duration);
    const Eigen::Matrix2d found = engine.sensitivity();
    const auto end_of = [&](double dx, double dv, std::vector<Event>& seen) {
      Model moved = model;
      moved.initial.position += dx;
      moved.initial.velocity += dv;
      ExactEngine other(moved);
      seen = events_of(other, duration);
      return Eigen::Vector2d(other.position(), other.velocity());
    };
    bool same_events = true;
    Eigen::Matrix2d expected;
    for (int column = 0; column < 2; ++column) {
      const double step = column == 0 ? 1e-7 : 1e-6;
      std::vector<Event> above;
      std::vector<Event> below;
      const Eigen::Vector2d difference = end_of(column == 0 ? step : 0.0, column == 1 ? step : 0.0, above) -
                                         end_of(column == 0 ? -step : 0.0, column == 1 ? -step : 0.0, below);
      expected.col(column) = difference / (2.0 * step);
      same_events = same_events && above.size() == events.size() && below.size() == events.size();
    }
    if (!same_events) continue;  // a branch of the map ends here
    CAPTURE(i, kinetic, events.size());
    // Columns by position and by velocity, rows of m and m/s: scaled by the frequency.
    const double scale = expected.cwiseAbs().maxCoeff();
    CHECK((found - expected).cwiseAbs().maxCoeff() <= 1e-6 * scale + 1e-8);
    const bool stops =
        std::any_of(events.begin(), events.end(), [](const Event& e) { return e.kind == EventKind::stop; });
    stopped += stops ? 1 : 0;
    if (stops) CHECK(std::abs(found.determinant()) <= 1e-12 * scale * scale);
  }
  CHECK(stopped > 10);
}

TEST_CASE("Intervals join: position and velocity are continuous, acceleration obeys the equation of motion",
          "[exact]") {
  Random random(23);
  for (int i = 0; i < 30; ++i) {
    Model model = base_driven(random.logarithmic(0.1, 10.0), 100.0, random.uniform(0.0, 30.0), 0.1,
                              random.logarithmic(1.0, 40.0), random.angle());
    const double kinetic = random.uniform(0.0, 8.0);
    model.friction.push_back(coulomb(kinetic, kinetic * random.uniform(1.0, 1.5)));
    if (random.chance(0.5)) model.oscillator.damper_to = DamperTo::base;
    model.initial = {random.uniform(-0.2, 0.2), random.uniform(-1.0, 1.0)};
    const sim::Oscillator& o = model.oscillator;
    ExactEngine engine(model);
    double x = model.initial.position;
    double v = model.initial.velocity;
    double end = 0.0;
    const double speed = std::max(1.0, 0.3 * model.excitation.frequency);
    while (const Interval* interval = engine.next(10.0 * engine.period())) {
      const sim::Sample first = interval->at(0.0);
      CHECK(interval->begin == Approx(end).epsilon(4 * epsilon).margin(1e-15));
      CHECK(std::abs(first.x - x) <= 1e-14);
      CHECK(std::abs(first.v - v) <= 1e-14 * speed);
      for (const double part : {0.0, 0.3, 0.8, 1.0}) {
        const sim::Sample s = interval->at(part * interval->duration);
        const double damper = o.damping * (s.v - (o.damper_to == DamperTo::base ? s.y_rate : 0.0));
        const double balance = o.mass * s.a + damper + o.stiffness * (s.x - s.y) + s.force;
        const double size =
            o.mass * std::abs(s.a) + std::abs(damper) + 100.0 * (std::abs(s.x) + std::abs(s.y)) + 10.0;
        CHECK(std::abs(balance) <= 1e-12 * size);
        CHECK(s.v * friction::sign(interval->direction) >= -1e-13 * speed);
        if (interval->direction == Direction::rest) CHECK(s.v == 0.0);
      }
      const sim::Sample last = interval->at(interval->duration);
      x = last.x;
      v = interval->ending ? 0.0 : last.v;
      end = interval->end();
    }
  }
}

// ---------------------------------------------------------------------------------------------------------------
// The campaign: random releases from rest against the closed form in 50 digits and a search in long double.

TEST_CASE("After every release from exact stick the next event is found, and none is invented", "[exact]") {
  // DUALDAMP_RELEASE_CASES for a longer run.
  const long cases = test::case_count("DUALDAMP_RELEASE_CASES", 2000);
  Random random(24);
  long releases = 0;
  long double_roots = 0;
  long short_slips = 0;
  double worst = 0.0;
  double shortest = 1.0;
  while (releases < cases) {
    const double wn = random.logarithmic(1.0, 100.0);
    const double m = random.logarithmic(0.1, 10.0);
    const double zeta = random.chance(0.2) ? 0.0 : random.logarithmic(1e-3, 3.0);
    const double r = random.logarithmic(0.05, 5.0);
    if (std::abs(zeta - 1.0) < 1e-3 || (zeta < 1e-2 && std::abs(r - 1.0) < 1e-2)) continue;
    const double k = m * wn * wn;
    const double w = r * wn;
    Model model = base_driven(m, k, 2.0 * zeta * m * wn, random.logarithmic(1e-3, 1.0), w, random.angle());
    const double drive = model.excitation.amplitude;
    const bool equal = random.chance(0.5);
    const double kinetic = k * drive * random.logarithmic(1e-3, 0.99);
    const double static_level = equal ? kinetic : kinetic * random.uniform(1.0, 2.0);
    model.friction.push_back(coulomb(kinetic, static_level));
    const double start = drive * std::cos(model.excitation.phase);
    // A third of the limits are reached just before the pull turns: slips from 1e-3 periods on.
    double room = random.uniform(-1.0, 1.0) * static_level / k;
    if (random.chance(0.33)) room = drive * (1.0 - random.logarithmic(1e-6, 1e-1)) - start - static_level / k;
    model.initial.position = start + room;

    ExactEngine engine(model);
    if (engine.direction() != Direction::rest) continue;
    const auto first = events_of(engine, 1.5 * engine.period(), 1);
    if (first.empty()) continue;  // the pull never reaches the limit
    REQUIRE(first[0].kind == EventKind::release);
    const double side = friction::sign(engine.direction());
    // At release cos(angle) = (x0 + side static/k)/Y with the pull growing; not too near its turning point.
    const long double level = (static_cast<long double>(model.initial.position) +
                               static_cast<long double>(side) * static_cast<long double>(static_level) / k) /
                              drive;
    if (!(std::abs(level) < 1.0L - 0.9e-6L)) continue;
    ++releases;
    double_roots += equal ? 1 : 0;
    const long double sine = -static_cast<long double>(side) * std::sqrt(1.0L - level * level);
    const oracle::LinearProblem slip{
        .mass = m,
        .damping = model.oscillator.damping,
        .stiffness = k,
        .constant = -side * kinetic,
        .harmonics = {{w, k * drive * oracle::Complex(static_cast<double>(level), static_cast<double>(sine))}},
        .x0 = model.initial.position};
    oracle::ExponentialSum velocity;
    for (const oracle::Exponential& e : oracle::slip_velocity(slip)) {
      velocity.add(e.exponent, static_cast<long double>(side) * e.coefficient);
    }
    velocity.finish(equal ? 2 : 1);
    const long double horizon = 3.0L * static_cast<long double>(engine.period());
    const auto expected = velocity.first_crossing(horizon);
    const auto next = events_of(engine, first[0].t + 2.9 * engine.period(), 1);

    CAPTURE(m, k, model.oscillator.damping, drive, w, model.excitation.phase, kinetic, static_level,
            model.initial.position);
    if (!expected || *expected > 2.9L * static_cast<long double>(engine.period())) {
      CHECK(next.empty());
      continue;
    }
    REQUIRE(next.size() == 1);
    const double found = next[0].t - first[0].t;
    const auto s = static_cast<double>(*expected);
    // Time itself rounds at eps t; a release close to the drive's turning point is known to eps/sine.
    const double error = std::abs(found - s) / s;
    const double allowed =
        1e-11 + 64 * epsilon * next[0].t / s + 1e-14 / static_cast<double>(std::abs(sine)) / (w * s);
    CHECK(error <= allowed);
    CHECK((next[0].kind == EventKind::stop || next[0].kind == EventKind::reversal));
    worst = std::max(worst, error);
    shortest = std::min(shortest, s / engine.period());
    short_slips += s < 0.05 * engine.period() ? 1 : 0;
  }
  WARN(releases << " releases, " << double_roots << " of them with static = kinetic, " << short_slips
                << " slips below a twentieth of the period, the shortest " << shortest
                << " periods; largest relative error of a slip's duration " << worst);
}
