#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "scenarios/measurements/measure.hpp"
#include "sim/motion/simulate.hpp"

using namespace dualdamp;
using scenarios::Measurement;
using scenarios::MeasurementKind;

namespace {

constexpr double F0 = 4.39;  // N

std::vector<friction::Law> coulomb(double level) { return {friction::Law(friction::Coulomb(level, level))}; }

sim::Model rig() {
  sim::Model model;
  model.oscillator = {.mass = 1.042, .stiffness = 1568.0, .damping = 8.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 5e-3, .frequency = 38.79};
  model.friction = coulomb(F0);
  return model;
}

Measurement histories(double settle, double duration) {
  Measurement measurement;
  measurement.kind = MeasurementKind::histories;
  measurement.settle = settle;
  measurement.duration = duration;
  return measurement;
}

}  // namespace

TEST_CASE("friction times a factor is the motion of stronger friction", "[measure]") {
  // By the equation of motion; the engines round differently.
  const double factor = 1.3;
  sim::Model stronger = rig();
  stronger.friction = coulomb(factor * F0);
  sim::Model force = stronger;
  force.excitation.type = sim::ExcitationType::force_harmonic;
  force.excitation.amplitude = 8.0;
  force.excitation.offset = 1.0;
  for (const sim::Model& expected : {stronger, force}) {
    sim::Model model = expected;
    model.friction = coulomb(F0);
    const sim::SteadyState scaled = sim::steady_state(scenarios::with_friction_times(factor, model));
    const sim::SteadyState steady = sim::steady_state(expected);
    REQUIRE(scaled.outcome.ok());
    CHECK(std::abs(scaled.amplitude - steady.amplitude) < 1e-12 * steady.amplitude);
    CHECK(std::abs(scaled.phase - steady.phase) < 1e-11);
    CHECK(std::abs(scaled.mean_square_speed - steady.mean_square_speed) < 1e-11 * steady.mean_square_speed);
  }
}

TEST_CASE("exact pairs balance their energy", "[measure]") {
  // pi k Y X1 sin(phase) = 4 F x + c int v^2, exact where the mass turns twice a period.
  Measurement measurement;
  measurement.amplitudes = {5e-3, 6.5e-3};
  measurement.frequencies = {36.0, 38.79, 41.0};
  const scenarios::MotionRecord motion = scenarios::motion_of(rig(), measurement, {});
  REQUIRE(motion.warnings.empty());
  const std::vector<identify::Pair>& pairs = motion.exact.pairs->pairs;
  REQUIRE(pairs.size() == 6);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const identify::Pair& pair = pairs[i];
    CHECK(pair.number == static_cast<int>(i) + 1);
    CHECK(pair.omega == measurement.frequencies[i / 2]);
    CHECK(pair.Y == measurement.amplitudes[i % 2]);
    const double input = std::numbers::pi * 1568.0 * pair.Y * pair.fundamental * std::sin(pair.phase);
    const double square = pair.mean_square_speed * 2.0 * std::numbers::pi / pair.omega;
    CHECK(std::abs(input - 4.0 * F0 * pair.x - 8.0 * square) < 1e-12 * input);
  }
}

TEST_CASE("sweeps drift as their factors do", "[measure]") {
  Measurement measurement;
  measurement.amplitudes = {5e-3, 6.5e-3};
  measurement.sweeps = 3;
  measurement.drift = {.rate = -0.05, .walk = 0.02, .seed = 9};
  const scenarios::MotionRecord motion = scenarios::motion_of(rig(), measurement, {});
  const std::vector<identify::Pair>& pairs = motion.exact.pairs->pairs;
  REQUIRE(pairs.size() == 6);
  // The definition of the drift, independently of the code; stream 3 of the seed.
  const core::RandomStream draws{.seed = 9, .stream = 3};
  double factor = 1.0;
  for (std::size_t sweep = 0; sweep < 3; ++sweep) {
    for (std::size_t level = 0; level < 2; ++level) {
      const identify::Pair& pair = pairs[2 * sweep + level];
      CHECK(pair.sweep == std::to_string(sweep + 1));
      sim::Model model = rig();
      model.friction = coulomb(factor * F0);
      model.excitation.amplitude = measurement.amplitudes[level];
      CHECK(std::abs(pair.x - sim::steady_state(model).amplitude) < 1e-12 * pair.x);
    }
    factor += -0.05 + 0.02 * draws.normal(sweep);
  }
}

