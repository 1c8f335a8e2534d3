#include "sim/engine/flow.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "friction_models/state_sizes.hpp"

namespace dualdamp::sim {

using friction::Direction;
using friction::Instant;
using friction::Memory;

namespace {

/// Relative increment of a difference at which truncation and rounding are equal.
constexpr double increment = 1.5e-8;
/// Of a law that is affine in each mode: there is no truncation, and the rounding of a slope is 1e-12 of it.
constexpr double affine_increment = 1e-4;

/// Laws may change over speeds down to this part of the largest one: the scale of Stribeck curves.
constexpr double slow = 0.01;

/// The displacement of a speed is shortened by this factor at a time, down to this part of the largest speed.
constexpr double ladder = 100.0;
constexpr double least_speed = 1e-40;

/// Speeds below this part of the largest one are rounding.
constexpr double rounded = 1e-13;

/// A change of force by this part of it or more is not rounding.
constexpr double resolved = 1e-11;

/// A slope by the speed that grows by more than this part over a shorter step, and by more than rounding, is not
/// yet the slope at the speed.
constexpr double grown = 1e-6;
constexpr double rounding_of_force = 16.0 * std::numeric_limits<double>::epsilon();

/// Slopes over two steps, one ten times the other, are equal within this part of them.
constexpr double nearly_equal = 1e-3;

/// The displacement of a state is shortened by this factor at a time, down to this part of the state. A state that
/// is smaller than this part of its size counts as such a part.
constexpr double ladder_of_states = 10.0;
constexpr double least_state = 1e-15;

}  // namespace

Flow::Flow(const Model& model, const Drive& drive, const VelocityHistory& past)
    : model_(model), drive_(drive), past_(past) {
  for (const friction::Law& law : model_.friction) is_delayed_ = is_delayed_ || law.delay() > 0.0;
  is_harmonic_ = model_.excitation.is_harmonic();
  first_.resize(model_.friction.size());
  count_.resize(model_.friction.size());
  scales_.assign(2, 1.0);
}

void Flow::freeze(const std::vector<Memory>& memories, Direction direction, double offset) {
  memories_ = memories;
  direction_ = direction;
  offset_ = offset;
  past_frame_ = past_.frame();
  size_ = 2;
  for (std::size_t i = 0; i < memories.size(); ++i) {
    first_[i] = size_;
    count_[i] = memories[i].state.size();
    size_ += count_[i];
  }
  own_scales_.assign(size_, 0.0);
  for (std::size_t i = 0; i < memories.size(); ++i)
    model_.friction[i].scales(memories[i], std::span(own_scales_).subspan(first_[i], count_[i]));
  set_scales(scales_[0], scales_[1]);
}

void Flow::set_scales(double x, double v) {
  scales_.resize(size_);
  scales_[0] = x;
  scales_[1] = v;
  for (std::size_t k = 2; k < size_; ++k) {
    const double own = own_scales_[k];
    scales_[k] = own == friction::size_of_velocity ? v : own > 0.0 ? own : x;
  }
}

void Flow::gather(double x, double v, const std::vector<Memory>& memories, std::vector<double>& X) const {
  X.resize(size_);
  X[0] = x;
  X[1] = v;
  for (std::size_t i = 0; i < memories.size(); ++i)
    std::ranges::copy(memories[i].state, X.begin() + static_cast<std::ptrdiff_t>(first_[i]));
}

void Flow::scatter(std::span<const double> X, std::vector<Memory>& memories) const {
  for (std::size_t i = 0; i < memories.size(); ++i)
    std::ranges::copy(X.subspan(first_[i], count_[i]), memories[i].state.begin());
}

const Memory& Flow::memory(std::size_t i, std::span<const double> X) const {
  std::vector<double>& state = memories_[i].state;
  for (std::size_t k = 0; k < count_[i]; ++k) state[k] = X[first_[i] + k];
  return memories_[i];
}

/// The instant that is the same for all laws.
Instant Flow::instant(std::span<const double> X, double t) const {
  Instant now{.t = offset_ + t, .x = X[0], .v = X[1]};
  if (is_harmonic_) {
    now.angle_rate = model_.excitation.frequency;
    now.angle = now.angle_rate * t;
  }
  return now;
}

/// Adds the past velocity for law i.
void Flow::remember(std::size_t i, Instant& now, double t) const {
  if (!is_delayed_) return;
  const double delay = model_.friction[i].delay();
  if (delay > 0.0) now.past_velocity = past_.at(t - delay, past_frame_);
}

Instant Flow::instant(std::size_t i, std::span<const double> X, double t) const {
  Instant now = instant(X, t);
  remember(i, now, t);
  return now;
}

/// The force of `law`, a function of the instant. For a force in proportion to a power of speed below 1 the slope
/// has no bound at rest: a mass that such a force nearly holds creeps at the tenth or the fiftieth power of the
/// pull. So a force without states that rises with speed is taken as linear up to the slowest speed above rounding.
/// A force that falls with speed lets the mass go at once and is not changed.
template <class Force>
double Flow::resolved_force(std::size_t i, const Instant& now, const Force& law) const {
  const double slowest = rounded * scales_[1];
  if (count_[i] > 0 || direction_ == Direction::none || !(std::abs(now.v) < slowest)) return law(now);
  Instant other = now;
  other.v = 0.0;
  const double at_rest = law(other);
  other.v = friction::sign(direction_) * slowest;
  const double rise = law(other) - at_rest;
  if (!(friction::sign(direction_) * rise > 0.0)) return law(now);
  return at_rest + friction::sign(direction_) * now.v / slowest * rise;
}

double Flow::respond(std::size_t i, std::span<const double> X, const Instant& now, std::span<double> rates) const {
  ++responses_;
  const Memory& remembered = memory(i, X);
  return resolved_force(
      i, now, [&](const Instant& then) { return model_.friction[i].respond(remembered, then, direction_, rates); });
}

const Drive::Value& Flow::drive(double t) const {
  constexpr std::uint64_t spread = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio: neighbours fall far apart
  static_assert(std::tuple_size_v<decltype(known_drives_)> == 64);
  KnownDrive& known = known_drives_[std::bit_cast<std::uint64_t>(t) * spread >> 58];
  if (!(known.t == t && known.piece == drive_.piece())) known = {t, drive_.piece(), drive_.at(t)};
  return known.value;
}

/// Spring, damper and external force on the mass.
double Flow::driving(double x, double v, const Drive::Value& drive) const {
  const Oscillator& o = model_.oscillator;
  const double stretch = drive.y - x;
  const double damper_speed = o.damper_to == DamperTo::base ? drive.y_rate - v : -v;
  return spring_force(o, stretch) + o.damping * damper_speed + drive.external;
}

void Flow::evaluate(std::span<const double> X, double t, std::span<double> rates) const {
  double force = 0.0;
  Instant now = instant(X, t);
  for (std::size_t i = 0; i < first_.size(); ++i) {
    remember(i, now, t);
    force += respond(i, X, now, rates.subspan(first_[i], count_[i]));
  }
  move(X, t, force, rates);
}

/// The rates of the mass on which friction acts with this force.
void Flow::move(std::span<const double> X, double t, double force, std::span<double> rates) const {
  if (direction_ == Direction::none) {
    rates[0] = rates[1] = 0.0;
    return;
  }
  rates[0] = X[1];
  rates[1] = (driving(X[0], X[1], drive(t)) - force) / model_.oscillator.mass;
}

/// Differences of the law over a step from X, where its rates are base_rates_: of the rates,
/// in displaced_rates_, and of the force.
Flow::Slope Flow::difference(const Derivative& d, double step) const {
  displaced_.assign(d.X.begin(), d.X.end());
  displaced_[d.column] += step;
  const double exact_step = displaced_[d.column] - d.X[d.column];
  const double force = respond(d.law, displaced_, instant(d.law, displaced_, d.t), displaced_rates_);
  for (std::size_t k = 0; k < count_[d.law]; ++k)
    displaced_rates_[k] = (displaced_rates_[k] - base_rates_[k]) / exact_step;
  const double change = force - d.force;
  return {change / exact_step, std::abs(change) > resolved * (std::abs(force) + std::abs(d.force))};
}

/// The slopes of all rates of the law, and behind them that of its force, from a difference to both sides.
void Flow::slopes(const Derivative& d, double step, std::vector<double>& of_rates_and_force) const {
  const std::size_t count = count_[d.law];
  of_rates_and_force.assign(count + 1, 0.0);
  for (const double change : {step, -step}) {
    const double of_force = difference(d, change).value;
    for (std::size_t k = 0; k < count; ++k) of_rates_and_force[k] += 0.5 * displaced_rates_[k];
    of_rates_and_force[count] += 0.5 * of_force;
  }
}

/// The slopes of the law by a state: of the rates, in displaced_rates_, and of the force, returned. `slope` and
/// displaced_rates_: those over `step`. After a long slip the bristles of dahl with an exponent other than 1 are
/// closer to their limit than the usual step is long, and the slope over it is a multiple of the slope there. So
/// each slope is that over the step at which a step ten times as long changes it least.
double Flow::closer(const Derivative& d, double step, double slope) const {
  const double shortest = least_state * std::max(std::abs(d.X[d.column]), least_state * scales_[d.column]);
  const std::size_t rates = count_[d.law];
  const std::size_t count = rates + 1;
  closest_slopes_.assign(displaced_rates_.begin(), displaced_rates_.end());
  closest_slopes_.push_back(slope);
  shorter_slopes_ = closest_slopes_;
  slopes(d, ladder_of_states * step, last_slopes_);
  apart_.assign(count, std::numeric_limits<double>::infinity());
  for (;;) {
    bool are_equal = true;
    for (std::size_t k = 0; k < count; ++k) {
      const double found = shorter_slopes_[k];
      const double larger = std::max(std::abs(found), std::abs(last_slopes_[k]));
      const double apart = larger > 0.0 ? std::abs(found - last_slopes_[k]) / larger : 0.0;
      const double value = k < rates ? base_rates_[k] : d.force;
      if (apart < apart_[k] && (std::isinf(apart_[k]) || std::abs(found * step) > resolved * std::abs(value))) {
        apart_[k] = apart;
        closest_slopes_[k] = found;
      }
      are_equal = are_equal && apart_[k] < nearly_equal;
    }
    step /= ladder_of_states;
    if (are_equal || !(step > shortest)) break;
    std::swap(last_slopes_, shorter_slopes_);
    slopes(d, step, shorter_slopes_);
  }
  std::ranges::copy_n(closest_slopes_.begin(), static_cast<std::ptrdiff_t>(rates), displaced_rates_.begin());
  return closest_slopes_.back();
}

/// The contribution of the law to one column of the Jacobian.
void Flow::differentiate_law(const Derivative& d, bool closely, std::span<double> columns) const {
  const bool by_speed = d.column == 1;
  const double own = std::abs(d.X[d.column]);
  const bool affine = model_.friction[d.law].is_affine();
  double step =
      (affine ? affine_increment : increment) * (own + (by_speed ? slow * scales_[1] : scales_[d.column]));
  double slope = difference(d, step).value;
  if (closely && d.column > 1 && !affine) slope = closer(d, step, slope);
  // Friction that depends on the logarithm of the speed is a steep dashpot at speeds far below the largest one. So
  // the step is shortened until the slope no longer grows.
  const double shortest = std::max(increment * own, least_speed * scales_[1]);
  while (by_speed && !affine && step > ladder * shortest) {
    step = std::max(shortest, step / ladder);
    const Slope steeper = difference(d, step);
    const double known = std::max(grown, rounding_of_force * std::abs(d.force / (steeper.value * step)));
    if (!steeper.resolved || !(std::abs(steeper.value) > (1.0 + known) * std::abs(slope))) break;
    slope = steeper.value;
  }
  const std::span<double> target = columns.subspan(d.column * size_, size_);
  if (direction_ != Direction::none) target[1] -= slope / model_.oscillator.mass;
  for (std::size_t k = 0; k < count_[d.law]; ++k) target[first_[d.law] + k] = displaced_rates_[k];
}

void Flow::jacobian(std::span<const double> X, double t, std::span<double> columns) const {
  differentiate(X, t, false, {}, columns);
}

void Flow::linearize(std::span<const double> X, double t, std::span<double> rates,
                     std::span<double> columns) const {
  differentiate(X, t, false, rates, columns);
}

void Flow::close_jacobian(std::span<const double> X, double t, std::span<double> columns) const {
  differentiate(X, t, true, {}, columns);
}

/// Empty `rates` are not wanted.
void Flow::differentiate(std::span<const double> X, double t, bool closely, std::span<double> rates,
                         std::span<double> columns) const {
  const Oscillator& o = model_.oscillator;
  std::ranges::fill(columns, 0.0);
  if (direction_ != Direction::none) {
    const double stretch = drive(t).y - X[0];
    columns[1] = -spring_slope(o, stretch) / o.mass;
    columns[size_] = 1.0;
    columns[size_ + 1] = -o.damping / o.mass;
  }
  double force = 0.0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    base_rates_.assign(count_[i], 0.0);
    displaced_rates_.assign(count_[i], 0.0);
    const double of_law = respond(i, X, instant(i, X, t), base_rates_);
    force += of_law;
    if (!rates.empty()) std::ranges::copy(base_rates_, rates.subspan(first_[i], count_[i]).begin());
    const auto differentiate_by = [&](std::size_t column) {
      differentiate_law({.law = i, .column = column, .X = X, .t = t, .force = of_law}, closely, columns);
    };
    differentiate_by(0);
    differentiate_by(1);
    for (std::size_t k = 0; k < count_[i]; ++k) differentiate_by(first_[i] + k);
  }
  if (!rates.empty()) move(X, t, force, rates);
}

