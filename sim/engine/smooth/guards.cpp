#include "sim/engine/smooth/guards.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// A dashpot that lets a speed die out within this part of 1/omega is a steep one. Then the sign of the forces is
/// that of the speed but for a time whose square is below rounding.
constexpr double steep = 1e-6;

}  // namespace

Guards::Guards(const Model& model, const Flow& flow)
    : model_(model), flow_(flow), omega_(natural_frequency(model.oscillator)) {
  for (const friction::Law& law : model.friction) {
    has_memory_.push_back(law.has_memory());
    some_memory_ = some_memory_ || law.has_memory();
    can_stick_ = can_stick_ || law.holds_mass();
  }
}

void Guards::list(std::span<const double> X, double t) {
  endings_.clear();
  if (flow_.direction() != Direction::none) {
    endings_.emplace_back(SlipEnd{});
  } else if (can_stick_) {
    for (const Direction release : {Direction::forward, Direction::backward})
      endings_.emplace_back(StickEnd{release});
  }
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (!has_memory_[i]) continue;
    values_.clear();
    flow_.guards(i, X, t, values_);
    for (std::size_t j = 0; j < values_.size(); ++j) endings_.emplace_back(LawGuard{i, static_cast<int>(j)});
  }
}

void Guards::evaluate(std::span<const double> X, double t, std::vector<double>& values) const {
  values.clear();
  if (flow_.direction() != Direction::none) {
    values.push_back(speed_in_direction(X, t));
  } else if (can_stick_) {
    const double pull = flow_.pull(X, t);
    const double limit = flow_.limit(X, t);
    values.push_back(limit - pull);
    values.push_back(limit + pull);
  }
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (has_memory_[i]) flow_.guards(i, X, t, values);
  }
}

double Guards::value(std::size_t guard, std::span<const double> X, double t) const {
  evaluate(X, t, values_);
  return values_[guard];
}

/// Of the mass if its speed were `speed`, in its direction [m/s^2].
double Guards::acceleration_at(double speed, std::span<const double> X, double t) const {
  const double sign = friction::sign(flow_.direction());
  slowed_.assign(X.begin(), X.end());
  slowed_[1] = sign * speed;
  slowed_rates_.resize(X.size());
  flow_.evaluate(slowed_, t, slowed_rates_);
  return sign * slowed_rates_[1];
}

/// The time within which a speed that steps do not know dies out [s]; 0: the mass does not creep.
double Guards::relaxation(std::span<const double> X, double t) const {
  if (flow_.direction() == Direction::none) return 0.0;
  const bool against = friction::sign(flow_.direction()) * X[1] < 0.0;
  const double least = std::max(model_.solver.tolerance * flow_.scales()[1], against ? resolved_ : 0.0);
  if (!(std::abs(X[1]) <= least)) return 0.0;
  const double faster = acceleration_at(least, X, t);
  if (!(faster < 0.0)) return 0.0;
  const double slower = acceleration_at(-least, X, t);
  if (!(slower > 0.0)) return 0.0;
  const double time = 2.0 * least / (slower - faster);
  return time * omega_ < steep ? time : 0.0;
}

bool Guards::would_creep(std::span<const double> X, double t) const { return relaxation(X, t) > 0.0; }

bool Guards::creeps(std::span<const double> X, double t) const { return passes_over_ && would_creep(X, t); }

bool Guards::creeps_backward(std::span<const double> X, double t) const {
  return friction::sign(flow_.direction()) * X[1] < 0.0 && creeps(X, t);
}

/// The speed in the direction of the slip, or what stands for it while the mass creeps [m/s].
double Guards::speed_in_direction(std::span<const double> X, double t) const {
  const double late = passes_over_ ? relaxation(X, t) : 0.0;
  if (late == 0.0) return friction::sign(flow_.direction()) * X[1];
  const double most = flow_.scales()[1];
  return std::clamp(forced_speed(X, t - late), -most, most);
}

double Guards::forced_speed(std::span<const double> X, double t) const {
  return acceleration_at(0.0, X, t) / omega_;
}

double Guards::rate(std::size_t guard, std::span<const double> X, double t, double length) const {
  rates_.resize(X.size());
  flow_.evaluate(X, t, rates_);
  if (is<SlipEnd>(endings_[guard])) {
    if (!creeps(X, t)) return friction::sign(flow_.direction()) * rates_[1];
    rates_[1] = 0.0;
  }
  const double step = part_of_rate * length;
  const auto value_after = [&](double s) {
    displaced_.assign(X.begin(), X.end());
    for (std::size_t k = 0; k < displaced_.size(); ++k) displaced_[k] += s * rates_[k];
    return value(guard, displaced_, t + s);
  };
  const double above = value_after(step);
  return (above - value_after(-step)) / (2.0 * step);
}

}  // namespace dualdamp::sim
