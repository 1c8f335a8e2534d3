#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/fit/experiments.hpp"
#include "identify/records/signals.hpp"
#include "identify/statistics/linear_least_squares.hpp"
#include "identify/statistics/noise_level.hpp"
#include "sim/engine/engine.hpp"

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

/// A signal whose rate of change was measured: its integral swings about zero, or about a straight line where its
/// rate may be off by a constant.
std::vector<double> integral_of(const std::vector<double>& of_rate, double rate, bool about_line) {
  const auto count = static_cast<Eigen::Index>(of_rate.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 1; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    sum[i] = sum[i - 1] + 0.5 / rate * (of_rate[at - 1] + of_rate[at]);
  }
  Eigen::MatrixXd trend = Eigen::MatrixXd::Ones(count, about_line ? 2 : 1);
  if (about_line) trend.col(1) = Eigen::VectorXd::LinSpaced(count, -1.0, 1.0);
  sum -= trend * pivoted_least_squares(trend, sum);
  return {sum.data(), sum.data() + count};
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
      RobustNoiseLevel level;
      level.add(*values);
      Signal signal{.name = name,
                    .unit = unit,
                    .measured = *values,
                    .at_name = "t",
                    .at_unit = "s",
                    .noise = stated > 0.0 ? stated : level.deviation(),
                    .is_stated = stated > 0.0,
                    .is_sampled = true};
      for (std::size_t i = 0; i < values->size(); ++i) signal.at.push_back(start_ + static_cast<double>(i) / rate_);
      signals.push_back(std::move(signal));
    }
    samples_ = signals.front().measured.size();
    own_free = {Own::position, Own::velocity};
    own_others = {Own::offset};
    begin(history);
  }

  [[nodiscard]] bool predict(const sim::Model& model, const OwnValues& own,
                             Eigen::VectorXd& outputs) const override {
    sim::Model there = model;
    there.initial = {own[static_cast<std::size_t>(Own::position)], own[static_cast<std::size_t>(Own::velocity)]};
    there.excitation.phase += there.excitation.frequency * start_;
    for (sim::Harmonic& harmonic : there.excitation.harmonics)
      harmonic.phase += harmonic.order * there.excitation.frequency * start_;
    outputs.resize(size());
    const std::unique_ptr<sim::Engine> engine = sim::make_engine(there);
    const double end = static_cast<double>(samples_ - 1) / rate_;
    const double offset = own[static_cast<std::size_t>(Own::offset)];
    std::size_t next = 0;
    const auto take_until = [&](const sim::Interval& interval, double until) {
      for (; next < samples_ && static_cast<double>(next) / rate_ <= until; ++next)
        write(interval.state_at(static_cast<double>(next) / rate_), offset, next, outputs);
    };
    // A little more than the record, so that its last sample lies inside an interval.
    while (const sim::Interval* interval = engine->next(end * (1.0 + 1e-9) + 1e-12)) {
      take_until(*interval, interval->end());
      if (next == samples_) break;
      if (engine->work() > most_work(there)) return false;
    }
    return engine->outcome().ok() && next == samples_ && outputs.allFinite();
  }

  [[nodiscard]] std::unique_ptr<Experiment> first_part(double share) const override {
    auto part = std::make_unique<MeasuredMotion>(*this);
    part->samples_ = std::min(samples_, static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples_))));
    for (Signal& signal : part->signals) {
      signal.measured.resize(part->samples_);
      signal.at.resize(part->samples_);
    }
    return part;
  }

 private:
  /// A motion that takes ten times the usual steps is one of numbers far off.
  [[nodiscard]] long most_work(const sim::Model& model) const {
    constexpr double least = 1e5;
    constexpr double of_sample = 10.0;
    constexpr double of_swing = 500.0;
    const double swings = static_cast<double>(samples_) / rate_ * sim::natural_frequency(model.oscillator);
    return static_cast<long>(least + of_sample * static_cast<double>(samples_) + of_swing * swings);
  }

  void begin(const History& history) {
    double& position = own_start[static_cast<std::size_t>(Own::position)];
    double& velocity = own_start[static_cast<std::size_t>(Own::velocity)];
    if (!history.x.empty()) std::tie(position, velocity) = begin_of(history.x, rate_);
    const bool only_a = history.x.empty() && history.v.empty();
    const std::vector<double> v = only_a ? integral_of(history.a, rate_, false) : history.v;
    if (!v.empty()) velocity = begin_of(v, rate_).first;
    if (history.x.empty()) position = integral_of(v, rate_, true).front();
  }

  void write(const sim::Sample& sample, double offset, std::size_t i, Eigen::VectorXd& outputs) const {
    for (std::size_t s = 0; s < signals.size(); ++s)
      outputs[static_cast<Eigen::Index>(s * samples_ + i)] = signals[s].name == "x"   ? sample.x + offset
                                                             : signals[s].name == "v" ? sample.v
                                                                                      : sample.a;
  }

  double start_;
  double rate_;
  std::size_t samples_ = 0;
};

}  // namespace

std::unique_ptr<Experiment> motion(const History& history, const ExperimentOptions& options, std::string& fault) {
  constexpr std::size_t least = 8;
  const std::size_t count = std::max({history.x.size(), history.v.size(), history.a.size()});
  if (count >= least) return std::make_unique<MeasuredMotion>(history, options);
  fault = count == 0 ? "a history needs one of the columns x, v, a" : "a history needs eight samples";
  return nullptr;
}

}  // namespace dualdamp::identify
