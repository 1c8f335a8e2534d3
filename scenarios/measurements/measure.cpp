#include "scenarios/measurements/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/random.hpp"
#include "identify/records/derived_records.hpp"
#include "sim/engine/engine.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::History;
using identify::Pair;

/// A stream other than those of laws, excitations and sensors with the same seed.
constexpr std::uint32_t drift_stream = 3;

std::vector<double> friction_factors(const FrictionDrift& drift, int sweeps) {
  const core::RandomStream draws{.seed = drift.seed, .stream = drift_stream};
  // Smallest factor, for a friction that would vanish.
  constexpr double least = 1e-3;
  std::vector<double> factors;
  double walked = 0.0;
  for (int j = 0; j < sweeps; ++j) {
    factors.push_back(std::max(least, 1.0 + drift.rate * j + drift.walk * walked));
    walked += draws.normal(static_cast<std::uint64_t>(j));
  }
  return factors;
}

/// One motion to be measured.
struct Test {
  sim::Model model;
  double friction = 1.0;  ///< factor of its friction
  int number = 0;         ///< from 1
  std::string sweep;
};

/// All amplitudes at the first frequency, then at the next, and so on; all this for each sweep.
std::vector<Test> tests_of(const sim::Model& model, const Measurement& measurement) {
  const auto or_own = [](const std::vector<double>& values, double own) {
    return values.empty() ? std::vector<double>{own} : values;
  };
  std::vector<Test> tests;
  const std::vector<double> factors = friction_factors(measurement.drift, measurement.sweeps);
  for (std::size_t j = 0; j < factors.size(); ++j) {
    for (const double omega : or_own(measurement.frequencies, model.excitation.frequency)) {
      for (const double amplitude : or_own(measurement.amplitudes, model.excitation.amplitude)) {
        sim::Model driven = model;
        driven.excitation.frequency = omega;
        driven.excitation.amplitude = amplitude;
        tests.push_back({with_friction_times(factors[j], std::move(driven)), factors[j],
                         static_cast<int>(tests.size()) + 1, factors.size() > 1 ? std::to_string(j + 1) : ""});
      }
    }
  }
  return tests;
}

std::string label_of(const Test& test) {
  return (test.sweep.empty() ? "" : test.sweep + "/") + std::to_string(test.number);
}

/// Samples delayed signals, each with its own lag, from a stream of intervals.
class Recorder {
 public:
  /// From `begin` [s] on, `count` > 0 samples at `rate` [Hz]; a motion starts at 0; before that it has its initial
  /// values.
  Recorder(const identify::Sensors& sensors, double omega, double begin, double rate, std::size_t count)
      : begin_(begin), rate_(rate), count_(count) {
    const std::array<const identify::Sensor*, signals> order = {&sensors.y, &sensors.x, &sensors.v, &sensors.a,
                                                                &sensors.force};
    for (std::size_t i = 0; i < signals; ++i) {
      const double lag = order[i]->lag(omega);
      const auto known = std::ranges::find(series_, lag, &Series::lag);
      series_of_[i] = static_cast<std::size_t>(known - series_.begin());
      if (known == series_.end()) series_.push_back({lag, {}});
    }
    for (Series& series : series_) series.samples.reserve(count);
  }

  /// Time after which no sample is missing [s]; a sample at the end of an interval belongs to the next one.
  [[nodiscard]] double end() const {
    constexpr double beyond_rounding = 1e-3;
    return time(count_ - 1) - std::ranges::min_element(series_, {}, &Series::lag)->lag + beyond_rounding / rate_;
  }
  [[nodiscard]] double longest_lag() const { return std::ranges::max_element(series_, {}, &Series::lag)->lag; }
  void delay_begin(double s) { begin_ += s; }

  void observe(const sim::Interval& interval) {
    for (auto& [lag, samples] : series_) {
      while (samples.size() < count_) {
        const double t = std::max(time(samples.size()) - lag, 0.0);
        if (t >= interval.end()) break;
        samples.push_back(interval.state_at(std::max(t, interval.begin)));
      }
    }
  }

  [[nodiscard]] bool complete() const {
    return std::ranges::all_of(series_, [&](const Series& series) { return series.samples.size() == count_; });
  }

