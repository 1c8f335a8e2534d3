#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "identify/records/sensors.hpp"

using namespace dualdamp::identify;

namespace {

constexpr double true_phase = 1.2;

Record one_pair() {
  Record record;
  record.pairs.emplace().pairs = {{.Y = 5e-3,
                                   .x = 8e-3,
                                   .sweep = "1",
                                   .number = 7,
                                   .omega = 38.0,
                                   .phase = true_phase,
                                   .fundamental = 7.9e-3,
                                   .mean_square_speed = 0.04}};
  return record;
}

Record one_history(std::size_t size) {
  Record record;
  History history{.sample_rate = 1000.0};
  for (std::size_t i = 0; i < size; ++i) {
    const double angle = 0.04 * static_cast<double>(i);
    history.y.push_back(5e-3 * std::cos(angle));
    history.x.push_back(8e-3 * std::sin(angle));
  }
  record.histories = {history};
  return record;
}

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};

Moments moments(const std::vector<double>& values) {
  Moments result;
  for (const double value : values) result.mean += value / static_cast<double>(values.size());
  for (const double value : values) result.deviation += std::pow(value - result.mean, 2);
  result.deviation = std::sqrt(result.deviation / static_cast<double>(values.size() - 1));
  return result;
}

/// A number of the pair over seeds 0 to 3999: mean and deviation are known to 1.6 % and 1.1 % of the deviation.
constexpr int seeds = 4000;

Moments over_seeds(const Sensors& sensors, double Pair::* number) {
  std::vector<double> values;
  const Record exact = one_pair();
  for (int seed = 0; seed < seeds; ++seed)
    values.push_back(read(exact, sensors, static_cast<std::uint64_t>(seed)).pairs->pairs[0].*number);
  return moments(values);
}

}  // namespace

TEST_CASE("perfect sensors read what is there") {
  Record exact = one_pair();
  exact.histories = one_history(50).histories;
  exact.decay = DecayRecord{{0.01, -0.008, 0.006}, {0.0, 0.1, 0.2}};
  const Record record = read(exact, {}, 3);
  const Pair& pair = record.pairs->pairs[0];
  CHECK(pair.Y == 5e-3);
  CHECK(pair.x == 8e-3);
  CHECK(pair.sweep == "1");
  CHECK(pair.number == 7);
  CHECK(pair.phase == true_phase);
  CHECK(pair.fundamental == 7.9e-3);
  CHECK(pair.mean_square_speed == Approx(0.04).epsilon(1e-15));
  CHECK(record.histories[0].x == exact.histories[0].x);
  CHECK(record.decay->extremes == exact.decay->extremes);
}

TEST_CASE("averaging over periods takes noise off an amplitude by the root of twice their number") {
  for (const int periods : {1, 12}) {
    Sensors sensors{.average_cycles = periods};
    sensors.x.noise = 1e-4;
    const double expected = 1e-4 / std::sqrt(2.0 * periods);
    const Moments x = over_seeds(sensors, &Pair::x);
    CHECK(std::abs(x.mean - 8e-3) < 4.0 * expected / std::sqrt(seeds));
    CHECK(x.deviation == Approx(expected).epsilon(0.05));
    // A zero crossing of x is late by noise / (w x), an angle of noise / x.
    const Moments phase = over_seeds(sensors, &Pair::phase);
    CHECK(phase.deviation == Approx(1e-4 / 8e-3 / std::sqrt(periods)).epsilon(0.05));
    CHECK(over_seeds(sensors, &Pair::Y).deviation < 1e-12 * 5e-3);
  }
}

TEST_CASE("resolution, gain and clipping act on a reading") {
  Sensors sensors;
  sensors.x.resolution = 3e-6;
  const double x = read(one_pair(), sensors, 0).pairs->pairs[0].x;
  CHECK(x == 3e-6 * std::round(8e-3 / 3e-6));
  sensors = {};
  sensors.y.gain_error = 0.02;
  CHECK(read(one_pair(), sensors, 0).pairs->pairs[0].Y == Approx(5.1e-3).epsilon(1e-14));
  sensors = {};
  sensors.x.offset = 1e-3;
  CHECK(read(one_pair(), sensors, 0).pairs->pairs[0].x == Approx(8e-3).epsilon(1e-14));
  CHECK(read(one_history(200), sensors, 0).histories[0].x[7] ==
        Approx(one_history(200).histories[0].x[7] + 1e-3).epsilon(1e-14));
  sensors = {};
  sensors.x.clipping = 6e-3;
  CHECK(read(one_pair(), sensors, 0).pairs->pairs[0].x == 6e-3);
  const Record clipped = read(one_history(200), sensors, 0);
  double largest = 0.0;
  for (const double value : clipped.histories[0].x) largest = std::max(largest, std::abs(value));
  CHECK(largest == 6e-3);
}

