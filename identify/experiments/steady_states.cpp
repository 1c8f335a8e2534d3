#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/angle.hpp"
#include "friction_models/law_fault.hpp"
#include "identify/experiments/balanced_states.hpp"
#include "identify/experiments/experiment.hpp"
#include "sim/orbits/steady_state_near.hpp"
#include "sim/orbits/structural_damping.hpp"

namespace dualdamp::identify {

namespace {

struct Level {
  double Y = 0.0;
  double omega = 0.0;
};

sim::Model driven(const sim::Model& model, const Level& level, bool by_force) {
  sim::Model result = model;
  result.excitation.type = by_force ? sim::ExcitationType::force_harmonic : sim::ExcitationType::base_harmonic;
  result.excitation.amplitude = level.Y;
  result.excitation.frequency = level.omega;
  return result.oscillator.loss_factor == 0.0 ? result : sim::with_viscous_equivalent(std::move(result));
}

class SteadyStates final : public Experiment {
 public:
  SteadyStates(const PairRecord& record, const ExperimentOptions& options) : by_force_(options.force_driven) {
    kind = ExperimentKind::steady_states;
    is_force_driven = by_force_;
    Signal x{.name = "x", .unit = "m", .noise = options.sigma_x, .is_stated = options.sigma_x > 0.0};
    Signal phase{
        .name = "phase", .unit = "rad", .noise = options.sigma_phase, .is_stated = options.sigma_phase > 0.0};
    for (const Pair& pair : record.pairs)
      levels_.push_back({pair.Y, std::isnan(pair.omega) ? options.frequency : pair.omega});
    const auto varies = [this](double Level::* of) {
      return std::ranges::any_of(levels_, [&](const Level& level) { return level.*of != levels_.front().*of; });
    };
    const bool over_frequency = varies(&Level::omega);
    const bool over_both = over_frequency && varies(&Level::Y);
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double at = over_frequency ? levels_[i].omega : levels_[i].Y;
      x.measured.push_back(record.pairs[i].x);
      x.at.push_back(at);
      if (over_both) x.companion.values.push_back(levels_[i].Y);
      if (std::isnan(record.pairs[i].phase)) continue;
      phase.measured.push_back(record.pairs[i].phase);
      phase.at.push_back(at);
      if (over_both) phase.companion.values.push_back(levels_[i].Y);
      with_phase_.push_back(i);
    }
    for (Signal* signal : {&x, &phase}) {
      signal->at_name = over_frequency ? "omega" : "Y";
      const char* const unit_of_Y = by_force_ ? "N" : "m";
      signal->at_unit = over_frequency ? "rad/s" : unit_of_Y;
      if (over_both) signal->companion = {"Y", unit_of_Y, std::move(signal->companion.values)};
    }
    signals.push_back(std::move(x));
    if (!with_phase_.empty()) signals.push_back(std::move(phase));
  }

  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues&,
                             Eigen::VectorXd& outputs) const override {
    return fill(model, outputs, [&](std::size_t i) {
      return sim::steady_state(driven(model, levels_[i], by_force_), options(model));
    });
  }

  [[nodiscard]] std::vector<std::pair<double, double>> levels() const override {
    std::vector<std::pair<double, double>> list;
    for (const Level& level : levels_) list.emplace_back(level.Y, level.omega);
    return list;
  }

  [[nodiscard]] std::unique_ptr<Experiment> balanced() const override {
    return balanced_states(*this, with_phase_);
  }

  [[nodiscard]] std::unique_ptr<Neighbours> neighbours(const sim::Model& model, const RecordValues&,
                                                       const Neighbours* near,
                                                       Eigen::VectorXd& outputs) const override {
    auto found = std::make_unique<Near>(*this, model, dynamic_cast<const Near*>(near), outputs);
    return found->is_complete() ? std::move(found) : nullptr;
  }