  [[nodiscard]] History history(const Test& test, const Measurement& measurement) const {
    History history{.start = begin_, .sample_rate = rate_, .sweep = label_of(test)};
    const sim::Excitation& excitation = test.model.excitation;
    if (excitation.moves_base()) history.y = signal(0, &sim::Sample::y);
    history.x = signal(1, &sim::Sample::x);
    if (measurement.with_v) history.v = signal(2, &sim::Sample::v);
    if (measurement.with_a) history.a = signal(3, &sim::Sample::a);
    if (excitation.type != sim::ExcitationType::none && !excitation.moves_base()) {
      history.force = signal(4, &sim::Sample::external);
      for (double& force : history.force) force *= test.friction;
    }
    return history;
  }

 private:
  static constexpr std::size_t signals = 5;
  struct Series {
    double lag = 0.0;  ///< s
    std::vector<sim::Sample> samples;
  };

  [[nodiscard]] double time(std::size_t i) const { return begin_ + static_cast<double>(i) / rate_; }
  [[nodiscard]] std::vector<double> signal(std::size_t number, double sim::Sample::* value) const {
    std::vector<double> values;
    values.reserve(count_);
    for (const sim::Sample& sample : series_[series_of_[number]].samples) values.push_back(sample.*value);
    return values;
  }

  double begin_;
  double rate_;
  std::size_t count_;
  std::vector<Series> series_;  ///< one for each lag
  std::array<std::size_t, signals> series_of_{};
};

/// Runs until the recorder is complete. Empty, or why it is not complete.
std::string record_motion(sim::Engine& engine, Recorder& recorder) {
  while (const sim::Interval* interval = engine.next(recorder.end())) recorder.observe(*interval);
  return recorder.complete() ? "" : "the motion ends early: " + engine.outcome().reason;
}

/// Result of one test.
struct Result {
  Pair pair;
  History history;
  std::string failure;
};

/// Whole forcing periods of a periodic motion, and one or two further samples.
void sample_steady_state(const Test& test, const sim::SteadyState& steady, const Measurement& measurement,
                         const identify::Sensors& sensors, Result& result) {
  const double samples = sensors.average_cycles * steady.period * sensors.sample_rate;
  const auto count = static_cast<std::size_t>(samples) + 2;
  Recorder recorder(sensors, test.model.excitation.frequency, 0.0, sensors.sample_rate, count);
  recorder.delay_begin(steady.period * std::ceil(recorder.longest_lag() / steady.period));
  const std::unique_ptr<sim::Engine> engine = sim::make_engine(test.model);
  engine->restart(steady.start);
  result.failure = record_motion(*engine, recorder);
  if (result.failure.empty()) result.history = recorder.history(test, measurement);
}

Result measure_steady_state(const Test& test, const Measurement& measurement, const identify::Sensors& sensors,
                            const sim::SteadyStateOptions& options) {
  Result result;
  const sim::SteadyState steady = sim::steady_state(test.model, options);
  if (!steady.outcome.ok()) {
    result.failure = steady.outcome.reason;
    return result;
  }
  const sim::Excitation& excitation = test.model.excitation;
  result.pair = {.Y = excitation.amplitude,
                 .x = steady.amplitude,
                 .sweep = test.sweep,
                 .number = test.number,
                 .omega = excitation.frequency,
                 .phase = steady.phase,
                 .fundamental = steady.fundamental,
                 .mean_square_speed = steady.mean_square_speed};
  if (sensors.sample_rate > 0.0) sample_steady_state(test, steady, measurement, sensors, result);
  return result;
}

Result measure_history(const Test& test, const Measurement& measurement, const identify::Sensors& sensors) {
  Result result;
  const auto count = static_cast<std::size_t>(measurement.duration * sensors.sample_rate * (1.0 + 1e-12)) + 1;
  const double omega = test.model.excitation.is_harmonic() ? test.model.excitation.frequency : identify::unknown;
  Recorder recorder(sensors, omega, measurement.settle, sensors.sample_rate, count);
  const std::unique_ptr<sim::Engine> engine = sim::make_engine(test.model);
  result.failure = record_motion(*engine, recorder);
  if (result.failure.empty()) result.history = recorder.history(test, measurement);
  return result;
}

/// "pair 3, 4, 7 could not be measured: no steady state ..."
void add_failures(const std::vector<Result>& results, const std::string& what, std::vector<std::string>& warnings) {
  std::map<std::string, std::vector<std::string>> numbers;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (!results[i].failure.empty()) numbers[results[i].failure].push_back(std::to_string(i + 1));
  for (const auto& [reason, list] : numbers)
    warnings.push_back(what + " " + core::joined(list) + " could not be measured: " + reason);
}