TEST_CASE("the gain drifts over a record, and one reading of some is off") {
  const auto readings_of = [](const Sensors& sensors) {
    Record record = one_pair();
    record.pairs->pairs.assign(11, record.pairs->pairs[0]);
    std::vector<double> ratios;
    const Record found = read(record, sensors, 0);
    for (const Pair& pair : found.pairs->pairs) ratios.push_back(pair.x / 8e-3 - 1.0);
    return ratios;
  };
  Sensors sensors;
  sensors.x.gain_drift = 0.05;
  const std::vector<double> drift = readings_of(sensors);
  for (std::size_t i = 0; i < drift.size(); ++i)
    CHECK(drift[i] == Approx(0.005 * static_cast<double>(i)).margin(1e-14));
  sensors = {};
  sensors.x.outlier_every = 5;
  sensors.x.outlier_size = -0.3;
  const std::vector<double> outliers = readings_of(sensors);
  for (std::size_t i = 0; i < outliers.size(); ++i)
    CHECK(outliers[i] == Approx(i == 2 || i == 7 ? -0.3 : 0.0).margin(1e-14));
  const Record history = read(one_history(200), sensors, 0);
  CHECK(history.histories[0].x[7] == Approx(0.7 * one_history(200).histories[0].x[7]).epsilon(1e-14));
  CHECK(history.histories[0].x[8] == one_history(200).histories[0].x[8]);
}

TEST_CASE("a fine enough step between readings is a noise of step/sqrt(12)") {
  // Averaged over 12 periods whose noise of half a step spreads the readings over the steps.
  Sensors sensors{.average_cycles = 12};
  sensors.x.resolution = 1e-4;
  sensors.x.noise = 5e-5;
  const double one = std::sqrt(5e-5 * 5e-5 + 1e-8 / 12.0);
  CHECK(over_seeds(sensors, &Pair::x).deviation == Approx(one / std::sqrt(24.0)).epsilon(0.05));
}

TEST_CASE("lags add to the phase of x behind y") {
  Sensors sensors;
  sensors.x.delay = 2e-3;
  sensors.y.phase_lag = 0.05;
  CHECK(read(one_pair(), sensors, 0).pairs->pairs[0].phase ==
        Approx(true_phase + 38.0 * 2e-3 - 0.05).epsilon(1e-14));
  sensors.y.phase_lag = 2.0;
  const double around = true_phase + 38.0 * 2e-3 - 2.0 + 2.0 * std::numbers::pi;
  CHECK(read(one_pair(), sensors, 0).pairs->pairs[0].phase == Approx(around).epsilon(1e-14));
}

TEST_CASE("readings depend on seed, signal and number alone") {
  Sensors sensors;
  sensors.x.noise = 1e-4;
  const Record exact = one_history(1000);
  const std::vector<double> x = read(exact, sensors, 5).histories[0].x;
  CHECK(x == read(exact, sensors, 5).histories[0].x);
  CHECK(x != read(exact, sensors, 6).histories[0].x);
  sensors.y.noise = 1e-4;
  const Record both = read(exact, sensors, 5);
  CHECK(both.histories[0].x == x);
  std::vector<double> errors;
  double product = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    errors.push_back(x[i] - exact.histories[0].x[i]);
    product += errors.back() * (both.histories[0].y[i] - exact.histories[0].y[i]);
  }
  CHECK(moments(errors).deviation == Approx(1e-4).epsilon(0.1));
  // 1000 products of independent errors: their sum is known to sqrt(1000) of one.
  CHECK(std::abs(product) < 4.0 * std::sqrt(1000.0) * 1e-8);
}

TEST_CASE("what was not measured stays unknown") {
  Record exact = one_pair();
  Pair& pair = exact.pairs->pairs[0];
  pair.phase = pair.fundamental = pair.mean_square_speed = pair.omega = unknown;
  Sensors sensors;
  sensors.x.noise = sensors.v.noise = 1e-4;
  const Pair result = read(exact, sensors, 1).pairs->pairs[0];
  CHECK(std::isnan(result.phase));
  CHECK(std::isnan(result.fundamental));
  CHECK(std::isnan(result.mean_square_speed));
  CHECK(result.x != 8e-3);
}
