#include "identify/uncertainty/synthetic_record.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "identify/models/sampled_oscillator.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/drive_steps.hpp"
#include "identify/statistics/lasting_part.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

double root_mean_square(const std::vector<double>& signal) {
  double sum = 0.0;
  for (const double value : signal) sum += value * value;
  return signal.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(signal.size()));
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  std::ranges::transform(a, b, result.begin(), std::minus<>());
  return result;
}

std::vector<double> vector_of(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

/// A spring and damper towards the measured motion.
struct Steering {
  double stiffness = 0.0;
  double damping = 0.0;
  std::vector<double> x, v;  ///< the motion to follow

  Steering() = default;
  Steering(const History& history, double mass) {
    const double cutoff = cutoffs_for(history, {}).front();
    const PreparedHistory motion = prepared_history(history, 0.0);
    const auto smooth = [&](const std::vector<double>& signal) {
      return cutoff > 0.0 ? ZeroPhaseFilter(cutoff, history.sample_rate)(signal) : signal;
    };
    x = smooth(history.x);
    v = smooth(history.v.empty() ? central_difference(history.x, history.sample_rate) : history.v);
    // With the mass alone: critically damped, with the frequency of the motion itself.
    const double omega = root_mean_square(v) / root_mean_square(x);
    stiffness = mass * omega * omega;
    damping = 2.0 * mass * omega;
  }
};

/// y and force that make `SampledOscillator` steer if its stiffness and damping are those of law and steering
/// together: its y is the mean of base and record, weighted by their stiffnesses.
History drive_of(const History& history, const ForceParameters& law, const Steering& steering, double offset) {
  History drive;
  drive.sample_rate = history.sample_rate;
  drive.x = history.x;
  drive.y = history.y;
  drive.force = history.force.empty() ? std::vector<double>(history.x.size(), 0.0) : history.force;
  for (double& force : drive.force) force -= offset;
  if (steering.stiffness == 0.0) return drive;
  drive.y.resize(drive.x.size());
  for (std::size_t i = 0; i < drive.y.size(); ++i) {
    drive.y[i] = (law.k * drive.y[i] + steering.stiffness * steering.x[i]) / (law.k + steering.stiffness);
    drive.force[i] += steering.damping * steering.v[i];
  }
  return drive;
}

double sign(double value) { return static_cast<double>((value > 0.0) - (value < 0.0)); }

/// Force on the mass beside friction: k (y - x) + f - offset - c v.
std::vector<double> pull_of(const History& history, const ForceParameters& law, double offset) {
  std::vector<double> pull(history.x.size());
  for (std::size_t i = 0; i < pull.size(); ++i)
    pull[i] = law.k * (history.y_at(i) - history.x[i]) + history.force_at(i) - offset - law.c * history.v[i];
  return pull;
}

/// One history of the synthetic records, free of noise.
class SyntheticHistory {
 public:
  SyntheticHistory(const History& measured, const ForceParameters& law, double offset, bool steered,
                   const MotionStart* start)
      : measured_(measured),
        law_(law),
        offset_(offset),
        steering_(steered ? Steering(measured, law.m) : Steering()),
        steps_(drive_steps(measured)),
        at_{law.m, law.c + steering_.damping, law.k + steering_.stiffness, law.F0, 0.0, 0.0},
        starts_(start != nullptr) {
    if (start == nullptr) return;
    at_.x0 = start->x0;
    at_.v0 = start->v0;
    at_.places = start->places;
  }

  /// The history with all of x, v and a, under the measured drive. Nothing if the motion cannot be computed.
  [[nodiscard]] std::optional<History> history() {
    SampledOscillator model(drive_of(measured_, law_, steering_, offset_), steps_);
    Eigen::VectorXd x;
    Eigen::VectorXd v;
    if ((!starts_ && !meet(model)) || !model.run(at_, {}, x, nullptr, &v)) return std::nullopt;
    History synthetic = measured_;
    synthetic.x = vector_of(x);
    synthetic.v = vector_of(v);
    if (steering_.stiffness > 0.0) {
      synthetic.force.resize(synthetic.x.size());
      for (std::size_t i = 0; i < synthetic.x.size(); ++i)
        synthetic.force[i] += steering_.stiffness * (steering_.x[i] - synthetic.x[i]) +
                              steering_.damping * (steering_.v[i] - synthetic.v[i]);
    }
    const std::vector<double> pull = pull_of(synthetic, law_, offset_);
    synthetic.a.resize(pull.size());
    for (std::size_t i = 0; i < pull.size(); ++i) {
      const bool slips = synthetic.v[i] != 0.0;
      const double friction = slips ? law_.F0 * sign(synthetic.v[i]) : std::clamp(pull[i], -law_.F0, law_.F0);
      synthetic.a[i] = (pull[i] - friction) / law_.m;
    }
    return synthetic;
  }

  /// x of the same mass under another drive.
  [[nodiscard]] std::optional<std::vector<double>> motion_under(const History& drive) const {
    SampledOscillator model(drive_of(drive, law_, steering_, offset_), steps_);
    Eigen::VectorXd x;
    if (!model.run(at_, {}, x, nullptr)) return std::nullopt;
    return vector_of(x);
  }

 private:
  /// Sets the initial state, and the places of steps of the drive, that bring the motion closest to the record, by
  /// Gauss-Newton steps.
  bool meet(SampledOscillator& model) {
    using By = SampledOscillator::By;
    const Eigen::Map<const Eigen::VectorXd> x_measured(measured_.x.data(),
                                                       static_cast<Eigen::Index>(measured_.x.size()));
    SampledOscillator::Parameters next = at_;
    next.x0 = measured_.x.front();
    next.v0 = measured_.v.empty() ? central_difference(five_point_average(measured_.x), measured_.sample_rate)[2]
                                  : measured_.v.front();
    next.places.assign(steps_.size(), 0.5);
    std::vector<By> by{By::position, By::velocity};
    by.resize(by.size() + steps_.size(), By::place);
    constexpr int steps = 3;
    double least = core::infinity;
    for (int step = 0; step < steps; ++step) {
      Eigen::VectorXd x;
      SampledOscillator::Derivatives of_motion;
      if (!model.run(next, by, x, &of_motion)) return false;
      const Eigen::MatrixXd& derivatives = of_motion.x;
      const Eigen::VectorXd miss = x_measured - x;
      if (!(miss.squaredNorm() < least)) break;
      least = miss.squaredNorm();
      at_ = next;
      const Eigen::VectorXd move = pivoted_least_squares(derivatives, miss);
      if (!move.allFinite()) break;
      next.x0 += move[0];
      next.v0 += move[1];
      for (std::size_t i = 0; i < next.places.size(); ++i)
        next.places[i] = std::clamp(next.places[i] + move[static_cast<Eigen::Index>(i) + 2], 0.0, 1.0);
    }
    return std::isfinite(least);
  }

  const History& measured_;
  ForceParameters law_;
  double offset_;
  Steering steering_;
  std::vector<std::size_t> steps_;  ///< of the measured drive
  SampledOscillator::Parameters at_;
  bool starts_;  ///< from a given state
};

bool close(const History& synthetic, const History& measured) {
  constexpr double of_the_motion = 0.1;
  return root_mean_square(difference(measured.x, synthetic.x)) < of_the_motion * root_mean_square(measured.x);
}

/// Noise of a signal for which there is a synthetic motion.
struct MotionNoise {
  RobustNoiseLevel beside, own;

  void add(const std::vector<double>& measured, const std::vector<double>& synthetic) {
    if (measured.empty()) return;
    beside.add(difference(measured, synthetic));
    own.add(measured);
  }
  /// The lesser of two estimates: the synthetic motion contains noise of the drive, the signal contains jumps.
  [[nodiscard]] double deviation() const { return std::min(beside.deviation(), own.deviation()); }
};

/// Noise levels of all histories together, because the sensors are the same.
struct NoiseLevels {
  RobustNoiseLevel y, force, balance;
  MotionNoise x, v, a;

  void add(const History& measured, const History& synthetic, const ForceParameters& law) {
    y.add(measured.y);
    force.add(measured.force);
    x.add(measured.x, synthetic.x);
    v.add(measured.v, synthetic.v);
    a.add(measured.a, synthetic.a);
    if (!measured.has_drive()) return;
    // The forces less inertia and spring. What is left is noise, beside friction and damping, which are smooth.
    const std::vector<double> acceleration =
        measured.a.empty() ? second_difference(measured.x, measured.sample_rate) : measured.a;
    std::vector<double> left(measured.x.size());
    for (std::size_t i = 0; i < left.size(); ++i)
      left[i] = law.k * (measured.y_at(i) - measured.x[i]) + measured.force_at(i) - law.m * acceleration[i];
    balance.add(left);
  }

  [[nodiscard]] Sensors sensors(const ForceParameters& law) const {
    const double most = balance.deviation();
    Sensors sensors;
    sensors.x.noise = x.deviation();
    sensors.v.noise = v.deviation();
    sensors.a.noise = a.deviation();
    sensors.y.noise = law.k > 0.0 ? std::min(y.deviation(), most / law.k) : 0.0;
    sensors.force.noise = std::min(force.deviation(), most);
    return sensors;
  }
};

/// Bounds the noise of the drive. What looks like noise at high frequency may be a real drive. Noise in the
/// recorded drive makes the synthetic motion differ from the measured one: it cannot be larger than this difference
/// allows.
void bound_drive_noise(const std::vector<NumberedHistory>& histories,
                       const std::vector<SyntheticHistory>& candidates, const Record& exact, std::uint64_t seed,
                       Sensors& sensors) {
  if (sensors.y.noise == 0.0 && sensors.force.noise == 0.0) return;
  Sensors drive;
  drive.y = sensors.y;
  drive.force = sensors.force;
  LastingPart seen;
  LastingPart expected;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const History& measured = *histories[i].history;
    Record noisy;
    noisy.histories = {measured};
    noisy = read(noisy, drive, seed);
    const std::optional<std::vector<double>> moved = candidates[i].motion_under(noisy.histories.front());
    if (!moved) return;
    seen.add(difference(measured.x, exact.histories[i].x));
    expected.add(difference(*moved, exact.histories[i].x));
  }
  const double share = std::sqrt(std::min(1.0, seen.at_most(sensors.x.noise) / expected.at_most(0.0)));
  sensors.y.noise *= share;
  sensors.force.noise *= share;
}

