#include "bench/speed/steady_states.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "bench/speed/smooth_case.hpp"
#include "bench/speed/timing.hpp"
#include "sim/batch/batch.hpp"
#include "sim/curves/curves.hpp"
#include "sim/orbits/batch_steady_states.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::bench::speed {
namespace {

sim::OscillatorBatch around(const StandardCase& work, int count) {
  std::mt19937_64 bits(1);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(bits);
  };
  const double natural = std::sqrt(work.stiffness / work.mass);
  sim::OscillatorBatch batch;
  for (int i = 0; i < count; ++i) {
    const double friction = between(0.01, 0.3) * work.stiffness * work.base_amplitude;
    batch.mass.push_back(work.mass);
    batch.damping.push_back(between(0.05, 0.35) * 2.0 * work.mass * natural);
    batch.stiffness.push_back(work.stiffness);
    batch.kinetic.push_back(friction);
    batch.static_level.push_back(friction);
    batch.amplitude.push_back(work.base_amplitude);
    batch.frequency.push_back(between(0.7, 1.3) * natural);
  }
  return batch;
}

/// Input amplitudes from `first` to 10 times F0/k [m].
std::vector<double> amplitudes_from(double first, const StandardCase& work, int count) {
  std::vector<double> amplitudes;
  for (int i = 0; i < count; ++i)
    amplitudes.push_back((first + (10.0 - first) * i / (count - 1)) * work.friction / work.stiffness);
  return amplitudes;
}

/// Processor seconds on one core; `is_sound`: check of the curve.
double seconds_for_curve(const sim::Model& model, const std::vector<double>& amplitudes, int batches,
                         bool (*is_sound)(const sim::Curve&)) {
  bool sound = true;
  const std::function<void(int)> compute = [&](int times) {
    for (int i = 0; i < times; ++i) sound = sound && is_sound(sim::xy_curve(model, amplitudes, {}, {.threads = 1}));
  };
  const double median = time_alternately(std::span(&compute, 1), batches, 0.1).front().median;
  if (!sound) throw std::runtime_error("the x-Y curve is not what it should be");
  return median;
}

}  // namespace

double seconds_for_steady_state(const StandardCase& work) {
  sim::Model model = model_of(work);
  model.initial = {};
  double sink = 0.0;
  const std::function<void(int)> find = [&](int times) {
    for (int i = 0; i < times; ++i) sink += sim::steady_state(model).amplitude;
  };
  const double median = time_alternately(std::span(&find, 1), 9, 0.02).front().median;
  if (!std::isfinite(sink)) throw std::runtime_error("the standard case has no steady state");
  return median;
}

double seconds_for_curve(const StandardCase& work, int count) {
  sim::Model model = model_of(work);
  model.initial = {};
  return seconds_for_curve(model, amplitudes_from(1.05, work, count), 9, [](const sim::Curve& curve) {
    return curve.points.front().sticks > 0 && curve.points.back().sticks == 0;
  });
}

double seconds_for_smooth_curve(int count) {
  const sim::Model model = model_under("lugre", lugre_values());
  return seconds_for_curve(model, amplitudes_from(1.5, {}, count), 3, [](const sim::Curve& curve) {
    return std::ranges::all_of(curve.points, &sim::CurvePoint::ok);
  });
}

double steady_states_per_second(const StandardCase& work, int count) {
  using Clock = std::chrono::steady_clock;
  const sim::OscillatorBatch batch = around(work, count);
  std::vector<double> times;
  for (int run = 0; run < 7; ++run) {
    const Clock::time_point begin = Clock::now();
    const sim::BatchSteadyStates states = sim::steady_states(batch);
    times.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    if (std::count(states.stops.begin(), states.stops.end(), 0) != count)
      throw std::runtime_error("an oscillator of the batch sticks");
  }
  return count / quartiles(std::move(times)).median;
}

}  // namespace dualdamp::bench::speed