MotionRecord measure_all(const sim::Model& model, const Measurement& measurement, const identify::Sensors& sensors,
                         const sim::SteadyStateOptions& options) {
  const std::vector<Test> tests = tests_of(model, measurement);
  const bool steady = measurement.kind == MeasurementKind::steady_states;
  std::vector<Result> results(tests.size());
  sim::in_parts(tests.size(), 1, 0, [&](std::size_t i, std::size_t) {
    results[i] = steady ? measure_steady_state(tests[i], measurement, sensors, options)
                        : measure_history(tests[i], measurement, sensors);
  });

  MotionRecord motion;
  if (model.excitation.is_harmonic()) motion.frequency = model.excitation.frequency;
  const bool sampled = !steady || sensors.sample_rate > 0.0;
  if (!sampled) motion.exact.pairs.emplace();
  for (Result& result : results) {
    if (!result.failure.empty()) continue;
    if (sampled) motion.exact.histories.push_back(std::move(result.history));
    if (steady) (sampled ? motion.sampled_pairs : motion.exact.pairs->pairs).push_back(std::move(result.pair));
  }
  add_failures(results, steady ? "pair" : "history", motion.warnings);
  return motion;
}

MotionRecord measure_decay(const sim::Model& model, int peaks) {
  MotionRecord motion;
  const sim::FreeDecay decay = sim::free_decay(model, peaks);
  if (!decay.outcome.ok()) motion.warnings.push_back("the decay could not be measured: " + decay.outcome.reason);
  if (decay.pauses)
    motion.warnings.emplace_back(
        "the decay ends where the mass has been held for 100 natural periods, though it may move again later");
  identify::DecayRecord& record = motion.exact.decay.emplace();
  for (const sim::Extreme& extreme : decay.extremes) {
    record.extremes.push_back(extreme.x);
    record.times.push_back(extreme.t);
  }
  return motion;
}

/// The pair that follows from the history of a steady state.
void add_sampled_pair(const Pair& exact, const History& history, identify::Record& record,
                      std::vector<std::string>& warnings) {
  identify::DerivedPairs derived = identify::pairs_of({history}, exact.omega);
  for (std::string& warning : derived.warnings)
    warnings.push_back("pair " + std::to_string(exact.number) + ": " + std::move(warning));
  for (Pair& pair : derived.record.pairs) {
    pair.number = exact.number;
    pair.sweep = exact.sweep;
    record.pairs->pairs.push_back(std::move(pair));
  }
}

}  // namespace

sim::Model with_friction_times(double factor, sim::Model model) {
  for (double* part : {&model.oscillator.mass, &model.oscillator.stiffness, &model.oscillator.damping,
                       &model.oscillator.cubic_stiffness, &model.oscillator.gravity_stiffness})
    *part /= factor;
  sim::Excitation& excitation = model.excitation;
  if (excitation.moves_base()) return model;
  for (double* part : {&excitation.amplitude, &excitation.offset, &excitation.slope}) *part /= factor;
  for (sim::Harmonic& harmonic : excitation.harmonics) harmonic.amplitude /= factor;
  excitation.noise.intensity /= factor * factor;
  if (excitation.samples != nullptr)
    excitation.samples = std::make_shared<sim::SampledSignal>(excitation.samples->scaled(1.0 / factor));
  return model;
}

MotionRecord motion_of(const sim::Model& model, const Measurement& measurement, const identify::Sensors& sensors,
                       const sim::SteadyStateOptions& options) {
  if (measurement.kind == MeasurementKind::free_decay) return measure_decay(model, measurement.peaks);
  return measure_all(model, measurement, sensors, options);
}

identify::Record reading(const MotionRecord& motion, const identify::Sensors& sensors, std::uint64_t seed,
                         std::vector<std::string>& warnings) {
  identify::Record record = identify::read(motion.exact, sensors, seed);
  if (!motion.sampled_pairs.empty()) {
    record.pairs.emplace();
    for (std::size_t i = 0; i < record.histories.size(); ++i)
      add_sampled_pair(motion.sampled_pairs[i], record.histories[i], record, warnings);
  } else if (!record.histories.empty()) {
    std::vector<std::string> remarks = identify::complete(record, motion.frequency);
    std::ranges::move(remarks, std::back_inserter(warnings));
  }
  return record;
}

}  // namespace dualdamp::scenarios
