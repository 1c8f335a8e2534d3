#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/experiments/drive_values.hpp"
#include "identify/experiments/experiment.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/experiments/tie.hpp"
#include "identify/records/signals.hpp"
#include "identify/records/swings.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_between_jumps.hpp"
#include "sim/engine/engine.hpp"
#include "sim/law_host/loaded_contacts.hpp"

namespace dualdamp::identify {

namespace {

/// Value and slope at the first sample of a parabola through the first samples of a signal.
std::pair<double, double> begin_of(const std::vector<double>& signal, double rate) {
  constexpr std::size_t least = 8;
  constexpr std::size_t share = 100;
  const std::size_t count = std::min(signal.size(), std::max(least, signal.size() / share));
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(count), 3);
  Eigen::VectorXd target(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / rate;
    columns.row(static_cast<Eigen::Index>(i)) << 1.0, t, t * t;
    target[static_cast<Eigen::Index>(i)] = signal[i];
  }
  const Eigen::VectorXd found = pivoted_least_squares(columns, target);
  return {found[0], found[1]};
}

/// The integral of a measured rate of change, minus its straight line of least squares.
std::vector<double> integral_of(const std::vector<double>& of_rate, double rate) {
  std::vector<double> integral = running_integral(of_rate, rate);
  const Eigen::Map<Eigen::VectorXd> sum(integral.data(), static_cast<Eigen::Index>(integral.size()));
  Eigen::MatrixXd trend = Eigen::MatrixXd::Ones(sum.size(), 2);
  trend.col(1) = Eigen::VectorXd::LinSpaced(sum.size(), -1.0, 1.0);
  Eigen::Map<Eigen::VectorXd>(integral.data(), sum.size()) = left_beside(trend, sum);
  return integral;
}

/// Position and velocity at the first sample, if only the acceleration was measured. x = -a/w^2 holds without
/// damping and friction, which change their sign with the velocity, and x = x_0 + v_0 t + the double integral of a.
/// If the zero of a is off by b, b (1/w^2 - t^2/2) is added: a constant and t^2. x_0, v_0, 1/w^2 and b follow by
/// least squares over all samples; b only if a parabola does not take more than half of a, as in a part of a swing.
std::pair<double, double> begin_of_acceleration(const std::vector<double>& a, double rate) {
  const std::vector<double> path = running_integral(running_integral(a, rate), rate);
  const auto count = static_cast<Eigen::Index>(a.size());
  const Eigen::Map<const Eigen::VectorXd> measured(a.data(), count);
  const double duration = static_cast<double>(count - 1) / rate;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(count, 4);
  columns.col(1) = Eigen::VectorXd::LinSpaced(count, 0.0, duration);
  columns.col(2) = columns.col(1).cwiseAbs2() / (duration * duration);
  columns.col(3) = measured;
  const auto rest_without = [&](Eigen::Index first) {
    const Eigen::MatrixXd trend = columns.leftCols(first);
    return left_beside(trend, measured).squaredNorm();
  };
  if (rest_without(3) < 0.5 * rest_without(2)) columns.col(2).setZero();
  const Eigen::VectorXd target = -Eigen::Map<const Eigen::VectorXd>(path.data(), count);
  const Eigen::VectorXd found = pivoted_least_squares(columns, target);
  const double zero = 2.0 * found[2] / (duration * duration);
  return {found[0] + zero * found[3], found[1]};
}

/// The zero of a measured rate of change, and how far the mass moves without it. The slope of the integral is the
/// zero, but for what the motion itself adds.
struct Zero {
  double value = 0.0;
  double swing = 0.0;  ///< largest distance from the middle [m]
};

/// `integrals`: from the signal to the position.
Zero zero_of(const std::vector<double>& signal, int integrals, double rate) {
  std::vector<double> rest = integral_of(signal, rate);
  const std::vector<double> whole = running_integral(signal, rate);
  const double duration = static_cast<double>(signal.size() - 1) / rate;
  const double zero = (whole.back() - whole.front() - (rest.back() - rest.front())) / duration;
  if (integrals == 2) rest = integral_of(rest, rate);
  return {zero, largest_swing(rest)};
}

/// Whether the zero of v or a is off for certain. A motion within X of its middle adds at most 3 X/T to the slope
/// of the integral of v over the duration T, and 24 X/T^2 to that of the integral of a. Noise adds a random walk.
bool is_off(const Zero& zero, double most_of_motion, double noise, std::size_t samples) {
  constexpr double deviations = 5.0;
  const double of_walk = noise * std::sqrt(1.2 / static_cast<double>(samples));
  return std::abs(zero.value) > most_of_motion * zero.swing && std::abs(zero.value) > deviations * of_walk;
}

constexpr std::size_t least_samples = 8;

/// Samples on both sides of each jump of a signal, and the first sample, before which there may be a jump. At a
/// jump, the difference of two neighbours differs from the differences beside it by more than noise and curvature
/// explain.
std::vector<std::size_t> beside_jumps(const std::vector<double>& signal) {
  std::vector<double> excess;
  for (std::size_t i = 1; i + 2 < signal.size(); ++i)
    excess.push_back(std::abs(1.5 * (signal[i + 1] - signal[i]) - 0.5 * (signal[i + 2] - signal[i - 1])));
  if (excess.empty()) return {};
  constexpr double beyond = 4.0;
  const double largest = beyond * median_deviation(excess);
  std::vector<std::size_t> found{0};
  for (std::size_t i = 1; i + 2 < signal.size(); ++i) {
    const bool is_peak =
        excess[i - 1] >= (i > 1 ? excess[i - 2] : 0.0) && excess[i - 1] >= (i < excess.size() ? excess[i] : 0.0);
    if (excess[i - 1] <= largest || !is_peak) continue;
    if (found.back() != i) found.push_back(i);
    found.push_back(i + 1);
  }
  // If the signal jumps in too many places, no sample but the first one is left out.
  constexpr std::size_t part = 5;
  return found.size() <= signal.size() / part ? found : std::vector<std::size_t>{0};
}

class MeasuredMotion final : public Experiment {
 public:
  MeasuredMotion(const History& history, const ExperimentOptions& options)
      : start_(history.start), rate_(history.sample_rate) {
    kind = ExperimentKind::history;
    for (const auto& [name, unit, values, stated] : {std::tuple{"x", "m", &history.x, options.sigma_x},
                                                     {"v", "m/s", &history.v, options.sigma_v},
                                                     {"a", "m/s^2", &history.a, options.sigma_a}}) {
      if (values->empty()) continue;
      Signal signal{.name = name,
                    .unit = unit,
                    .measured = *values,
                    .at_name = "t",
                    .at_unit = "s",
                    .noise = stated > 0.0 ? stated : noise_between_jumps(*values),
                    .is_stated = stated > 0.0,
                    .is_sampled = true};
      for (std::size_t i = 0; i < values->size(); ++i) signal.at.push_back(start_ + static_cast<double>(i) / rate_);
      if (signal.name == "a") signal.unsure = beside_jumps(*values);
      signals.push_back(std::move(signal));
    }
    samples_ = signals.front().measured.size();
    record_free = {RecordParameter::position, RecordParameter::velocity};
    record_others = {RecordParameter::offset, RecordParameter::travel};
    if (!history.v.empty()) record_others.push_back(RecordParameter::offset_v);
    if (!history.a.empty()) record_others.push_back(RecordParameter::offset_a);
    begin(history);
    seek_zeros(history);
  }

  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues& of_record,
                             Eigen::VectorXd& outputs) const override {
    sim::Model there = model;
    there.initial = {of_record[RecordParameter::position], of_record[RecordParameter::velocity]};
    if (!sim::load_contacts(there, of_record[RecordParameter::travel])) return false;
    const double end = static_cast<double>(samples_ - 1) / rate_;
    there.excitation = drive ? *drive : drive_from(model.excitation, start_, end);
    if (tie_) {
      std::optional<sim::Model> tied = tie_->tied(there, of_record);
      if (!tied) return false;
      there = std::move(*tied);
    }
    outputs.resize(size());
    const std::unique_ptr<sim::Engine> engine = sim::make_engine(there);
    std::size_t next = 0;
    const auto take_until = [&](const sim::Interval& interval, double until) {
      for (; next < samples_ && static_cast<double>(next) / rate_ <= until; ++next)
        write(interval.state_at(static_cast<double>(next) / rate_), of_record, next, outputs);
    };
    // A little longer than the record, so that the last sample is inside an interval.
    while (const sim::Interval* interval = engine->next(end * (1.0 + 1e-9) + 1e-12)) {
      take_until(*interval, interval->end());
      if (next == samples_) break;
      if (engine->work() > most_work(there)) break;
    }
    *work += engine->work();
    return engine->outcome().ok() && next == samples_ && outputs.allFinite();
  }

