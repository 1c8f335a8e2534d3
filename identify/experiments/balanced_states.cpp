#include "identify/experiments/balanced_states.hpp"

#include <cmath>
#include <complex>
#include <utility>

#include "core/angle.hpp"
#include "core/constants.hpp"

namespace dualdamp::identify {

namespace {

using namespace std::complex_literals;

constexpr std::size_t samples_of_period = 64;
/// A contact forgets its unloaded start in the first periods; the last one counts.
constexpr std::size_t periods = 3;

/// Between the turning points: there a sample would count as a rest.
double angle_of(std::size_t sample) {
  return core::two_pi * (static_cast<double>(sample) + 0.5) / static_cast<double>(samples_of_period);
}

/// The motion of one steady state as a loop, whose force is to be predicted.
std::unique_ptr<Experiment> sine_loop(double amplitude, double omega) {
  constexpr std::size_t count = periods * samples_of_period;
  History history{.sample_rate = static_cast<double>(samples_of_period) * omega / core::two_pi};
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = angle_of(i);
    history.x.push_back(amplitude * std::cos(angle));
    history.v.push_back(-amplitude * omega * std::sin(angle));
    history.a.push_back(-omega * omega * history.x.back());
  }
  history.force = history.x;  // a loop has one; it is not compared
  std::string fault;
  return friction_loop(history, {.loop = true, .has_mass = true}, fault);
}

/// The first harmonic of the last period: z of Re(z e^{i w t}).
std::complex<double> first_harmonic(const Eigen::VectorXd& force) {
  std::complex<double> sum = 0.0;
  const auto begin = static_cast<std::size_t>(force.size()) - samples_of_period;
  for (std::size_t i = 0; i < samples_of_period; ++i)
    sum += force[static_cast<Eigen::Index>(begin + i)] * std::polar(1.0, -angle_of(i));
  return 2.0 / static_cast<double>(samples_of_period) * sum;
}

class BalancedStates final : public Experiment {
 public:
  BalancedStates(const Experiment& states, std::vector<std::size_t> with_phase)
      : Experiment(states), levels_(states.levels()), with_phase_(std::move(with_phase)) {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double x = signals.front().measured[i];
      loops_.push_back(x > 0.0 ? sine_loop(x, levels_[i].second) : nullptr);
      if (loops_.back()) loops_.back()->work = work;
    }
  }

  [[nodiscard]] std::vector<std::pair<double, double>> levels() const override { return levels_; }

  [[nodiscard]] bool predict(const sim::Model& model, const RecordValues&,
                             Eigen::VectorXd& outputs) const override {
    if (!is_force_driven && !sim::is_linear(model.oscillator)) return false;
    outputs.resize(size());
    std::size_t phases = 0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double x = signals.front().measured[i];
      std::complex<double> drive = gain(model, i) * levels_[i].first;
      std::complex<double> needed = drive;
      if (loops_[i] && !add_needed(model, i, needed)) return false;
      outputs[static_cast<Eigen::Index>(i)] = x * (2.0 - std::abs(needed) / std::abs(drive));
      if (phases == with_phase_.size() || with_phase_[phases] != i) continue;
      const double measured = signals[1].measured[phases];
      outputs[static_cast<Eigen::Index>(levels_.size() + phases)] =
          measured + core::wrapped(std::arg(needed / drive) - measured);
      ++phases;
    }
    return outputs.allFinite();
  }

 private:
  /// Force on the mass over what drives it: of a base, through spring and damper.
  [[nodiscard]] std::complex<double> gain(const sim::Model& model, std::size_t i) const {
    if (is_force_driven) return 1.0;
    const sim::Oscillator& o = model.oscillator;
    return o.stiffness * (1.0 + 1.0i * o.loss_factor) +
           (o.damper_to == sim::DamperTo::base ? 1.0i * o.damping * levels_[i].second : 0.0);
  }

  /// The first harmonic of the force that moves the mass as it was measured.
  [[nodiscard]] bool add_needed(const sim::Model& model, std::size_t i, std::complex<double>& needed) const {
    Eigen::VectorXd force;
    if (!loops_[i]->predict(model, {}, force)) return false;
    needed = first_harmonic(force) +
             1.0i * model.oscillator.loss_factor * model.oscillator.stiffness * signals.front().measured[i];
    return true;
  }

  std::vector<std::pair<double, double>> levels_;  ///< amplitude and frequency of the drive
  std::vector<std::size_t> with_phase_;
  Experiments loops_;  ///< null for a mass that does not move
};

}  // namespace

std::unique_ptr<Experiment> balanced_states(const Experiment& states, std::vector<std::size_t> with_phase) {
  return std::make_unique<BalancedStates>(states, std::move(with_phase));
}

}  // namespace dualdamp::identify
