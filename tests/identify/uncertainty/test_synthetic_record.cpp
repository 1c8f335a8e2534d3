#include "identify/statistics/noise_level.hpp"
#include "identify/uncertainty/synthetic_record.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "identify/models/sampled_oscillator.hpp"
#include "tests/identify/histories.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

const ForceParameters bearing_law{1.042, 11.0, 1568.0, 3.7};

double root_mean_square(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Largest force that the law leaves where the mass moves [N].
double imbalance(const History& history, const ForceParameters& of, double offset) {
  double largest = 0.0;
  for (std::size_t i = 0; i < history.x.size(); ++i) {
    const double v = history.v[i];
    if (v == 0.0) continue;
    const double y = history.y.empty() ? 0.0 : history.y[i];
    const double f = history.force.empty() ? 0.0 : history.force[i];
    const double left =
        of.k * (y - history.x[i]) + f - offset - (of.m * history.a[i] + of.c * v + std::copysign(of.F0, v));
    largest = std::max(largest, std::abs(left));
  }
  return largest;
}

History bearing(double noise, std::uint64_t seed = 3) {
  History history = sampled(driven_bearing(11.0, 3.7, 4e-3), 3.0, 500.0);
  Normal normal(seed);
  for (double& x : history.x) x += noise * normal();
  for (double& y : history.y) y += 0.1 * noise * normal();
  for (double& v : history.v) v += 40.0 * noise * normal();
  for (double& a : history.a) a += 1500.0 * noise * normal();
  return history;
}

SyntheticRecords synthetic_of(const History& history, ForceParameters truth, double offset = 0.0) {
  const std::optional<SyntheticRecords> synthetic = synthetic_records({{1, &history}}, truth, offset);
  REQUIRE(synthetic);
  return *synthetic;
}

}  // namespace

TEST_CASE("A synthetic record obeys the law and lies within the noise of the measured one") {
  const double noise = 5e-5;
  const History measured = bearing(noise);
  const SyntheticRecords synthetic = synthetic_of(measured, bearing_law);
  const History& exact = synthetic.exact.histories.front();
  CHECK(imbalance(exact, bearing_law, 0.0) < 1e-11);  // rounding of forces of 10 N
  // 1,500 samples leave the deviation of their noise with 2 %; that of y moves the mass by less.
  CHECK(root_mean_square(measured.x, exact.x) == Approx(noise).epsilon(0.1));
  CHECK(exact.y == measured.y);
}

TEST_CASE("A synthetic record of a fit begins where the fit begins, and rests where it rests") {
  sim::Model decay = driven_bearing(11.0, 3.7, 0.0);
  decay.excitation = {};
  decay.initial = {20e-3, 0.0};
  Normal normal(5);
  const History measured = displacement_only(sampled(decay, 3.0, 500.0), 1e-4, normal);
  const MotionStart start{20.03e-3, 0.004};
  ForceParameters truth = bearing_law;
  const auto synthetic = synthetic_records({{1, &measured}}, truth, 0.0, {start});
  REQUIRE(synthetic);
  Eigen::VectorXd x;
  REQUIRE(
      SampledOscillator(measured).run({truth.m, truth.c, truth.k, truth.F0, start.x0, start.v0}, {}, x, nullptr));
  const std::vector<double>& exact = synthetic->exact.histories.front().x;
  for (std::size_t i = 0; i < exact.size(); ++i)
    REQUIRE(exact[i] == Approx(x[static_cast<Eigen::Index>(i)]).margin(1e-14));
}

TEST_CASE("The noise of each signal is read beside the synthetic motion, jumps of the acceleration or not") {
  const double noise = 5e-5;
  const SyntheticRecords synthetic = synthetic_of(bearing(noise), bearing_law);
  // Fourth differences of 1,500 samples: 3 %; three of these.
  CHECK(synthetic.sensors.x.noise == Approx(noise).epsilon(0.1));
  CHECK(synthetic.sensors.v.noise == Approx(40.0 * noise).epsilon(0.1));
  CHECK(synthetic.sensors.a.noise == Approx(1500.0 * noise).epsilon(0.1));
  CHECK(synthetic.sensors.y.noise == Approx(0.1 * noise).epsilon(0.1));
  const History drawn = synthetic.record(0).histories.front();
  CHECK(root_mean_square(drawn.x, synthetic.exact.histories.front().x) == Approx(noise).epsilon(0.1));
  CHECK(drawn.x == synthetic.record(0).histories.front().x);
  CHECK(drawn.x != synthetic.record(1).histories.front().x);
  // Signals that were not measured are in no synthetic record.
  History bare = bearing(noise);
  bare.v.clear();
  bare.a.clear();
  const History as_bare = synthetic_of(bare, bearing_law).record(0).histories.front();
  CHECK(as_bare.v.empty());
  CHECK(as_bare.a.empty());
}

