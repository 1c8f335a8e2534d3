// Maps of steady states against Den Hartog's closed form, which shares no code with the engine, and against points
// that the engine finds one by one.
#include "sim/curves/curves.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/support/random.hpp"

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

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same(const sim::CurvePoint& a, const sim::CurvePoint& b) {
  return a.omega == b.omega && a.Y == b.Y && same_bits(a.x, b.x) && same_bits(a.phase, b.phase) &&
         a.stops == b.stops && a.sticks == b.sticks && a.stable == b.stable && a.reason == b.reason;
}

bool same(const core::SearchCount& a, const core::SearchCount& b) {
  return a.searches == b.searches && a.panels == b.panels && a.splits == b.splits && a.grazings == b.grazings;
}

double turns_apart(double a, double b) {
  const double gap = std::abs(a - b);
  return std::min(gap, std::abs(gap - 2.0 * std::numbers::pi));
}

/// Any model whose points packs may find: two laws, which add up to one; a drive that does not begin at its peak; a
/// motion that does not begin at rest.
sim::Model model_for_packs(test::Random& random) {
  sim::Model model = unit_model(random.uniform(0.01, 0.95));
  model.friction.emplace_back(friction::Coulomb(0.5, 0.5));
  model.excitation = {.amplitude = random.logarithmic(4.0, 50.0),
                      .frequency = random.logarithmic(0.05, 10.0),
                      .phase = random.angle()};
  const bool force = random.chance(0.3);
  model.excitation.type = force ? sim::ExcitationType::force_harmonic : sim::ExcitationType::base_harmonic;
  if (random.chance(0.3)) model.oscillator.damper_to = sim::DamperTo::base;
  model.initial = {.position = random.uniform(-2.0, 2.0), .velocity = random.uniform(-2.0, 2.0)};
  return model;
}

/// Every point against the engine's result for this point alone, within the accuracy of both.
void compare_with_engine(const sim::Curve& curve, sim::Model model) {
  for (const sim::CurvePoint& point : curve.points) {
    model.excitation.frequency = point.omega;
    model.excitation.amplitude = point.Y;
    const sim::SteadyState state = sim::steady_state(model);
    CAPTURE(model.oscillator.damping, point.omega, point.Y);
    REQUIRE(point.ok() == state.outcome.ok());
    if (!point.ok()) continue;
    CHECK(point.stops == state.stops_per_cycle);
    CHECK(point.sticks == static_cast<int>(state.sticks.size()));
    CHECK(point.stable == state.stable());
    // Both close to 1e-14 of the amplitude; 1/(1 - multiplier) amplifies that.
    CHECK(point.x == Approx(state.amplitude).epsilon(1e-13).margin(0.0));
    if (point.phase != 0.0) CHECK(turns_apart(point.phase, state.phase) < 1e-13);
  }
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
      // Near the boundary a stick is shorter than the shortest that the engine counts.
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
  // In each stroke of the base the mass follows in slips of about a natural period. A stroke contains 1/(2 r) of
  // them, so above r = 1/2 there is one slip in a stroke.
  const std::vector<double> slow = ratios(0.06, 0.12, 12);
  const std::vector<double> amplitudes = ratios(1.05, 6.0, 40);
  CHECK(stops_of(sim::regime_map(unit_model(0.05), slow, amplitudes)) == std::set<int>{2, 4, 6});
  // A fourth slip begins 21.7 or more before the base reverses; at r = 0.06 a slip that early does not end in time.
  CHECK(stops_of(sim::regime_map(unit_model(0.05), {0.02}, {1.05})) == std::set<int>{8});
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
    // In packs or not: both close to 1e-14 of the amplitude.
    CHECK(map.points[i].x == Approx(state.amplitude).epsilon(1e-13).margin(0.0));
    CHECK(map.points[i].stops == state.stops_per_cycle);
    CHECK(map.points[i].sticks == static_cast<int>(state.sticks.size()));
    CHECK(map.points[i].stable == state.stable());
  }
  for (const int threads : {1, 3}) {
    const sim::Curve again = sim::regime_map(model, frequencies, amplitudes, {}, {.threads = threads});
    CHECK(std::ranges::equal(again.points, map.points,
                             [](const sim::CurvePoint& a, const sim::CurvePoint& b) { return same(a, b); }));
  }
}

TEST_CASE("curves and maps are the engine's to rounding, whoever finds the points") {
  test::Random random(7);
  int free = 0;
  int sticking = 0;
  const auto check = [&](const sim::Curve& curve, const sim::Model& model) {
    compare_with_engine(curve, model);
    for (const sim::CurvePoint& point : curve.points) ++(point.sticks > 0 ? sticking : free);
  };
  for (int i = 0; i < 12; ++i) {
    const sim::Model model = model_for_packs(random);
    check(sim::xy_curve(model, ratios(4.0, 100.0, 70)), model);
    check(sim::frequency_response(model, ratios(0.05, 10.0, 70)), model);
    check(sim::regime_map(model, ratios(0.05, 10.0, 9), ratios(4.0, 100.0, 9)), model);
  }
  CHECK(free > 500);
  CHECK(sticking > 500);
}

