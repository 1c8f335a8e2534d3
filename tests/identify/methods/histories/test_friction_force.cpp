#include "identify/methods/histories/friction_force.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "friction_models/laws/contact_compliance.hpp"
#include "tests/identify/estimates.hpp"
#include "tests/identify/histories.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double omega = 38.79;  // wn of the bearing

/// Four seconds of the steady state.
History steady(double rate = 2000.0, double Y = 4e-3) {
  return sampled(driven_bearing(bearing_c, bearing_F0, Y), 4.0, rate, 3.0);
}

Estimate estimate_of(const History& history, const RegressionOptions& options = {}) {
  const Estimate e = friction_force(record_of({history}), bearing_constants, options);
  REQUIRE(e.outcome.ok());
  return e;
}

/// The signal `samples` later: s(t) becomes s(t - samples/rate).
std::vector<double> delayed(const std::vector<double>& signal, std::size_t samples) {
  std::vector<double> late(signal.size(), signal.front());
  std::copy(signal.begin(), signal.end() - static_cast<std::ptrdiff_t>(samples),
            late.begin() + static_cast<std::ptrdiff_t>(samples));
  return late;
}

}  // namespace

TEST_CASE("Exact signals give the friction to rounding, and the curves") {
  const Estimate e = estimate_of(steady());
  CHECK(e.usable);
  CHECK(e.value.c == Approx(bearing_c).epsilon(1e-11));
  CHECK(e.value.F0 == Approx(bearing_F0).epsilon(1e-11));
  REQUIRE(e.curves.size() == 2);
  const EstimateCurve& curve = e.curves[0];
  for (std::size_t i = 0; i < curve.columns[0].values.size(); ++i) {
    const double v = curve.columns[0].values[i];
    if (std::abs(v) < 1e-6) continue;
    REQUIRE(curve.columns[1].values[i] == Approx(bearing_c * v + std::copysign(bearing_F0, v)).epsilon(1e-9));
  }
}

TEST_CASE("Work of the friction in a period is 4 F0 x + c int v^2 dt") {
  const History history = steady();
  const Estimate e = estimate_of(history);
  double square = 0.0;
  for (const double v : history.v) square += v * v / static_cast<double>(history.v.size());
  const auto [low, high] = std::minmax_element(history.x.begin(), history.x.end());
  const double period = 2.0 * std::numbers::pi / omega;
  // Sums of samples that do not end with the period: a part in a hundred of a period in 25.
  CHECK(further(e, "loop_area").value ==
        Approx(2.0 * bearing_F0 * (*high - *low) + bearing_c * square * period).epsilon(5e-3));
}

TEST_CASE("The paper's velocity biases c by some tenths of a per cent") {
  History history = steady(1000.0);
  history.v.clear();  // central difference and five-point average
  const Estimate e = estimate_of(history);
  CHECK(e.usable);
  CHECK(std::abs(e.value.c / bearing_c - 1.0) < 0.01);
  CHECK(std::abs(e.value.F0 / bearing_F0 - 1.0) < 0.002);
}

TEST_CASE("Delays bias c by -m w^2 t and +k t, and alike delays cancel at resonance") {
  // First order in the delay t and for a harmonic motion: the jerk is -w^2 v beside parts that are odd about the
  // middle of a swing. At 10 mm of base motion that holds to some per cent; at 4 mm dry friction bends the swing,
  // and a late acceleration biases c nearly twice as much. Beyond the least speed no jump is met.
  RegressionOptions options;
  options.least_speed = 0.1;
  const std::size_t samples = 1;
  const double delay = static_cast<double>(samples) / 2000.0;
  const double shift = 1568.0 * delay;  // m w^2 = k at resonance
  const History exact = steady(2000.0, 10e-3);
  History late_a = exact;
  late_a.a = delayed(late_a.a, samples);
  History late_x = exact;
  late_x.x = delayed(late_x.x, samples);
  History both = late_x;
  both.a = late_a.a;
  CHECK(estimate_of(late_a, options).value.c - bearing_c == Approx(-shift).epsilon(0.2));
  CHECK(estimate_of(late_x, options).value.c - bearing_c == Approx(shift).epsilon(0.1));
  CHECK(std::abs(estimate_of(both, options).value.c - bearing_c) < 0.15 * shift);
  History late_y = steady();
  late_y.y = delayed(late_y.y, samples);
  options.least_speed = 0.01;
  // A late base motion takes from the friction: about 1.2 % for half a millisecond.
  CHECK(estimate_of(late_y, options).value.F0 / bearing_F0 - 1.0 == Approx(-0.012).margin(0.006));
}

TEST_CASE("A gain error of the acceleration leaves c and F0 and opens a false loop") {
  const double error = 0.03;
  History history = steady();
  for (double& a : history.a) a *= 1.0 + error;
  const Estimate e = estimate_of(history);
  // In phase with x, so orthogonal to v and sgn v over whole periods.
  CHECK(e.value.c == Approx(bearing_c).epsilon(2e-3));
  CHECK(e.value.F0 == Approx(bearing_F0).epsilon(2e-3));
  CHECK_FALSE(e.usable);
  CHECK(e.reason.find("displacement") != std::string::npos);
  REQUIRE(e.lack_of_fit);
  CHECK(e.lack_of_fit->fired);
  const Estimate sound = estimate_of(steady());
  CHECK_FALSE(sound.lack_of_fit->fired);
}

TEST_CASE("A compliant contact shows its stiffness after each reversal, and its transition velocity") {
  const double stiffness = 11.6e4;
  sim::Model model = driven_bearing(bearing_c, bearing_F0, 4e-3);
  model.friction.clear();
  model.friction.emplace_back(friction::ContactCompliance(bearing_F0, bearing_F0, stiffness, 0.0));
  const History history = sampled(model, 4.0, 4000.0, 3.0);
  const Estimate e = estimate_of(history);
  CHECK(e.usable);
  CHECK(e.value.F0 == Approx(bearing_F0).epsilon(1e-6));
  CHECK(further(e, "contact_stiffness").value == Approx(stiffness).epsilon(0.01));
  // Eq (18) takes the motion near its turn for harmonic, and a sample is 2 % of the transition.
  const auto [low, high] = std::minmax_element(history.x.begin(), history.x.end());
  const double X = 0.5 * (*high - *low);
  const double inner = X - 2.0 * bearing_F0 / stiffness;
  CHECK(further(e, "transition_velocity").value == Approx(omega * std::sqrt(X * X - inner * inner)).epsilon(0.1));
  CHECK(further(e, "stiffness_from_transition").value == Approx(stiffness).epsilon(0.2));
}

TEST_CASE("A friction force without mass, stiffness or speed is refused") {
  const Record record = record_of({steady()});
  CHECK(friction_force(record, {unknown, 1568.0}, {}).reason == "the method needs the mass");
  CHECK(friction_force(record, {1.042, unknown}, {}).reason == "the method needs the stiffness");
  RegressionOptions options;
  options.least_speed = 10.0;
  CHECK_FALSE(friction_force(record, bearing_constants, options).outcome.ok());
}
