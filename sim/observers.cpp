#include "sim/observers.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace dualdamp::sim {

namespace {

/// Calls visit(begin, width) for panels that cover the interval, each resolved by a polynomial of low degree.
template <class Visit>
void for_panels(const Interval& interval, const Visit& visit) {
  double s = 0.0;
  while (s < interval.duration) {
    const double width = std::min(interval.resolution(s), interval.duration - s);
    visit(s, width);
    s += width;
  }
}

/// Calls visit(sample, weight) so that sum weight f(sample) = int f dt over the interval.
template <class Visit>
void quadrature(const Interval& interval, const Visit& visit) {
  using Rule = boost::math::quadrature::gauss<double, 15>;
  for_panels(interval, [&](double begin, double width) {
    const double half = 0.5 * width;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const double offset = half * Rule::abscissa()[i];
      const double weight = half * Rule::weights()[i];
      visit(interval.at(begin + half + offset), weight);
      if (offset != 0.0) visit(interval.at(begin + half - offset), weight);
    }
  });
}

/// Where the acceleration changes sign between low and high, by bisection; `sign` is its sign at low.
double speed_extreme(const Interval& interval, double low, double high, double sign) {
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (interval.at(middle).a * sign > 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

void Sampler::observe(const Interval& interval) {
  if (rate_ <= 0.0) return;
  for (;;) {
    const double t = static_cast<double>(samples_.size()) / rate_;
    if (t >= interval.end()) return;
    Sample sample = interval.state_at(std::max(t, interval.begin));
    sample.t = t;
    samples_.push_back(sample);
  }
}

void Sampler::finish(const Sample& final) {
  if (rate_ <= 0.0) return;
  const double t = static_cast<double>(samples_.size()) / rate_;
  if (std::abs(t - final.t) > 1e-9 / rate_) return;
  samples_.push_back(final);
  samples_.back().t = t;
}

void Extremes::observe(const Interval& interval) {
  const Sample begin = interval.at(0.0);
  const Sample end = interval.at(interval.duration);
  if (!seen_) peak_ = trough_ = begin.x;
  seen_ = true;
  peak_ = std::max({peak_, begin.x, end.x});
  trough_ = std::min({trough_, begin.x, end.x});
  max_speed_ = std::max({max_speed_, std::abs(begin.v), std::abs(end.v)});
  if (interval.direction == friction::Direction::rest || interval.duration <= 0.0) return;
  // The speed is largest where the acceleration changes sign; eight cells a panel bracket it.
  double left = 0.0;
  double left_a = begin.a;
  for_panels(interval, [&](double from, double width) {
    for (int cell = 1; cell <= 8; ++cell) {
      const double right = from + width * cell / 8.0;
      const double right_a = interval.at(right).a;
      if (left_a * right_a < 0.0) {
        const double at = speed_extreme(interval, left, right, left_a);
        max_speed_ = std::max(max_speed_, std::abs(interval.at(at).v));
      }
      left = right;
      left_a = right_a;
    }
  });
}

double EnergyAudit::stored(const Sample& sample) const {
  const double stretch = sample.y - sample.x;
  return 0.5 * (oscillator_.mass * sample.v * sample.v + oscillator_.stiffness * stretch * stretch);
}

void EnergyAudit::observe(const Interval& interval) {
  if (!started_) first_ = stored(interval.at(0.0));
  started_ = true;
  last_ = stored(interval.at(interval.duration));
  const bool damper_moves = oscillator_.damper_to == DamperTo::base;
  quadrature(interval, [&](const Sample& s, double weight) {
    const double damper_speed = damper_moves ? s.v - s.y_rate : s.v;
    const double base_force =
        oscillator_.stiffness * (s.y - s.x) - (damper_moves ? oscillator_.damping * damper_speed : 0.0);
    input_.add(weight * (base_force * s.y_rate + s.external * s.v));
    friction_.add(weight * s.force * s.v);
    viscous_.add(weight * oscillator_.damping * damper_speed * damper_speed);
  });
}

Energy EnergyAudit::account() const {
  Energy result{.input = input_.value(), .friction = friction_.value(), .viscous = viscous_.value()};
  result.stored = last_ - first_;
  result.defect = result.input - result.friction - result.viscous - result.stored;
  return result;
}

void Fundamental::observe(const Interval& interval) {
  quadrature(interval,
             [&](const Sample& s, double weight) { sum_ += weight * s.x * std::polar(1.0, -omega_ * s.t); });
}

std::complex<double> Fundamental::coefficient() const { return sum_ * (omega_ / std::numbers::pi); }

}  // namespace dualdamp::sim