TEST_CASE("histories are samples of the simulated motion, late by the sensors' lag", "[measure]") {
  const double rate = 500.0;
  const double settle = 0.2;
  identify::Sensors sensors{.sample_rate = rate};
  sensors.x.delay = 3.0 / rate;
  sensors.v.phase_lag = 38.79 * 2.0 / rate;
  const scenarios::MotionRecord motion = scenarios::motion_of(rig(), histories(settle, 0.4), sensors);
  REQUIRE(motion.exact.histories.size() == 1);
  const identify::History& history = motion.exact.histories[0];
  CHECK(history.start == settle);
  REQUIRE(history.x.size() == 201);
  CHECK(history.force.empty());
  const sim::History all = sim::simulate(rig(), {.duration = 0.6, .sample_rate = rate});
  // Times are summed in another order; their rounding changes a motion of 0.3 m/s and 15 m/s^2 by no more than
  // this.
  for (std::size_t i = 0; i < history.x.size(); ++i) {
    const std::size_t now = i + 100;
    CHECK(std::abs(history.y[i] - all.samples[now].y) < 1e-14);
    CHECK(std::abs(history.x[i] - all.samples[now - 3].x) < 1e-14);
    CHECK(std::abs(history.v[i] - all.samples[now - 2].v) < 1e-12);
    CHECK(std::abs(history.a[i] - all.samples[now].a) < 1e-9);
  }
}

TEST_CASE("a motion was at its start before it began", "[measure]") {
  identify::Sensors sensors{.sample_rate = 500.0};
  sensors.x.delay = 0.01;
  sim::Model model = rig();
  model.initial = {.position = 2e-3, .velocity = 0.1};
  Measurement measurement = histories(0.0, 0.1);
  measurement.with_a = false;
  const scenarios::MotionRecord motion = scenarios::motion_of(model, measurement, sensors);
  REQUIRE(motion.exact.histories.size() == 1);
  for (std::size_t i = 0; i <= 5; ++i) CHECK(motion.exact.histories[0].x[i] == 2e-3);
  CHECK(motion.exact.histories[0].x[6] > 2e-3);
  CHECK(motion.exact.histories[0].a.empty());
}

TEST_CASE("the force of a force-driven history is the real one, whatever factor friction has", "[measure]") {
  sim::Model model = rig();
  model.excitation = {.type = sim::ExcitationType::force_noise,
                      .noise = {.intensity = 0.05, .bandwidth = 300.0, .seed = 4}};
  Measurement measurement = histories(0.0, 0.5);
  measurement.sweeps = 2;
  measurement.drift.rate = 0.5;
  const scenarios::MotionRecord motion =
      scenarios::motion_of(model, measurement, identify::Sensors{.sample_rate = 400.0});
  REQUIRE(motion.exact.histories.size() == 2);
  const identify::History& first = motion.exact.histories[0];
  const identify::History& second = motion.exact.histories[1];
  CHECK(first.y.empty());
  REQUIRE(first.force.size() == second.force.size());
  for (std::size_t i = 0; i < first.force.size(); ++i)
    CHECK(first.force[i] == Approx(second.force[i]).epsilon(1e-12));
  CHECK(first.x != second.x);
}

TEST_CASE("sampled steady states give the pairs of exact ones", "[measure]") {
  Measurement measurement;
  measurement.amplitudes = {5e-3, 6.5e-3};
  measurement.frequencies = {37.0, 40.0};
  const identify::Sensors sensors{.sample_rate = 2000.0, .average_cycles = 12};
  const scenarios::MotionRecord motion = scenarios::motion_of(rig(), measurement, sensors);
  std::vector<std::string> warnings;
  const identify::Record record = scenarios::reading(motion, sensors, 0, warnings);
  for (const std::string& warning : warnings) UNSCOPED_INFO(warning);
  REQUIRE(record.pairs->pairs.size() == 4);
  REQUIRE(record.histories.size() == 4);
  CHECK(record.histories[0].x.size() == static_cast<std::size_t>(2000.0 * 12 * 2.0 * std::numbers::pi / 37.0) + 2);
  const std::vector<identify::Pair> exact = scenarios::motion_of(rig(), measurement, {}).exact.pairs->pairs;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const identify::Pair& pair = record.pairs->pairs[i];
    CHECK(pair.number == exact[i].number);
    // The part of a Coulomb response beyond nine harmonics (identify/records/derived_records.hpp).
    CHECK(pair.Y == Approx(exact[i].Y).epsilon(1e-9));
    CHECK(pair.x == Approx(exact[i].x).epsilon(1e-3));
    CHECK(pair.phase == Approx(exact[i].phase).epsilon(1e-4));
    CHECK(pair.fundamental == Approx(exact[i].fundamental).epsilon(1e-4));
    CHECK(pair.mean_square_speed == Approx(exact[i].mean_square_speed).epsilon(1e-3));
  }
}

TEST_CASE("what cannot be measured is named once for all its reasons", "[measure]") {
  // Above its breakaway curve negative damping lets the motion grow without bound.
  sim::Model model = rig();
  model.oscillator.damping = -30.0;
  Measurement measurement;
  measurement.amplitudes = {5e-3, 6e-3, 7e-3};
  const scenarios::MotionRecord motion = scenarios::motion_of(model, measurement, {});
  CHECK(motion.exact.pairs->pairs.empty());
  REQUIRE(motion.warnings.size() == 1);
  CHECK(motion.warnings[0].starts_with("pair 1, 2, 3 could not be measured: "));
}
