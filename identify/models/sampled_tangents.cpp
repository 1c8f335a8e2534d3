/// The derivatives of a SampledOscillator's motion with respect to its parameters.
#include <algorithm>
#include <cmath>

#include "identify/models/sampled_oscillator.hpp"

namespace dualdamp::identify {

void SampledOscillator::Tangents::add(By what, const Force* force) {
  by.push_back(what);
  forces.push_back(force);
}

/// Sizes the arrays, and sets the derivatives at the start.
void SampledOscillator::Tangents::start(double per_velocity) {
  const auto rows = static_cast<Eigen::Index>((by.size() + side_by_side - 1) / side_by_side * side_by_side);
  x.setZero(rows);
  v.setZero(rows);
  anchor.setZero(rows);
  forcing.setZero(rows, most_terms);
  for (std::size_t i = 0; i < by.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (by[i] == By::position) x[row] = 1.0;
    if (by[i] == By::velocity) v[row] = per_velocity;
    if (by[i] == By::constant) forcing(row, 0) = 1.0;
  }
}

void SampledOscillator::start_tangents(const std::vector<By>& by, const std::vector<Force>& forces,
                                       bool with_steps) {
  for (const By what : by) tangents_.add(what);
  for (const Force& force : forces) tangents_.add(By::force, &force);
  // Those of the steps begin anew at each sample.
  if (with_steps)
    for (const By what : {By::position, By::position, By::constant}) tangents_.add(what);
  tangents_.start(1.0 / rate_);
}

/// Stores the last three tangents as they are one sample after their start, and starts them again.
void SampledOscillator::store_step(std::vector<Step>& steps) {
  const auto first = static_cast<Eigen::Index>(tangents_.by.size()) - 3;
  auto x = tangents_.x.segment<3>(first);
  auto v = tangents_.v.segment<3>(first);
  Step& step = steps.emplace_back();
  for (Eigen::Index j = 0; j < 2; ++j) step.carried.col(j) << x[j], v[j] * rate_;
  step.pushed << x[2], v[2] * rate_;
  x << 1.0, 0.0, 0.0;
  v << 0.0, direction_ == 0 ? 0.0 : 1.0 / rate_, 0.0;  // a mass that sticks has no velocity to disturb
  tangents_.anchor.segment<3>(first).setZero();
}

/// Stiffness and damping in the rest of the interval, with the slopes of the acting forces at its middle.
void SampledOscillator::linearise() {
  local_stiffness_ = p_.k + contact_;
  local_damping_ = damping_;
  if (acting_.empty()) return;
  const Instant middle = instant(0.5 * (1.0 - begin_));
  constexpr double share = 1e-6;
  const double dx = share * std::abs(middle.x - middle.y) + 1e-3 * share * fastest_;
  const double dv = share * fastest_ * rate_;
  for (const auto& [force, g] : acting_) {
    const auto slope = [&](double in_x, double in_v, double step) {
      const auto moved = [&](double sign) {
        Instant at = middle;
        at.x += sign * in_x;
        at.v += sign * in_v;
        at.path = std::abs(at.x - reversal_);
        return (*force)(at);
      };
      return step > 0.0 ? (moved(1.0) - moved(-1.0)) / (2.0 * step) : 0.0;
    };
    local_stiffness_ += g * slope(dx, 0.0, dx);
    local_damping_ += g * rate_ * slope(0.0, dv, dv);
  }
}

/// What drives a tangent: the derivative of the forces with respect to its parameter, the motion held.
void SampledOscillator::force_tangent(std::size_t number) {
  const auto row = static_cast<Eigen::Index>(number);
  auto forcing = tangents_.forcing.row(row);
  if (yields()) forcing.setZero();  // its terms are others while the contact holds
  switch (tangents_.by[number]) {
    case By::mass:
      for (int j = 0; j + 2 < terms_; ++j)
        forcing[j] = -rate_ * rate_ * (j + 1) * (j + 2) * series_[static_cast<std::size_t>(j) + 2];
      break;
    case By::damping:
      for (int j = 0; j + 2 < terms_; ++j) forcing[j] = -rate_ * (j + 1) * series_[static_cast<std::size_t>(j) + 1];
      break;
    case By::stiffness:
      for (int j = 0; j + 2 < terms_; ++j) forcing[j] = -series_[static_cast<std::size_t>(j)];
      for (int j = 0; j < nodes; ++j) forcing[j] += y_here_[static_cast<std::size_t>(j)];
      break;
    case By::friction:
      if (holds_)
        force_contact(row, -1.0 / p_.yield);
      else
        forcing[0] = -static_cast<double>(direction_);
      break;
    case By::yield:
      if (holds_) force_contact(row, contact_ / p_.yield);
      break;
    case By::force: {
      const Drive pushed = push(*tangents_.forces[number]);
      for (int j = 0; j < nodes; ++j) forcing[j] = -pushed[static_cast<std::size_t>(j)];
      break;
    }
    case By::constant:
      forcing[0] = 1.0;
      break;
    case By::position:
    case By::velocity:
    case By::place:
      break;
  }
  forcing[0] += contact_ * tangents_.anchor[row];
}

/// The stretch of the contact that holds, times a factor, drives a tangent.
void SampledOscillator::force_contact(Eigen::Index row, double factor) {
  for (int j = 0; j + 2 < terms_; ++j) tangents_.forcing(row, j) = factor * series_[static_cast<std::size_t>(j)];
  tangents_.forcing(row, 0) -= factor * anchor_;
}

/// Sums the Taylor series of all tangents as their terms are computed.
void SampledOscillator::move_tangents(double u) {
  linearise();
  if (std::ranges::find(tangents_.by, By::force) != tangents_.by.end()) look_along();
  for (std::size_t i = 0; i < tangents_.by.size(); ++i) force_tangent(i);
  using Rows = Eigen::Array<double, side_by_side, 1>;
  for (Eigen::Index row = 0; row < tangents_.x.size(); row += side_by_side) {
    auto x = tangents_.x.segment<side_by_side>(row);
    auto v = tangents_.v.segment<side_by_side>(row);
    Rows low = x;
    Rows high = v;
    Rows value = low + u * high;
    Rows slope = high;
    double power = u;
    for (int j = 0; j + 2 < terms_; ++j) {
      const Rows forcing = tangents_.forcing.block<side_by_side, 1>(row, j);
      const Rows next = (forcing - (local_damping_ * (j + 1)) * high - local_stiffness_ * low) *
                        integration_[static_cast<std::size_t>(j)];
      slope += ((j + 2) * power) * next;
      power *= u;
      value += power * next;
      low = high;
      high = next;
    }
    x = value;
    v = slope;
  }
}

}  // namespace dualdamp::identify
