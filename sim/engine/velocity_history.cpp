#include "sim/engine/velocity_history.hpp"

#include <algorithm>

namespace dualdamp::sim {

namespace {

/// Lagrange's polynomial through values at 0, 1/4, ..., 1.
double interpolate(const VelocityHistory::Values& values, double part) {
  double sum = 0.0;
  for (int i = 0; i < VelocityHistory::points; ++i) {
    double weight = values[static_cast<std::size_t>(i)];
    for (int j = 0; j < VelocityHistory::points; ++j) {
      if (j != i) weight *= (4.0 * part - j) / (i - j);
    }
    sum += weight;
  }
  return sum;
}

}  // namespace

void VelocityHistory::clear(double v, double reach) {
  first_ = v;
  reach_ = reach;
  steps_.clear();
}

void VelocityHistory::add(double begin, double duration, const Values& values) {
  if (reach_ == 0.0 || duration <= 0.0) return;
  steps_.push_back({begin, duration, values});
  while (steps_.size() > 1 && steps_[1].begin < begin - 1.5 * reach_) steps_.pop_front();
}

void VelocityHistory::shift(double period) {
  for (Step& step : steps_) step.begin -= period;
  ++frame_;
  last_shift_ = period;
}

double VelocityHistory::at(double t, long frame) const {
  if (frame != frame_) t -= last_shift_;
  const auto after = std::ranges::upper_bound(steps_, t, {}, &Step::begin);
  if (after == steps_.begin()) return steps_.empty() ? first_ : steps_.front().values.front();
  const Step& step = *std::prev(after);
  return interpolate(step.values, (t - step.begin) / step.duration);
}

}  // namespace dualdamp::sim
