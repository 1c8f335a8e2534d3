#include "identify/models/sampled_oscillator.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/cancellation.hpp"
#include "identify/models/series.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/drive_steps.hpp"
#include "sim/engine/sticking_gate.hpp"

namespace dualdamp::identify {

namespace {

constexpr int nodes = SampledOscillator::nodes;

/// The same polynomial in powers of u - by.
std::array<double, nodes> shifted(std::array<double, nodes> p, double by) {
  for (std::size_t i = 0; i + 1 < nodes && by != 0.0; ++i)
    for (std::size_t j = nodes - 1; j-- > i;) p[j] += by * p[j + 1];
  return p;
}

/// Chebyshev's points of (0, 1).
const std::array<double, nodes>& places() {
  static const std::array<double, nodes> points = [] {
    std::array<double, nodes> all{};
    for (int i = 0; i < nodes; ++i)
      all[static_cast<std::size_t>(i)] = 0.5 - 0.5 * std::cos(std::numbers::pi * (i + 0.5) / nodes);
    return all;
  }();
  return points;
}

using AtNodes = Eigen::Array<double, nodes, 1>;

/// Their powers: row i holds those of place i.
template <int powers>
const Eigen::Array<double, nodes, powers>& powers_of_places() {
  static const Eigen::Array<double, nodes, powers> all = [] {
    Eigen::Array<double, nodes, powers> table;
    for (int i = 0; i < nodes; ++i)
      for (int j = 0; j < powers; ++j) table(i, j) = std::pow(places()[static_cast<std::size_t>(i)], j);
    return table;
  }();
  return all;
}

}  // namespace

SampledOscillator::SampledOscillator(const History& history) : SampledOscillator(history, drive_steps(history)) {}

SampledOscillator::SampledOscillator(const History& history, std::vector<std::size_t> steps)
    : count_(history.x.size()),
      rate_(history.sample_rate),
      steps_(std::move(steps)),
      y_(history.y, steps_, count_),
      force_(history.force, steps_, count_) {}

bool SampledOscillator::run(const Parameters& parameters, const std::vector<By>& by, Eigen::VectorXd& x,
                            Derivatives* derivatives, Eigen::VectorXd* v, const std::vector<Force>& forces) {
  p_ = parameters;
  inertia_ = p_.m * rate_ * rate_;
  damping_ = p_.c * rate_;
  const double stiffest = p_.k + (yields() ? p_.F0 / p_.yield : 0.0);
  const double fastest = std::max(std::sqrt(stiffest / inertia_), std::abs(damping_) / inertia_);
  if (!(fastest < 2.0)) return false;
  // Under a drive of degree seven all further terms are those of the oscillator's own motion, which decrease.
  terms_ = nodes + 3;
  for (double left = std::pow(fastest, terms_) / std::tgamma(terms_ + 1.0); left > 1e-18 && terms_ < most_terms;
       ++terms_)
    left *= fastest / (terms_ + 1);
  for (int j = 0; j < most_terms; ++j)
    integration_[static_cast<std::size_t>(j)] = 1.0 / (inertia_ * (j + 1) * (j + 2));

  acting_.clear();
  for (std::size_t j = 0; j < p_.further.size(); ++j)
    if (p_.further[j] != 0.0) acting_.push_back({&forces[j], p_.further[j]});
  tangents_ = {};
  if (derivatives != nullptr) {
    start_tangents(by, forces, derivatives->with_steps);
    derivatives->x.resize(static_cast<Eigen::Index>(count_), static_cast<Eigen::Index>(by.size() + forces.size()));
    derivatives->v.resizeLike(derivatives->x);
    derivatives->a.resize(derivatives->x.rows());
    derivatives->steps.clear();
    if (derivatives->with_steps) derivatives->steps.reserve(count_);
  }
  x.resize(static_cast<Eigen::Index>(count_));
  if (v != nullptr) v->resize(x.size());
  x_ = p_.x0;
  v_ = p_.v0 / rate_;
  fastest_ = std::abs(v_);
  next_step_ = 0;
  direction_ = (v_ > 0.0) - (v_ < 0.0);
  // A mass that moves at the start has slid far before the record began.
  constexpr double far = 1e3;
  reversal_ = direction_ == 0 ? x_ : x_ + far;
  start_contact();
  for (std::size_t i = 0; i + 1 < count_; ++i) {
    core::stop_if_cancelled();
    store(i, x, derivatives, v);
    if (!walk_interval(i)) return false;
  }
  store(count_ - 1, x, derivatives, v);
  return x.allFinite();
}

/// Stores the present state as that of a sample.
void SampledOscillator::store(std::size_t sample, Eigen::VectorXd& x, Derivatives* derivatives,
                              Eigen::VectorXd* v) {
  const auto row = static_cast<Eigen::Index>(sample);
  x[row] = x_;
  if (v != nullptr) (*v)[row] = v_ * rate_;
  if (derivatives == nullptr) return;
  derivatives->x.row(row) = tangents_.x.head(derivatives->x.cols()).transpose();
  derivatives->v.row(row) = tangents_.v.head(derivatives->v.cols()).transpose() * rate_;
  derivatives->a[row] = acceleration(sample);
  if (derivatives->with_steps) store_step(derivatives->steps);
}

/// Of the present state, which is that of a sample.
double SampledOscillator::acceleration(std::size_t sample) const {
  if (direction_ == 0) return 0.0;
  const std::size_t interval = std::min(sample, count_ - 2);
  const double at = sample == interval ? 0.0 : 1.0;
  Instant here;
  here.x = x_;
  here.v = v_ * rate_;
  here.direction = direction_;
  const bool is_after = at > 0.0 && !steps_.empty() && steps_.back() == interval;
  here.y = value_at(is_after ? y_.after_step(interval) : y_[interval], nodes, at);
  here.drive = p_.k * here.y + value_at(is_after ? force_.after_step(interval) : force_[interval], nodes, at);
  here.path = std::abs(x_ - reversal_);
  here.course = static_cast<double>(sample) / static_cast<double>(count_ - 1);
  double force = here.drive - p_.k * x_ - p_.c * here.v - friction_at(x_);
  for (const auto& [further, g] : acting_) force -= g * (*further)(here);
  return force / p_.m;
}

/// From one sample to the next, through the events between them.
bool SampledOscillator::walk_interval(std::size_t interval) {
  interval_ = interval;
  y_piece_ = y_[interval];
  for (std::size_t j = 0; j < nodes; ++j) drive_[j] = p_.k * y_piece_[j] + force_[interval][j];
  if (interval == 0 && direction_ == 0) settle(0.0);
  if (next_step_ < steps_.size() && steps_[next_step_] == interval) {
    const double at = place_of(next_step_);
    walk(0.0, at);
    pass_step(at);
    walk(at, 1.0);
  } else {
    walk(0.0, 1.0);
  }
  return std::isfinite(x_) && std::isfinite(v_);
}

void SampledOscillator::walk(double begin, double end) {
  constexpr int most_events = 32;  // more come from rounding at one instant
  double at = begin;
  for (int event = 0; at < end; ++event) {
    if (direction_ != 0) {
      at = event < most_events ? yields() ? slip_or_yield(at, end) : slip(at, end) : end;
    } else {
      at = rest(at, end);
      if (at < end) direction_ = balance(at).pull > 0.0 ? 1 : -1;
    }
  }
}

/// The drive becomes that of the samples after the step. A mass at rest stays, or slides from now on: a later step
/// leaves it so much less speed.
void SampledOscillator::pass_step(double at) {
  const double before = direction_ == 0 ? 0.0 : value_at(drive_, nodes, at);
  y_piece_ = y_.after_step(interval_);
  const Drive& force = force_.after_step(interval_);
  for (std::size_t j = 0; j < nodes; ++j) drive_[j] = p_.k * y_piece_[j] + force[j];
  double after = value_at(drive_, nodes, at);
  if (direction_ == 0) {
    const Balance here = balance(at);
    after = std::copysign(std::max(0.0, std::abs(here.pull) - here.limit), here.pull);
  }
  std::size_t number = 0;
  for (std::size_t i = 0; i < tangents_.by.size(); ++i)
    if (tangents_.by[i] == By::place && number++ == next_step_)
      tangents_.v[static_cast<Eigen::Index>(i)] += (before - after) / inertia_;
  ++next_step_;
}

SampledOscillator::Balance SampledOscillator::balance(double at) const {
  Balance balance{value_at(drive_, nodes, at) - p_.k * x_, p_.F0};
  if (acting_.empty()) return balance;
  Instant here;
  here.x = x_;
  here.y = value_at(y_piece_, nodes, at);
  here.drive = value_at(drive_, nodes, at);
  here.path = std::abs(x_ - reversal_);
  here.course = course(at);
  Instant back = here;
  here.direction = 1.0;
  back.direction = -1.0;
  for (const auto& [force, g] : acting_) {
    const double ahead = g * (*force)(here);
    const double behind = g * (*force)(back);
    balance.pull -= 0.5 * (ahead + behind);
    balance.limit += 0.5 * (ahead - behind);
  }
  return balance;
}

/// Time of release, or `end`.
double SampledOscillator::rest(double begin, double end) const {
  const auto excess = [this](double at) {
    const Balance here = balance(at);
    return std::abs(here.pull) - here.limit;
  };
  const bool changes =
      !acting_.empty() || std::any_of(drive_.begin() + 1, drive_.end(), [](double c) { return c != 0.0; });
  double low = begin;
  for (int i = 1; i <= parts_of_interval; ++i) {
    const double high = begin + (end - begin) * i / parts_of_interval;
    if (excess(high) > 0.0) return excess(low) > 0.0 ? low : root(excess, low, high);
    if (!changes) break;
    low = high;
  }
  return end;
}

/// Moves on to the next reversal, and through it, or to `end`; returns the time reached.
double SampledOscillator::slip(double begin, double end) {
  expand(begin);
  const double reversal = first_reversal(end - begin);
  if (reversal < 0.0) {
    move_to(end - begin);
    return end;
  }
  const double before = curvature_at(series_, terms_, reversal);
  move_to(reversal);
  v_ = 0.0;
  reversal_ = x_;
  const double at = begin + reversal;
  settle(at);
  const Balance here = balance(at);
  const double force = here.pull - here.limit * direction_;
  const double after = direction_ == 0 ? 0.0 : force / inertia_;
  tangents_.v *= before != 0.0 ? after / before : 0.0;
  return at;
}

/// Time at which the velocity leaves the direction of slip; negative: it does not.
double SampledOscillator::first_reversal(double length) const {
  const auto speed = [this](double u) { return direction_ * slope_at(series_, terms_, u); };
  double most_change = 0.0;  // of the velocity, over a whole sample interval
  for (int j = 2; j < terms_; ++j) most_change += j * std::abs(series_[static_cast<std::size_t>(j)]);
  if (std::abs(v_) > most_change) return -1.0;
  const double rounding = 1e-14 * fastest_;
  double low = 0.0;
  for (int i = 1; i <= parts_of_interval; ++i) {
    const double high = length * i / parts_of_interval;
    if (speed(high) < -rounding) return speed(low) > 0.0 ? root(speed, low, high) : low;
    low = high;
  }
  return -1.0;
}

/// Sets the direction after a slip has ended: a reversal, or a stop.
void SampledOscillator::settle(double at) {
  const auto sticks = [] { return friction::Direction::none; };
  const Balance here = balance(at);
  direction_ = static_cast<int>(sim::direction_after_slip(here.pull, here.limit, 0.0, sticks));
}

double SampledOscillator::course(double at) const {
  return (static_cast<double>(interval_) + at) / static_cast<double>(count_ - 1);
}

SampledOscillator::Instant SampledOscillator::instant(double u) const {
  Instant instant;
  instant.x = value_at(series_, terms_, u);
  instant.v = slope_at(series_, terms_, u) * rate_;
  instant.direction = direction_;
  instant.y = value_at(y_here_, nodes, u);
  instant.drive = value_at(drive_here_, nodes, u);
  instant.path = std::abs(instant.x - reversal_);
  instant.course = course(begin_ + u);
  return instant;
}

/// Computes the motion at eight points of the rest of the interval, the same points for all forces.
void SampledOscillator::look_along() {
  const auto& powers = powers_of_places<most_terms>();
  const double length = 1.0 - begin_;
  const auto along = [&](const auto& series, int terms) -> AtNodes {
    AtNodes sum = AtNodes::Zero();
    double scale = 1.0;
    for (int j = 0; j < terms; ++j, scale *= length)
      sum += powers.col(j) * (series[static_cast<std::size_t>(j)] * scale);
    return sum;
  };
  Series slopes{};
  for (int j = 1; j < terms_; ++j)
    slopes[static_cast<std::size_t>(j - 1)] = j * rate_ * series_[static_cast<std::size_t>(j)];
  const AtNodes x = along(series_, terms_);
  const AtNodes v = along(slopes, terms_ - 1);
  const AtNodes y = along(y_here_, nodes);
  const AtNodes drive = along(drive_here_, nodes);
  for (int i = 0; i < nodes; ++i) {
    Instant& at = along_[static_cast<std::size_t>(i)];
    at.x = x[i];
    at.v = v[i];
    at.direction = direction_;
    at.y = y[i];
    at.drive = drive[i];
    at.path = std::abs(x[i] - reversal_);
    at.course = course(begin_ + powers(i, 1) * length);
  }
}

/// A force along the motion, as a polynomial through these points. It is smooth, because the direction is constant.
SampledOscillator::Drive SampledOscillator::push(const Force& force) const {
  static const Eigen::Matrix<double, nodes, nodes> to_powers = inverse_of(powers_of_places<nodes>().matrix());
  const double per_length = 1.0 / (1.0 - begin_);
  AtNodes coefficients = AtNodes::Zero();
  for (int i = 0; i < nodes; ++i)
    coefficients += to_powers.col(i).array() * force(along_[static_cast<std::size_t>(i)]);
  Drive series{};
  double power = 1.0;
  for (int i = 0; i < nodes; ++i, power *= per_length)
    series[static_cast<std::size_t>(i)] = coefficients[i] * power;
  return series;
}

/// Taylor series of the motion from `begin` within the interval.
void SampledOscillator::expand(double begin) {
  const Drive drive = shifted(drive_, begin);
  y_here_ = shifted(y_piece_, begin);
  drive_here_ = drive;
  begin_ = begin;
  series_[0] = x_;
  series_[1] = v_;
  expand_motion(drive);
  constexpr int rounds = 3;  // each reduces the error by the order of the sample interval squared
  for (int round = 0; round < rounds && !acting_.empty(); ++round) {
    Drive left = drive;
    look_along();
    for (const auto& [force, g] : acting_) {
      const Drive pushed = push(*force);
      for (std::size_t j = 0; j < nodes; ++j) left[j] -= g * pushed[j];
    }
    expand_motion(left);
  }
}

void SampledOscillator::expand_motion(const Drive& drive) {
  for (int j = 0; j + 2 < terms_; ++j) {
    const auto i = static_cast<std::size_t>(j);
    double force = j < nodes ? drive[i] : 0.0;
    if (j == 0) force -= friction_at(0.0);
    series_[i + 2] =
        (force - damping_ * (j + 1) * series_[i + 1] - (p_.k + contact_) * series_[i]) * integration_[i];
  }
}

void SampledOscillator::move_to(double u) {
  if (!tangents_.by.empty()) move_tangents(u);  // first: they need the motion as it is at the start
  x_ = value_at(series_, terms_, u);
  v_ = slope_at(series_, terms_, u);
  fastest_ = std::max(fastest_, std::abs(v_));
}

}  // namespace dualdamp::identify