  [[nodiscard]] std::unique_ptr<Experiment> first_part(double share) const override {
    auto part = std::make_unique<MeasuredMotion>(*this);
    part->samples_ = std::min(samples_, static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples_))));
    for (Signal& signal : part->signals) {
      signal.measured.resize(part->samples_);
      signal.at.resize(part->samples_);
      std::erase_if(signal.unsure, [&](std::size_t i) { return i >= part->samples_; });
    }
    return part;
  }

  [[nodiscard]] std::unique_ptr<Experiment> thinned() const override {
    constexpr double of_swing = 60.0;
    const double apart = core::two_pi * rate_ / (crossing_frequency(signals.front()) * of_swing);
    const std::size_t stride = std::min(static_cast<std::size_t>(apart), samples_ / least_samples);
    if (stride < 2) return nullptr;
    auto thin = std::make_unique<MeasuredMotion>(*this);
    thin->rate_ = rate_ / static_cast<double>(stride);
    thin->samples_ = (samples_ - 1) / stride + 1;
    for (Signal& signal : thin->signals) {
      std::erase_if(signal.unsure, [stride](std::size_t i) { return i % stride != 0; });
      for (std::size_t& i : signal.unsure) i /= stride;
      for (std::size_t i = 0; i < thin->samples_; ++i) {
        signal.measured[i] = signal.measured[i * stride];
        signal.at[i] = signal.at[i * stride];
      }
      signal.measured.resize(thin->samples_);
      signal.at.resize(thin->samples_);
    }
    return thin;
  }

  [[nodiscard]] std::unique_ptr<Experiment> tied(double strength) const override {
    const auto samples_of = [&](const char* name) {
      const auto found = std::ranges::find(signals, name, &Signal::name);
      return found == signals.end() ? std::vector<double>() : found->measured;
    };
    const std::vector<double> x = samples_of("x");
    const std::vector<double> v = samples_of("v");
    const std::vector<double> a = samples_of("a");
    auto tied = std::make_unique<MeasuredMotion>(*this);
    tied->tie_ =
        std::make_shared<const Tie>(MeasuredSamples{rate_, x, v, a}, crossing_frequency(signals.front()), strength);
    return tied;
  }

 private:
  /// Largest number of steps. A motion that needs ten times the usual number has parameters far off.
  [[nodiscard]] long most_work(const sim::Model& model) const {
    constexpr double least = 1e5;
    constexpr double of_sample = 10.0;
    constexpr double of_swing = 500.0;
    const double swings = static_cast<double>(samples_) / rate_ * sim::natural_frequency(model.oscillator);
    return static_cast<long>(least + of_sample * static_cast<double>(samples_) + of_swing * swings);
  }

  void begin(const History& history) {
    double& position = record_start[RecordParameter::position];
    double& velocity = record_start[RecordParameter::velocity];
    if (!history.x.empty()) std::tie(position, velocity) = begin_of(history.x, rate_);
    if (!history.v.empty()) velocity = begin_of(history.v, rate_).first;
    if (!history.x.empty()) return;
    if (history.v.empty())
      std::tie(position, velocity) = begin_of_acceleration(history.a, rate_);
    else
      position = integral_of(history.v, rate_).front();
  }

  /// Zeros of v and a that are off for certain are sought if a spring holds the mass near its place.
  void seek_zeros(const History& history) {
    const double duration = static_cast<double>(samples_ - 1) / rate_;
    for (const Signal& signal : signals) {
      if (signal.name == "x" || swings_of(signal.measured) < 1.0) continue;
      const bool is_v = signal.name == "v";
      const Zero zero = is_v ? zero_of(history.v, 1, rate_) : zero_of(history.a, 2, rate_);
      if (!is_off(zero, is_v ? 3.0 / duration : 24.0 / (duration * duration), signal.noise, samples_)) continue;
      record_of_place.push_back(is_v ? RecordParameter::offset_v : RecordParameter::offset_a);
      remarks.emplace_back(record_of_place.back(),
                           "the mean of " + signal.name + ", " + core::format_number(zero.value, 3) +
                               " in SI units, would carry the mass away: the zero of " + signal.name +
                               " is sought as " + (is_v ? "offset_v" : "offset_a"));
    }
  }

  void write(const sim::Sample& sample, const RecordValues& of_record, std::size_t i,
             Eigen::VectorXd& outputs) const {
    for (std::size_t s = 0; s < signals.size(); ++s)
      outputs[static_cast<Eigen::Index>(s * samples_ + i)] =
          signals[s].name == "x"   ? sample.x + of_record[RecordParameter::offset]
          : signals[s].name == "v" ? sample.v + of_record[RecordParameter::offset_v]
                                   : sample.a + of_record[RecordParameter::offset_a];
  }

  double start_;
  double rate_;
  std::size_t samples_ = 0;
  std::shared_ptr<const Tie> tie_;
};

}  // namespace

std::unique_ptr<Experiment> motion(const History& history, const ExperimentOptions& options, std::string& fault) {
  const std::size_t count = std::max({history.x.size(), history.v.size(), history.a.size()});
  if (count >= least_samples) return std::make_unique<MeasuredMotion>(history, options);
  fault = count == 0 ? "a history needs one of the columns x, v, a" : "a history needs eight samples";
  return nullptr;
}

}  // namespace dualdamp::identify
