/// The motion of a SampledOscillator whose contact yields before it slides.
#include <algorithm>
#include <cmath>

#include "identify/models/sampled_oscillator.hpp"
#include "identify/models/series.hpp"

namespace dualdamp::identify {

/// The contact holds from now on, stretched by so much.
void SampledOscillator::hold(double stretch) {
  holds_ = true;
  contact_ = p_.F0 / p_.yield;
  anchor_ = x_ - stretch;
}

void SampledOscillator::let_slide(int direction) {
  holds_ = false;
  contact_ = 0.0;
  direction_ = direction;
}

/// A mass at rest begins with a contact that is not stretched, a fast one slides. Between them the stretch grows
/// with the speed, so that a little speed of a mass at rest, as a fit may give it, changes little.
void SampledOscillator::start_contact() {
  let_slide(direction_);
  if (!yields()) return;
  const double per_speed = std::sqrt(inertia_ / p_.k);
  const double stretch = v_ * per_speed;
  const bool slides = std::abs(stretch) >= p_.yield;
  if (!slides) hold(stretch);
  if (direction_ == 0) direction_ = 1;  // whichever way it goes
  for (std::size_t i = 0; i < tangents_.by.size() && !slides; ++i)
    tangents_.anchor[static_cast<Eigen::Index>(i)] = tangents_.by[i] == By::position   ? 1.0
                                                     : tangents_.by[i] == By::velocity ? -per_speed / rate_
                                                                                       : 0.0;
}

double SampledOscillator::first_slide(double length) const {
  if (!holds_) return -1.0;
  const auto beyond = [this](double u) { return direction_ * (value_at(series_, terms_, u) - anchor_) - p_.yield; };
  double low = 0.0;
  for (int i = 1; i <= parts_of_interval; ++i) {
    const double high = length * i / parts_of_interval;
    if (beyond(high) > 0.0) return beyond(low) < 0.0 ? root(beyond, low, high) : low;
    low = high;
  }
  return -1.0;
}

/// Moves on to the next reversal or slide, and through it, or to `end`; returns the time reached. Neither makes the
/// force of the contact jump, so the tangents have no jump but by further forces.
double SampledOscillator::slip_or_yield(double begin, double end) {
  expand(begin);
  const double reversal = first_reversal(end - begin);
  const double within = reversal < 0.0 ? end - begin : reversal;
  const double slide = first_slide(within);
  if (slide >= 0.0) {
    move_to(slide);
    let_slide(direction_);
    return begin + slide;
  }
  const double before = curvature_at(series_, terms_, within);
  move_to(within);
  if (reversal < 0.0) return end;
  v_ = 0.0;
  reversal_ = x_;
  if (!holds_) {
    for (std::size_t i = 0; i < tangents_.by.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      tangents_.anchor[row] = tangents_.x[row] - (tangents_.by[i] == By::yield ? direction_ : 0.0);
    }
    hold(direction_ * p_.yield);
  }
  direction_ = -direction_;
  const double at = begin + reversal;
  if (acting_.empty()) return at;
  const Balance here = balance(at);
  const double force = here.pull - friction_at(x_) - (here.limit - p_.F0) * direction_;
  tangents_.v *= before != 0.0 ? std::max(0.0, force / inertia_ / before) : 1.0;
  return at;
}

}  // namespace dualdamp::identify