TEST_CASE("curves and maps have the same bits for every width of packs and number of threads") {
  test::Random random(8);
  const auto compare = [](const auto& compute) {
    const sim::Curve reference = compute(sim::BatchOptions{.width = 1, .threads = 1});
    for (const int width : sim::batch_widths()) {
      for (const int threads : {1, 2}) {
        CAPTURE(width, threads);
        const sim::Curve other = compute(sim::BatchOptions{.width = width, .threads = threads});
        CHECK(std::ranges::equal(other.points, reference.points,
                                 [](const sim::CurvePoint& a, const sim::CurvePoint& b) { return same(a, b); }));
        CHECK(other.reasons == reference.reasons);
        CHECK(same(other.certificate, reference.certificate));
      }
    }
  };
  for (int i = 0; i < 4; ++i) {
    const sim::Model model = model_for_packs(random);
    // 149 and 151 are prime: the last pack and the last task are not full.
    compare([&](const auto& batch) { return sim::xy_curve(model, ratios(4.0, 100.0, 149), {}, batch); });
    compare([&](const auto& batch) { return sim::frequency_response(model, ratios(0.05, 10.0, 151), {}, batch); });
    compare([&](const auto& batch) {
      return sim::regime_map(model, ratios(0.1, 3.0, 13), ratios(4.0, 100.0, 17), {}, batch);
    });
  }
}

TEST_CASE("a point found in a pack brings its certificate, and a closure that packs do not reach is the engine's") {
  sim::Model model = unit_model(0.2);
  model.excitation.frequency = 1.0;
  model.excitation.amplitude = 10.0;
  const std::vector<double> amplitudes = {10.0};
  const auto orbits = sim::sliding_orbits(*sim::batch_of(model, 1));
  REQUIRE(orbits.front().has_value());
  CHECK(orbits.front()->certificate.searches > 0);
  CHECK(orbits.front()->certificate.panels >= orbits.front()->certificate.searches);
  CHECK(same(sim::xy_curve(model, amplitudes).certificate, orbits.front()->certificate));

  const sim::SteadyStateOptions closer{.tolerance = 5e-15, .detail = sim::OrbitDetail::extremes};
  const sim::Curve curve = sim::xy_curve(model, amplitudes, closer);
  const sim::SteadyState state = sim::steady_state(model, closer);
  CHECK(same_bits(curve.points.front().x, state.amplitude));
  CHECK(same(curve.certificate, state.certificate));
}

TEST_CASE("reasons and warnings of many points are kept once, with their number and first point") {
  // Undamped at resonance: friction of 1 N limits the motion up to Y = 4/pi, and a small drive never moves the
  // mass. The motion grows for the same reason however long it is integrated.
  const std::vector<double> amplitudes = {0.5, 2.0, 0.9, 1.3, 1.2, 9.0};
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

TEST_CASE("a map tells what the mass does, by its speed where no law holds it") {
  using sim::Regime;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 1.5};
  const std::vector<double> amplitudes = {1.5, 6.0};
  model.friction.emplace_back(friction::Coulomb(1.0, 1.0));
  const sim::Curve rigid = sim::regime_map(model, {1.5}, {0.9, 1.5, 6.0});
  CHECK(rigid.points[0].regime() == Regime::never_moves);
  CHECK(rigid.points[1].regime() == Regime::sticks);
  CHECK(rigid.points[1].sticks == 2);
  CHECK(rigid.points[2].regime() == Regime::slides_through);
  // A contact so stiff that the mass nearly sticks where it would under rigid friction.
  model.friction = {friction::Law(friction::ContactCompliance(1.0, 1.0, 1e7, 300.0))};
  const sim::Curve compliant = sim::regime_map(model, {1.5}, amplitudes);
  CHECK(compliant.points[0].regime() == Regime::sticks);
  CHECK(compliant.points[0].sticks == 2);
  CHECK(compliant.points[1].regime() == Regime::slides_through);
  // Resonance that nothing limits.
  model.oscillator.damping = 0.0;
  model.friction = {friction::Law(friction::Coulomb(0.5, 0.5))};
  const sim::Curve growing = sim::regime_map(model, {1.0}, {1.0});
  CHECK(growing.points[0].regime() == Regime::no_steady_state);
  CHECK(sim::name_of(Regime::no_steady_state) == "no steady state");
}
