#include "identify/uncertainty/random_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "identify/models/sampled_oscillator.hpp"
#include "identify/records/sensors.hpp"
#include "identify/records/signals.hpp"
#include "identify/statistics/noise_level.hpp"
#include "identify/uncertainty/synthetic_record.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::uint32_t stretch_stream = 100;  // beside those of the sensors
constexpr std::uint32_t kick_stream = 101;

double samples_of(const RandomResponse& response, double periods) {
  return periods * core::two_pi / response.law.natural_frequency() * response.measured.sample_rate;
}

std::size_t length_of(const RandomResponse& response) {
  constexpr double most_periods = 2000.0;
  return std::min(response.measured.x.size(), static_cast<std::size_t>(samples_of(response, most_periods)));
}

/// Adds stretches of the recorded drive under half-sine windows. Two overlap at a time; their squares add up to
/// one.
void add_stretches(const RandomResponse& response, const core::RandomStream& random, History& drawn) {
  constexpr double periods = 0.5;
  const std::size_t available = response.measured.x.size();
  const std::size_t half = std::min(static_cast<std::size_t>(0.5 * samples_of(response, periods)), available / 4);
  const std::size_t length = drawn.x.size();
  std::uint64_t draw = 0;
  for (std::size_t middle = 0; middle < length + half; middle += half) {
    const auto from = static_cast<std::size_t>(random.uniform(draw++) * static_cast<double>(available - 2 * half));
    const double sign = random.uniform(draw++) < 0.5 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < 2 * half; ++i) {
      const std::size_t at = middle + i;  // counted from half a stretch before the record
      if (at < half || at - half >= length) continue;
      const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(2 * half);
      const double weight = sign * std::sin(std::numbers::pi * part);
      if (!drawn.y.empty()) drawn.y[at - half] += weight * response.measured.y[from + i];
      if (!drawn.force.empty()) drawn.force[at - half] += weight * response.measured.force[from + i];
    }
  }
}

bool moves(const std::vector<double>& signal) {
  return std::ranges::any_of(signal, [](double value) { return value != 0.0; });
}

/// Motion under the drive of `history`; x is empty if the motion is too fast for the sample rate.
void respond(const ForceParameters& law, double x0, double v0, History& history) {
  Eigen::VectorXd x;
  Eigen::VectorXd v;
  const bool followed = SampledOscillator(history).run({law.m, law.c, law.k, law.F0, x0, v0}, {}, x, nullptr, &v);
  history.x = followed ? std::vector<double>(x.begin(), x.end()) : std::vector<double>{};
  history.v = followed ? std::vector<double>(v.begin(), v.end()) : std::vector<double>{};
}

/// Motion under white acceleration, by Euler's method with the new velocity. Friction stops the mass, but does not
/// drive it.
void respond_to_kicks(const RandomResponse& response, const core::RandomStream& random, double x, double v,
                      History& history) {
  const ForceParameters& law = response.law;
  constexpr double angle = 0.02;
  const double interval = 1.0 / history.sample_rate;
  const int steps = static_cast<int>(std::ceil(law.natural_frequency() * interval / angle));
  const double dt = interval / steps;
  const double kick = std::sqrt(response.intensity * dt);
  const double brake = law.F0 / law.m * dt;
  std::uint64_t draw = 0;
  for (std::size_t i = 0; i < history.x.size(); ++i) {
    history.x[i] = x;
    history.v[i] = v;
    for (int step = 0; step < steps; ++step) {
      v += dt * (-law.k * x - law.c * v) / law.m + kick * random.normal(draw++);
      v -= std::clamp(v, -brake, brake);
      x += dt * v;
    }
  }
}

}  // namespace

double RandomResponse::share() const {
  return static_cast<double>(length_of(*this)) / static_cast<double>(measured.x.size());
}

Record RandomResponse::record(int number) const {
  const std::uint64_t seed = seed_of({{1, &measured}}) + static_cast<std::uint64_t>(number);
  const double v0 = measured.v.empty() ? 0.0 : measured.v.front();
  History history;
  history.sample_rate = measured.sample_rate;
  history.x.resize(length_of(*this));
  history.v.resize(history.x.size());
  if (moves(measured.y)) history.y.resize(history.x.size());
  if (moves(measured.force)) history.force.resize(history.x.size());
  if (history.has_drive()) {
    add_stretches(*this, {seed, stretch_stream}, history);
    respond(law, measured.x.front(), v0, history);
  } else {
    respond_to_kicks(*this, {seed, kick_stream}, measured.x.front(), v0, history);
  }
  Sensors sensors;
  sensors.x.noise = noise_level(measured.x);
  if (measured.v.empty())
    history.v.clear();
  else
    sensors.v.noise = noise_level(measured.v);
  Record record;
  record.histories.push_back(std::move(history));
  return read(record, sensors, seed);
}

}  // namespace dualdamp::identify