/// The signals that a converter rounds, and their sensors.
constexpr std::array rounded_signals = {std::pair{&History::x, &Sensors::x}, std::pair{&History::v, &Sensors::v},
                                        std::pair{&History::a, &Sensors::a}};

/// Gives the sensors the steps of the converters. The noise level of the readings contains their rounding.
void round_as_measured(const std::vector<NumberedHistory>& histories, Sensors& sensors) {
  constexpr double variance_of_rounding = 1.0 / 12.0;  // of one step
  for (const auto& [signal, member] : rounded_signals) {
    Sensor& sensor = sensors.*member;
    for (const NumberedHistory& item : histories)
      sensor.resolution = std::max(sensor.resolution, converter_step((*item.history).*signal));
    const double rounding = variance_of_rounding * sensor.resolution * sensor.resolution;
    sensor.noise = std::sqrt(std::max(0.0, sensor.noise * sensor.noise - rounding));
  }
}

}  // namespace

std::uint64_t seed_of(const std::vector<NumberedHistory>& histories) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const NumberedHistory& item : histories)
    for (const double x : item.history->x) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211ULL;
  return hash;
}

Record SyntheticRecords::record(int number) const {
  const std::uint64_t own = seed + 1 + static_cast<std::uint64_t>(number);
  // The zero of each converter lies anywhere between two steps: without noise, all records would be rounded alike.
  constexpr std::uint32_t zero_stream = 64;  // away from those of the sensors
  const core::RandomStream zeros(own, zero_stream);
  Sensors drawn = sensors;
  for (std::size_t i = 0; i < rounded_signals.size(); ++i) {
    Sensor& sensor = drawn.*rounded_signals[i].second;
    sensor.offset = sensor.resolution * (zeros.uniform(i) - 0.5);
  }
  Record record = read(exact, drawn, own);
  for (const auto& [signal, member] : rounded_signals)
    for (History& history : record.histories)
      for (double& reading : history.*signal) reading -= (drawn.*member).offset;
  return record;
}

