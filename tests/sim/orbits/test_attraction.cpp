// Whether a motion approaches an orbit, and after how many periods it returns: tested on known maps.

#include "sim/orbits/attraction.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/orbits/recurrence.hpp"

namespace {

using namespace dualdamp;

constexpr double swing_omega = 2.0;

sim::State at(double x, double v) { return {.x = x, .v = v, .direction = friction::Direction::forward}; }

/// An orbit at x = 1 m, v = 0.5 m/s. In a period, deviations from it rotate by `angle` and shrink by the factor
/// `radius`.
sim::ForcingPeriod orbit(double radius, double angle) {
  sim::ForcingPeriod period;
  period.begin = period.end = at(1.0, 0.5);
  period.size = 1.0;
  const double c = radius * std::cos(angle);
  const double s = radius * std::sin(angle);
  period.monodromy.resize(2, 2);
  period.monodromy << c, -s / swing_omega, s * swing_omega, c;
  return period;
}

/// One period of a map with this orbit and a quadratic part of size `curvature`.
sim::State next(const sim::ForcingPeriod& o, const sim::State& state, double curvature) {
  const Eigen::Vector2d d(state.x - o.begin.x, state.v - o.begin.v);
  const Eigen::Vector2d linear = o.monodromy * d;
  return at(o.begin.x + linear[0] + curvature * d[0] * d[0], o.begin.v + linear[1]);
}

}  // namespace

TEST_CASE("a motion on the linear map of its orbit approaches it at once, however slowly") {
  for (const double radius : {0.0, 0.5, 0.999}) {
    const sim::ForcingPeriod o = orbit(radius, 1.3);
    sim::Attraction attraction(o, swing_omega, 1e-9);
    sim::State state = at(1.4, 0.1);
    for (int i = 0; i < 4; ++i) {
      CHECK_FALSE(attraction.approaches());
      attraction.observe(state);
      state = next(o, state, 0.0);
    }
    CHECK(attraction.approaches());
    CHECK_FALSE(attraction.leaves());
  }
}

TEST_CASE("a motion that the quadratic part carries off does not approach the orbit") {
  const sim::ForcingPeriod o = orbit(0.9, 0.2);
  sim::Attraction attraction(o, swing_omega, 1e-9);
  sim::State state = at(2.0, 0.5);
  for (int i = 0; i < 12 && !attraction.leaves(); ++i) {
    attraction.observe(state);
    CHECK_FALSE(attraction.approaches());
    state = next(o, state, 1.0);
  }
  CHECK(attraction.leaves());
  // Near enough the same map attracts.
  sim::Attraction near(o, swing_omega, 1e-9);
  state = at(1.001, 0.5);
  for (int i = 0; i < 5; ++i) {
    near.observe(state);
    state = next(o, state, 1.0);
  }
  CHECK(near.approaches());
}

TEST_CASE("a motion that stays beside the orbit never approaches it") {
  const sim::ForcingPeriod o = orbit(0.9, 0.7);
  sim::Attraction attraction(o, swing_omega, 1e-9);
  for (int i = 0; i < 50; ++i) attraction.observe(at(i % 2 == 0 ? 1.02 : 0.98, 0.5));
  CHECK_FALSE(attraction.approaches());
}

TEST_CASE("a motion comes nearer if it does so over a whole winding") {
  const sim::ForcingPeriod o = orbit(0.9, 0.05);
  for (const double radius : {0.99, 1.0, 1.01}) {
    // An ellipse, five times as long as wide: at its ends the deviation is the largest.
    sim::Attraction attraction(o, swing_omega, 1e-9);
    for (int i = 0; i < 220; ++i) {
      const double size = std::pow(radius, i);
      attraction.observe(at(1.0 + size * std::cos(0.05 * i), 0.5 + 0.2 * size * swing_omega * std::sin(0.05 * i)));
    }
    CHECK(attraction.has_come_nearer() == (radius < 1.0));
  }
}

TEST_CASE("a motion comes back after its shortest period") {
  for (const int period : {1, 2, 7, 64}) {
    sim::Recurrence recurrence(swing_omega);
    for (int i = 0; i < 200; ++i) {
      const double angle = 6.283185307179586 * i / period;
      recurrence.add(at(std::cos(angle), swing_omega * std::sin(angle)), 1.0);
    }
    CHECK(recurrence.shortest(1e-9) == period);
    CHECK(recurrence.closure(period) < 1e-9);
  }
  sim::Recurrence drifting(swing_omega);
  for (int i = 0; i < 200; ++i) drifting.add(at(0.01 * i, 0.0), 1.0);
  CHECK(drifting.shortest(1e-3) == 0);
}
