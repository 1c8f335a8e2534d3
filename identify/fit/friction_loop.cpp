#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/fit/experiments.hpp"
#include "identify/records/signals.hpp"
#include "identify/statistics/noise_level.hpp"
#include "sim/conformance/law_host.hpp"

namespace dualdamp::identify {

namespace {

using friction::Direction;
using friction::Instant;

Direction direction_of(double v) {
  return v > 0.0 ? Direction::forward : v < 0.0 ? Direction::backward : Direction::none;
}

class FrictionLoop final : public Experiment {
 public:
  FrictionLoop(const History& history, const ExperimentOptions& options)
      : start_(history.start), rate_(history.sample_rate), x_(history.x), v_(history.v), a_(history.a) {
    kind = ExperimentKind::loop;
    std::vector<double> force = history.force;
    RobustNoiseLevel level;
    level.add(force);
    smooth(history, force);
    Signal signal{.name = "force",
                  .unit = "N",
                  .measured = std::vector<double>(force.begin() + static_cast<std::ptrdiff_t>(edge_),
                                                  force.end() - static_cast<std::ptrdiff_t>(edge_)),
                  .at_name = "t",
                  .at_unit = "s",
                  .noise = options.sigma_force > 0.0 ? options.sigma_force
                           : filter_                 ? 0.0
                                                     : level.deviation(),
                  .is_stated = options.sigma_force > 0.0,
                  .is_sampled = true};
    for (std::size_t i = edge_; i + edge_ < force.size(); ++i)
      signal.at.push_back(start_ + static_cast<double>(i) / rate_);
    signals.push_back(std::move(signal));
    own_others = {Own::offset};
  }

  [[nodiscard]] bool predict(const sim::Model& model, const OwnValues& own,
                             Eigen::VectorXd& outputs) const override {
    const sim::Oscillator& o = model.oscillator;
    const double offset = own[static_cast<std::size_t>(Own::offset)];
    std::vector<double> force(x_.size());
    for (std::size_t i = 0; i < force.size(); ++i) {
      if (o.mass > 0.0) force[i] += o.mass * a_[i];
      if (o.stiffness > 0.0) force[i] -= sim::spring_force(o, offset - x_[i]);
      if (!std::isnan(o.damping)) force[i] += o.damping * v_[i];
    }
    for (const friction::Law& law : model.friction)
      if (!add(law, force)) return false;
    if (filter_) force = (*filter_)(force);
    outputs = Eigen::Map<const Eigen::VectorXd>(force.data() + edge_,
                                                static_cast<Eigen::Index>(signals.front().measured.size()));
    return outputs.allFinite();
  }

 private:
  /// Differentiates or integrates the signals that were not measured. If v was not measured, all signals are
  /// filtered.
  void smooth(const History& history, std::vector<double>& force) {
    if (!v_.empty() && !x_.empty() && !a_.empty()) return;
    if (x_.empty()) {
      x_.assign(v_.size(), 0.0);
      for (std::size_t i = 1; i < v_.size(); ++i) x_[i] = x_[i - 1] + 0.5 * (v_[i] + v_[i - 1]) / rate_;
      if (a_.empty()) a_ = central_difference(v_, rate_);
      if (history.a.empty()) return;
    }
    if (!v_.empty() && a_.empty()) a_ = central_difference(v_, rate_);
    if (!v_.empty()) return;
    const std::vector<double> cutoffs = cutoffs_for(history, {});
    if (!cutoffs.empty() && cutoffs.front() > 0.0 && fault_of_cutoff(history, cutoffs.front()).empty()) {
      filter_.emplace(cutoffs.front(), rate_);
      edge_ = filter_->edge();
      x_ = (*filter_)(x_);
      force = (*filter_)(force);
      if (!a_.empty()) a_ = (*filter_)(a_);
    }
    v_ = central_difference(x_, rate_);
    if (a_.empty()) a_ = second_difference(x_, rate_);
  }

  [[nodiscard]] Instant instant(std::size_t i) const { return {static_cast<double>(i) / rate_, x_[i], v_[i]}; }

  /// Adds the force of a law. A law without memory needs no path between the samples.
  [[nodiscard]] bool add(const friction::Law& law, std::vector<double>& force) const {
    if (!law.is_modal() && !law.has_rates() && !(law.delay() > 0.0) && !law.advances()) {
      for (std::size_t i = 0; i < force.size(); ++i) force[i] += law.force({}, instant(i), direction_of(v_[i]));
      return true;
    }
    sim::LawHost host(law, instant(0));
    host.change_direction(direction_of(v_[0]));
    force[0] += host.force();
    for (std::size_t i = 1; i < force.size(); ++i) {
      move(host, i);
      if (host.broken()) return false;
      force[i] += host.force();
    }
    return true;
  }

  /// Moves the law from sample i - 1 to sample i. The velocity is a straight line, which may cross zero once.
  void move(sim::LawHost& host, std::size_t i) const {
    const Instant from = instant(i - 1);
    const Instant to = instant(i);
    const double h = to.t - from.t;
    // Difference of the measured step from the step with this velocity.
    const double left = to.x - from.x - 0.5 * h * (from.v + to.v);
    const sim::Path path = [from, to, h, left](double t) {
      const double s = t - from.t;
      return Instant{t, from.x + s * (from.v + 0.5 * s / h * (to.v - from.v)) + s / h * left,
                     from.v + s / h * (to.v - from.v)};
    };
    if (from.v * to.v < 0.0) {
      host.move_along(from.t + h * from.v / (from.v - to.v), path);
      host.change_direction(direction_of(to.v));
    } else if (from.v == 0.0 && to.v != 0.0) {
      host.change_direction(direction_of(to.v));
    }
    host.move_along(to.t, path);
  }

  double start_;
  double rate_;
  std::vector<double> x_, v_, a_;
  std::optional<ZeroPhaseFilter> filter_;
  std::size_t edge_ = 0;
};

}  // namespace

std::unique_ptr<Experiment> friction_loop(const History& history, const ExperimentOptions& options,
                                          std::string& fault) {
  constexpr std::size_t least = 8;
  if (history.force.size() >= least && (!history.x.empty() || !history.v.empty()))
    return std::make_unique<FrictionLoop>(history, options);
  fault = "a loop needs the columns t, force, and x or v, and eight samples";
  return nullptr;
}

}  // namespace dualdamp::identify
