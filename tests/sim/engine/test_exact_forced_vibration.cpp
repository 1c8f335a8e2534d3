#include "sim/engine/exact_engine.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/sim/engine/exact_motions.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using namespace dualdamp::sim;
using namespace dualdamp::test;
using friction::Direction;

TEST_CASE("The engine follows brute-force integration event by event", "[exact]") {
  struct Case {
    const char* what;
    Model model;
    double kinetic;
    double static_level;
    double periods;
  };
  std::vector<Case> cases;
  cases.push_back({"standard", base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = 10.0}), 2.0, 2.0, 8.0});
  cases.push_back({"sticking", base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = 10.0}), 7.0, 7.0, 8.0});
  cases.push_back({"static > kinetic", base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = 4.0}), 4.0, 6.5, 8.0});
  cases.push_back({"slow drive, many stops", base_driven({.k = 100.0, .c = 0.5, .Y = 0.1}), 1.5, 2.5, 4.0});
  cases.push_back({"fast drive", base_driven({.k = 100.0, .c = 1.0, .Y = 0.1, .w = 35.0}), 2.0, 3.0, 20.0});
  Case to_base{"damper to base", base_driven({.k = 100.0, .c = 6.0, .Y = 0.1, .w = 12.0}), 3.0, 4.5, 8.0};
  to_base.model.oscillator.damper_to = DamperTo::base;
  cases.push_back(to_base);
  Case distorted{"distorted drive", base_driven({.m = 2.0, .k = 100.0, .c = 3.0, .Y = 0.1, .w = 5.0, .phase = 0.3}),
                 3.0, 4.0, 8.0};
  distorted.model.excitation.harmonics = {{.order = 2, .amplitude = 0.03, .phase = 1.0},
                                          {.order = 3, .amplitude = 0.02, .phase = -2.0},
                                          {.order = 7, .amplitude = 0.005, .phase = 0.5}};
  cases.push_back(distorted);
  Case force{"force with offset", base_driven({.k = 100.0, .c = 2.0, .Y = 10.0, .w = 8.0}), 2.0, 3.0, 8.0};
  force.model.excitation.type = ExcitationType::force_harmonic;
  force.model.excitation.offset = 3.0;
  cases.push_back(force);
  Case heavy{"overdamped", base_driven({.k = 100.0, .c = 60.0, .Y = 0.1, .w = 6.0}), 2.0, 2.5, 8.0};
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
  // DUALDAMP_WALK_CASES for a longer run. Brute force evaluates the velocity 400 times in a period of the fastest
  // part, so it misses shorter slips and stops. The comparison ends at the first of them, and where its errors
  // decide whether a limit is reached.
  const long cases = test::case_count("DUALDAMP_WALK_CASES", 150);
  Random random(25);
  long compared = 0;
  long cut_short = 0;
  for (long i = 0; i < cases; ++i) {
    const double wn = random.logarithmic(1.0, 30.0);
    const double w = wn * random.logarithmic(0.15, 4.0);
    Model model =
        base_driven({.m = random.logarithmic(0.2, 5.0), .k = 100.0, .Y = 0.1, .w = w, .phase = random.angle()});
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
  std::vector<EngineEvent> late(events.end() - 20, events.end());
  for (std::size_t i = 0; i < late.size(); ++i) {
    CHECK(late[i].kind == EventKind::reversal);
    // Peaks of the closed form; 20 half periods have contracted by exp(-pi zeta/...) each below rounding.
    CHECK(std::abs(std::abs(late[i].x) - 0.186078097956786198557) <= 1e-15);
    if (i > 0) CHECK(late[i].t - late[i - 1].t == Approx(pi / 10.0).epsilon(1e-13));
  }
}

