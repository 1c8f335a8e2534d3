#include "sim/engine/exact_engine.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/sim/engine/exact_motions.hpp"
#include "tests/support/exponential_sum.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using namespace dualdamp::sim;
using namespace dualdamp::test;
using friction::Direction;

// Random releases from rest against the closed form in 50 digits and a search in long double.

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
    if (engine.direction() != Direction::none) continue;
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
