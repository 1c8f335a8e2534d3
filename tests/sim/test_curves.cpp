// Maps of steady states against Den Hartog's closed form, which shares no code with the engine, and against points
// computed one by one.
#include "sim/curves.hpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "friction_models/coulomb.hpp"
#include "sim/analytic/den_hartog.hpp"

using namespace dualdamp;

namespace {

/// m = k = 1 and friction of 1 N: frequencies are ratios r, amplitudes multiples of x_f.
sim::Model unit_model(double zeta) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 2.0 * zeta};
  model.excitation.type = sim::ExcitationType::base_harmonic;
  model.friction.emplace_back(friction::Coulomb(1.0, 1.0));
  return model;
}

/// `count` values from `low` to `high` with equal ratios.
std::vector<double> ratios(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low * std::pow(high / low, i / (count - 1.0)));
  return values;
}

std::set<int> stops_of(const sim::Curve& map) {
  std::set<int> stops;
  for (const sim::CurvePoint& point : map.points)
    if (point.ok()) stops.insert(point.stops);
  return stops;
}

bool same(const sim::CurvePoint& a, const sim::CurvePoint& b) {
  return a.omega == b.omega && a.Y == b.Y && a.x == b.x && a.phase == b.phase && a.stops == b.stops &&
         a.sticks == b.sticks && a.stable == b.stable && a.ok() == b.ok();
}

}  // namespace

TEST_CASE("a map sticks below Den Hartog's boundary and follows his amplitude above it") {
  const std::vector<double> frequencies = ratios(0.06, 1.0, 25);
  const std::vector<double> amplitudes = ratios(1.1, 600.0, 30);
  for (const double zeta : {0.05, 0.2}) {
    int sticking = 0;
    int free = 0;
    for (const sim::CurvePoint& point : sim::regime_map(unit_model(zeta), frequencies, amplitudes).points) {
      CAPTURE(zeta, point.omega, point.Y);
      REQUIRE(point.ok());
      const sim::analytic::DenHartog functions = sim::analytic::den_hartog(zeta, point.omega);
      const double boundary = 1.0 / sim::analytic::non_sticking_boundary(functions);
      // A rest near the boundary is shorter than what the engine takes for one.
      if (std::abs(point.Y / boundary - 1.0) < 1e-6) continue;
      CHECK((point.sticks > 0) == (point.Y < boundary));
      ++(point.sticks > 0 ? sticking : free);
      if (point.sticks > 0) continue;
      // Both are sums of a few terms of the size of the amplitude.
      CHECK(point.x == Approx(*sim::analytic::amplitude(functions, point.Y, 1.0)).epsilon(1e-11));
      CHECK(point.stops == 0);
    }
    CHECK(sticking > 100);
    CHECK(free > 100);
  }
}

TEST_CASE("stops come in pairs, more of them the slower the drive and the weaker the damping") {
  // Each base stroke drags the mass along in slips; half a stroke holds 1/(2 r) natural half periods at most, so
  // that above r = 1/2 there is one slip a stroke.
  const std::vector<double> slow = ratios(0.06, 0.12, 12);
  const std::vector<double> amplitudes = ratios(1.05, 6.0, 40);
  CHECK(stops_of(sim::regime_map(unit_model(0.05), slow, amplitudes)) == std::set<int>{2, 4, 6});
  const std::set<int> undamped = stops_of(sim::regime_map(unit_model(0.0), slow, amplitudes));
  for (const int stops : {2, 4, 6, 8}) CHECK(undamped.contains(stops));
  for (const double zeta : {0.0, 0.05})
    CHECK(stops_of(sim::regime_map(unit_model(zeta), ratios(0.52, 0.95, 12), amplitudes)) == std::set<int>{0, 2});
}

TEST_CASE("a point of a map is the steady state of its own numbers, whatever the number of threads") {
  const std::vector<double> frequencies = ratios(0.1, 0.9, 9);
  const std::vector<double> amplitudes = ratios(1.05, 50.0, 31);
  const sim::Model model = unit_model(0.05);
  const sim::Curve map = sim::regime_map(model, frequencies, amplitudes);
  REQUIRE(map.points.size() == 9 * 31);
  for (std::size_t i = 0; i < map.points.size(); i += 17) {
    sim::Model own = model;
    own.excitation.frequency = frequencies[i / 31];
    own.excitation.amplitude = amplitudes[i % 31];
    const sim::SteadyState state = sim::steady_state(own);
    CHECK(map.points[i].omega == own.excitation.frequency);
    CHECK(map.points[i].Y == own.excitation.amplitude);
    CHECK(map.points[i].x == state.amplitude);
    CHECK(map.points[i].stops == state.stops_per_cycle);
    CHECK(map.points[i].sticks == static_cast<int>(state.sticks.size()));
    CHECK(map.points[i].stable == state.stable());
  }
  for (const std::size_t threads : {1, 3}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    CHECK(std::ranges::equal(sim::regime_map(model, frequencies, amplitudes).points, map.points, same));
  }
}

TEST_CASE("reasons and warnings of many points are kept once, with their number and first point") {
  // Undamped at resonance: friction of 1 N limits the motion up to Y = 4/pi, and a small drive never moves the
  // mass.
  const std::vector<double> amplitudes = {0.5, 2.0, 0.9, 2.0, 1.2, 2.0};
  const sim::Curve curve = sim::xy_curve(
      [] {
        sim::Model model = unit_model(0.0);
        model.excitation.frequency = 1.0;
        return model;
      }(),
      amplitudes);
  REQUIRE(curve.points.size() == amplitudes.size());
  REQUIRE(curve.reasons.size() == 2);
  REQUIRE(curve.remarks.size() == 2);
  for (const std::size_t failed : {1U, 3U, 5U}) {
    CHECK_FALSE(curve.points[failed].ok());
    CHECK(curve.reason(curve.points[failed]) == curve.reasons[1]);
  }
  CHECK(curve.points[0].ok());
  CHECK(curve.points[0].sticks == 1);
  CHECK(curve.remarks[0].first == 0);
  CHECK(curve.remarks[0].count == 2);
  CHECK(curve.remarks[1].text == curve.reasons[1]);
  CHECK(curve.remarks[1].first == 1);
  CHECK(curve.remarks[1].count == 3);
}