TEST_CASE("Readings of a coarse converter are rounded in synthetic records too, with its zero anywhere") {
  // Intervals of `output_error` that left out the rounding held the truth in 15 of 40 decays of 100 steps.
  constexpr double step = 1e-4;
  History measured = bearing(1e-6);
  for (double& x : measured.x) x = step * std::round(x / step);
  const SyntheticRecords synthetic = synthetic_of(measured, bearing_law);
  CHECK(synthetic.sensors.x.resolution == Approx(step));
  CHECK(synthetic.sensors.x.noise < 0.1 * step);
  CHECK(synthetic.sensors.v.resolution == 0.0);
  double sum = 0.0;
  constexpr int records = 20;
  for (int number = 0; number < records; ++number) {
    const std::vector<double> x = synthetic.record(number).histories.front().x;
    const double zero = std::remainder(x.front(), step);
    sum += std::abs(zero);
    for (const double reading : x) REQUIRE(std::abs(std::remainder(reading - zero, step)) < 1e-6 * step);
    CHECK(root_mean_square(x, synthetic.exact.histories.front().x) == Approx(step / std::sqrt(12.0)).epsilon(0.2));
  }
  CHECK(sum / records == Approx(step / 4.0).epsilon(0.4));
}

TEST_CASE("A drive that is rough is not taken for a noisy one") {
  // A random base motion has as much at high frequency as noise would; a record without noise says that it is none.
  sim::Model model = driven_bearing(11.0, 3.7, 0.0);
  model.excitation = {};
  model.excitation.type = sim::ExcitationType::force_noise;
  model.excitation.noise = {.intensity = 2.0, .bandwidth = 380.0, .seed = 1};
  History history = sampled(model, 20.0, 200.0);
  history.v.clear();
  history.a.clear();
  // What is left is the kinks of the drive, which the polynomials between its samples miss.
  CHECK(synthetic_of(history, bearing_law).sensors.force.noise < 0.3 * noise_level(history.force));
}

TEST_CASE("A mass without spring is held to its record by a force that the synthetic record knows") {
  // 10 kg under a force of 20 N at 1 Hz, simulated with the estimated friction 5 % off: without being held it
  // drifts.
  const ForceParameters rail{10.0, 15.0, 0.0, 4.0};
  History measured;
  measured.sample_rate = 500.0;
  double x = 0.0;
  double v = 0.0;
  constexpr int steps = 20;
  const double dt = 1.0 / (measured.sample_rate * steps);
  for (int i = 0; i < 5000; ++i) {
    const double force = 20.0 * std::sin(2.0 * 3.14159265358979 * i / measured.sample_rate);
    measured.x.push_back(x);
    measured.force.push_back(force);
    for (int step = 0; step < steps; ++step) {
      v += dt * (force - rail.c * v) / rail.m;
      const double brake = dt * rail.F0 / rail.m;
      v -= std::abs(v) > brake ? std::copysign(brake, v) : v;
      x += dt * v;
    }
  }
  ForceParameters off = rail;
  off.c *= 1.05;
  const SyntheticRecords synthetic = synthetic_of(measured, off, 0.2);
  History exact = synthetic.exact.histories.front();
  const std::vector<double> none(exact.x.size(), 0.0);
  CHECK(root_mean_square(measured.x, exact.x) < 0.05 * root_mean_square(measured.x, none));
  // Of the order of what 5 % of the damping and the offset lack.
  CHECK(root_mean_square(measured.force, exact.force) < 0.5);
  CHECK(root_mean_square(measured.force, exact.force) > 0.05);
}

TEST_CASE("Friction that drives counts as none, and a law that cannot move so gives no synthetic record") {
  const History measured = bearing(0.0);
  // 44 N.s/m alone take as much energy from this motion: k Y = c w X + 4 F0/pi at resonance.
  ForceParameters driving = bearing_law;
  driving.c = 44.0;
  driving.F0 = -0.1;
  CHECK(synthetic_records({{1, &measured}}, driving, 0.0));
  CHECK(driving.F0 == 0.0);
  ForceParameters stuck = bearing_law;
  stuck.F0 = 1e4;
  CHECK_FALSE(synthetic_records({{1, &measured}}, stuck, 0.0));
}