std::optional<SyntheticRecords> synthetic_records(const std::vector<NumberedHistory>& histories,
                                                  ForceParameters& truth, double offset,
                                                  const std::vector<MotionStart>& starts) {
  if (!(truth.m > 0.0) || !(truth.k >= 0.0)) return std::nullopt;
  truth.c = std::max(0.0, truth.c);
  truth.F0 = std::max(0.0, truth.F0);
  SyntheticRecords synthetic;
  synthetic.seed = seed_of(histories);
  std::vector<SyntheticHistory> candidates;
  NoiseLevels levels;
  for (const NumberedHistory& item : histories) {
    const History& measured = *item.history;
    std::optional<History> history;
    const MotionStart* start = starts.empty() ? nullptr : &starts[candidates.size()];
    for (const bool steered : {false, true}) {
      if (!steered && truth.k == 0.0) continue;  // without a spring it would drift
      SyntheticHistory candidate(measured, truth, offset, steered, start);
      history = candidate.history();
      if (!history || !close(*history, measured)) continue;
      candidates.push_back(std::move(candidate));
      break;
    }
    if (candidates.size() == synthetic.exact.histories.size()) return std::nullopt;
    levels.add(measured, *history, truth);
    if (measured.v.empty()) history->v.clear();
    if (measured.a.empty()) history->a.clear();
    synthetic.exact.histories.push_back(std::move(*history));
  }
  synthetic.sensors = levels.sensors(truth);
  bound_drive_noise(histories, candidates, synthetic.exact, synthetic.seed, synthetic.sensors);
  round_as_measured(histories, synthetic.sensors);
  return synthetic;
}

}  // namespace dualdamp::identify