 private:
  /// Steady states by Newton's method from known orbits.
  class Near final : public Neighbours {
   public:
    Near(const SteadyStates& states, const sim::Model& model, const Near* from, Eigen::VectorXd& outputs)
        : states_(states),
          is_smooth_(std::ranges::any_of(model.friction, [](const auto& law) { return !law.is_affine(); })) {
      is_complete_ = states_.fill(model, outputs, [&](std::size_t i) {
        const sim::Model there = driven(model, states_.levels_[i], states_.by_force_);
        sim::SteadyStateOptions options = states_.options(model);
        if (from != nullptr) {
          options = limited(options, from->orbits_[i]);
          sim::SteadyState state = sim::steady_state_near(from->orbits_[i], there, options);
          if (!state.outcome.ok()) return state;
          sim::KnownOrbit orbit = sim::known_orbit(there, state);
          // The motion of a model farther away may have left the orbit that was followed to it.
          if (sim::attracts(orbit)) {
            orbits_.push_back(std::move(orbit));
            return state;
          }
        }
        sim::SteadyState state = sim::steady_state(there, options);
        if (state.outcome.ok()) orbits_.push_back(sim::known_orbit(there, state));
        return state;
      });
    }
    [[nodiscard]] bool is_complete() const { return is_complete_; }
    /// The orbits of laws of the exact engine are found in no time from nothing.
    [[nodiscard]] bool is_worth_using() const override { return is_smooth_; }
    [[nodiscard]] bool predict(const sim::Model& model, const RecordValues&, double share,
                               Eigen::VectorXd& outputs) const override {
      return states_.fill(model, outputs, [&](std::size_t i) {
        return sim::steady_state_near(orbits_[i], driven(model, states_.levels_[i], states_.by_force_),
                                      limited(states_.options(model), orbits_[i]), share);
      });
    }

   private:
    /// A step of a search may lead to a place whose motions take hundreds of times the work of those where it is: a
    /// mass that a bristle of a million times the stiffness holds. Such a place has no motion; the search then
    /// makes a shorter step.
    static sim::SteadyStateOptions limited(sim::SteadyStateOptions options, const sim::KnownOrbit& orbit) {
      constexpr long most_periods = 1000;
      if (orbit.work > 0) options.most_work = most_periods * orbit.work;
      return options;
    }

    const SteadyStates& states_;
    bool is_smooth_;
    bool is_complete_ = false;
    std::vector<sim::KnownOrbit> orbits_;
  };

  [[nodiscard]] sim::SteadyStateOptions options(const sim::Model& model) const {
    sim::SteadyStateOptions options;
    options.tolerance = std::max(options.tolerance, 1e-2 * model.solver.tolerance);
    options.max_periods = 2000;
    options.detail = with_phase_.empty() ? sim::OrbitDetail::extremes : sim::OrbitDetail::phase;
    options.others = false;
    return options;
  }

  /// A mass that is hardly moved slips in the moments of the largest pull: a square wave, a quarter period behind
  /// it.
  [[nodiscard]] double lag_at_rest(const sim::Model& model, const Level& level) const {
    const sim::Oscillator& o = model.oscillator;
    const bool through_damper = !by_force_ && o.damper_to == sim::DamperTo::base;
    return 0.5 * std::numbers::pi - (through_damper ? std::atan2(o.damping * level.omega, o.stiffness) : 0.0);
  }

  template <typename Find>
  bool fill(const sim::Model& model, Eigen::VectorXd& outputs, Find find) const {
    outputs.resize(size());
    std::size_t phases = 0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const sim::SteadyState state = find(i);
      *work += state.certificate.work();
      if (!state.outcome.ok()) return false;
      outputs[static_cast<Eigen::Index>(i)] = state.amplitude;
      if (phases == with_phase_.size() || with_phase_[phases] != i) continue;
      // The phase that is nearest to the measured one, modulo 2 pi. A mass at rest has the phase with which its
      // motion dies out, when the friction reaches the largest pull: else the phase would jump there.
      const double measured = signals[1].measured[phases];
      const double lag = std::isnan(state.phase) ? lag_at_rest(model, levels_[i]) : state.phase;
      outputs[static_cast<Eigen::Index>(levels_.size() + phases)] = measured + core::wrapped(lag - measured);
      ++phases;
    }
    return true;
  }

  std::vector<Level> levels_;
  std::vector<std::size_t> with_phase_;  ///< indices of the levels with a measured phase
  bool by_force_;
};

}  // namespace

std::unique_ptr<Experiment> steady_states(const PairRecord& record, const ExperimentOptions& options,
                                          std::string& fault) {
  PairRecord usable;
  for (const Pair& pair : record.pairs) {
    if (std::isnan(pair.omega) && std::isnan(options.frequency)) {
      fault = "x-Y pairs need the forcing frequency at which they were measured";
      return nullptr;
    }
    if (pair.Y > 0.0) usable.pairs.push_back(pair);
  }
  if (usable.pairs.empty()) {
    fault = "the record holds no pair with a positive input amplitude";
    return nullptr;
  }
  return std::make_unique<SteadyStates>(usable, options);
}

}  // namespace dualdamp::identify