/// Sum of the laws' forces.
double Flow::resisting(std::span<const double> X, double t) const {
  double force = 0.0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    force += resolved_force(i, instant(i, X, t), [&](const Instant& now) {
      return model_.friction[i].force(memory(i, X), now, direction_);
    });
  }
  return force;
}

double Flow::pull(std::span<const double> X, double t) const {
  return driving(X[0], 0.0, drive(t)) - resisting(X, t);
}

double Flow::limit(std::span<const double> X, double t) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    if (model_.friction[i].holds_mass()) sum += model_.friction[i].static_limit(memory(i, X), instant(i, X, t));
  }
  return sum;
}

void Flow::guards(std::size_t i, std::span<const double> X, double t, std::vector<double>& values) const {
  model_.friction[i].guards(memory(i, X), instant(i, X, t), direction_, values);
}

Sample Flow::sample(std::span<const double> X, double t) const {
  const Drive::Value& now = drive(t);
  Sample sample{.t = offset_ + t, .y = now.y, .y_rate = now.y_rate, .x = X[0], .external = now.external};
  if (direction_ == Direction::none) {
    // Friction balances all other forces.
    sample.force = driving(X[0], 0.0, now);
    return sample;
  }
  sample.v = X[1];
  sample.force = resisting(X, t);
  sample.a = (driving(X[0], X[1], now) - sample.force) / model_.oscillator.mass;
  return sample;
}

}  // namespace dualdamp::sim