TEST_CASE("A periodic motion keeps its phase over a thousand periods", "[exact]") {
  // With stops, after which the motion does not depend on its past: events are at the same place of every period.
  Model model = standard(6.0, 7.0);
  model.excitation.frequency = 7.3;
  const double period = 2.0 * pi / 7.3;
  ExactEngine engine(model);
  const auto early = events_of(engine, 40.0 * period);
  const auto late = events_of(engine, 1040.0 * period);
  REQUIRE(late.size() % 1000 == 0);
  const std::size_t each = late.size() / 1000;
  for (std::size_t i = 0; i < each; ++i) {
    const EngineEvent& a = late[i];
    const EngineEvent& b = late[late.size() - each + i];
    CHECK(a.kind == b.kind);
    CHECK(a.x == Approx(b.x).epsilon(1e-13));
    // Times themselves round at eps t.
    CHECK(std::abs(b.t - a.t - 999.0 * period) <= 8 * epsilon * b.t + 1e-14 * period);
  }
}

TEST_CASE("Events on a period boundary are neither lost nor doubled", "[exact]") {
  // The same motion with another origin of time, chosen so that each event in turn is on the boundary: the phase of
  // the drive and the state are those of the first run one period before the event.
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
        // The first event that is certainly after the origin: those within rounding of it may belong to either run.
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
  std::vector<EngineEvent> found;
  for (int i = 1; i <= 600; ++i) {
    for (const EngineEvent& event : events_of(engine, 0.01 * i)) found.push_back(event);
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
  std::vector<EngineEvent> found;
  while (engine.periods_passed() < 10) {
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
  Model none = base_driven({.k = 100.0, .c = 1.0, .Y = 0.1, .w = 7.0});
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
  Model undriven = base_driven({.k = 100.0, .c = 1.0, .Y = 0.0, .w = 7.0});
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
  Model driven = base_driven({.k = 100.0, .c = 1.0, .Y = 0.1, .w = 7.0, .phase = -pi / 2.0});
  CHECK(ExactEngine(driven).direction() == Direction::forward);
}

TEST_CASE("The sensitivity is the derivative of the end state by the start", "[exact]") {
  // Central differences of second order: (relative step)^2 = 1e-12 and rounding 1e-15/1e-6 leave 1e-8 of the
  // largest entry. After a stop the map does not depend on the direction of the perturbation: its determinant is
  // zero.
  Random random(26);
  int stopped = 0;
  for (int i = 0; i < 60; ++i) {
    Model model = base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = random.uniform(4.0, 20.0)});
    const double kinetic = random.uniform(0.5, 8.0);
    model.friction.push_back(coulomb(kinetic, kinetic * random.uniform(1.0, 1.5)));
    model.initial = {random.uniform(-0.1, 0.1), random.sign() * random.uniform(0.2, 1.0)};
    const double duration = 1.7 * 2.0 * pi / model.excitation.frequency;
    ExactEngine engine(model);
    engine.track_sensitivity(true);
    const auto events = events_of(engine, duration);
    const Eigen::Matrix2d found = engine.sensitivity();
    const auto end_of = [&](double dx, double dv, std::vector<EngineEvent>& seen) {
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
      std::vector<EngineEvent> above;
      std::vector<EngineEvent> below;
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
        std::any_of(events.begin(), events.end(), [](const EngineEvent& e) { return e.kind == EventKind::stop; });
    stopped += stops ? 1 : 0;
    if (stops) CHECK(std::abs(found.determinant()) <= 1e-12 * scale * scale);
  }
  CHECK(stopped > 10);
}

TEST_CASE("Intervals join: position and velocity are continuous, acceleration obeys the equation of motion",
          "[exact]") {
  Random random(23);
  for (int i = 0; i < 30; ++i) {
    Model model = base_driven({.m = random.logarithmic(0.1, 10.0),
                               .k = 100.0,
                               .c = random.uniform(0.0, 30.0),
                               .Y = 0.1,
                               .w = random.logarithmic(1.0, 40.0),
                               .phase = random.angle()});
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
        if (interval->direction == Direction::none) CHECK(s.v == 0.0);
      }
      const sim::Sample last = interval->at(interval->duration);
      x = last.x;
      v = interval->ending ? 0.0 : last.v;
      end = interval->end();
    }
  }
}
