#include "identify/experiments/tie.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/constants.hpp"
#include "identify/experiments/drive_values.hpp"
#include "identify/records/signals.hpp"
#include "identify/statistics/decompositions.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::identify {

namespace {

/// Value and slope at sample `at` of a parabola through the samples within `reach` of it.
std::pair<double, double> parabola_at(const std::vector<double>& signal, double rate, std::size_t at,
                                      std::size_t reach) {
  const std::size_t first = at > reach ? at - reach : 0;
  const std::size_t last = std::min(signal.size() - 1, at + reach);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(last - first + 1), 3);
  Eigen::VectorXd target(columns.rows());
  for (std::size_t i = first; i <= last; ++i) {
    const double s = (static_cast<double>(i) - static_cast<double>(at)) / static_cast<double>(reach);
    columns.row(static_cast<Eigen::Index>(i - first)) << 1.0, s, s * s;
    target[static_cast<Eigen::Index>(i - first)] = signal[i];
  }
  const Eigen::VectorXd found = pivoted_least_squares(columns, target);
  return {found[0], found[1] * rate / static_cast<double>(reach)};
}

/// Force of the drive on the mass at increasing times.
std::vector<double> drive_force(const sim::Model& model, const std::vector<double>& times) {
  const double through_damper = model.oscillator.damper_to == sim::DamperTo::base ? model.oscillator.damping : 0.0;
  DriveValues drive = drive_values(model, times);
  for (std::size_t i = 0; i < times.size(); ++i)
    drive.force[i] += model.oscillator.stiffness * drive.y[i] + through_damper * drive.y_rate[i];
  return std::move(drive.force);
}

}  // namespace

Tie::Tie(const MeasuredSamples& samples, double frequency, double strength)
    : strength_(strength), follows_x_(!samples.x.empty()), begins_with_v_(samples.x.empty() && samples.v.empty()) {
  const std::vector<double> velocity = begins_with_v_ ? running_integral(samples.a, samples.rate) : samples.v;
  const std::size_t count = std::max({samples.x.size(), velocity.size()});
  constexpr double nodes_of_swing = 24.0;
  const double apart = core::two_pi * samples.rate / (frequency * nodes_of_swing);
  const std::size_t stride =
      std::clamp<std::size_t>(static_cast<std::size_t>(apart), 1, std::max<std::size_t>(1, count / 4));
  const std::size_t reach = std::max<std::size_t>(2, stride);
  for (std::size_t i = 0; i < count; i = i + 1 == count ? count : std::min(i + stride, count - 1)) {
    times_.push_back(static_cast<double>(i) / samples.rate);
    std::pair<double, double> of_x;
    if (follows_x_) of_x = parabola_at(samples.x, samples.rate, i, reach);
    x_.push_back(of_x.first);
    v_.push_back(velocity.empty() ? of_x.second : parabola_at(velocity, samples.rate, i, reach).first);
  }
}

std::optional<sim::Model> Tie::tied(const sim::Model& model, const RecordValues& of_record) const {
  // With a nonlinear spring, the force that a moving base exerts depends on the motion of the mass.
  if (!sim::is_linear(model.oscillator) && model.excitation.moves_base()) return std::nullopt;
  const sim::Oscillator& o = model.oscillator;
  const double spring = follows_x_ ? strength_ * o.stiffness : 0.0;
  const double damper = 2.0 * std::sqrt(strength_ * o.mass * o.stiffness);
  const double offset = of_record[RecordParameter::offset];
  const double begin =
      begins_with_v_ ? of_record[RecordParameter::velocity] : -of_record[RecordParameter::offset_v];
  const double drift = begins_with_v_ ? of_record[RecordParameter::offset_a] : 0.0;
  std::vector<double> force = drive_force(model, times_);
  for (std::size_t i = 0; i < times_.size(); ++i)
    force[i] += spring * (x_[i] - offset) + damper * (v_[i] + begin - drift * times_[i]);
  sim::Model tied = model;
  tied.oscillator.stiffness += spring;
  tied.oscillator.damping += damper;
  tied.oscillator.damper_to = sim::DamperTo::ground;
  tied.excitation = {
      .type = sim::ExcitationType::force_samples,
      .samples = std::make_shared<sim::SampledSignal>(times_, std::move(force), sim::Interpolation::cubic)};
  return tied;
}

}  // namespace dualdamp::identify
