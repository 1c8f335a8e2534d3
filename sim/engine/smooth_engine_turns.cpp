// Steps of the smooth engine that begin or end where the mass turns.

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/engine/smooth_engine.hpp"

namespace dualdamp::sim {

namespace {

/// Parts of a step, from the turn on, at which a law is asked how its states depend on the speed; the first is the
/// turn itself. And what the others make of the first as a parabola, as weights.
constexpr std::array<double, 4> from_turn = {0.0, 0.1, 0.3, 0.6};
constexpr std::array<double, 3> parabola = {1.8, -1.0, 0.2};

/// The speed is varied by this part of itself and of a hundredth of the largest one (`Flow::jacobian`).
constexpr double speed_variation = 1.5e-8;
constexpr double slow_part = 0.01;

/// A dependence that changes by less over the step matters to no state, relative to the sizes of both.
constexpr double sharp_change = 0.01;

/// Steps shorter than this part of the longest one are not shortened further.
constexpr double shortest_with_turn = 1e-9;

}  // namespace

/// Whether a step hides from its own error estimate how the states of a law depend on the speed near the turn at
/// its end, or at its begin. Bristles that yield at a level which falls within a small speed are such a law: their
/// rates are a product with the speed, so that the turn itself shows nothing of the level, and the stages before it
/// are too fast.
bool SmoothEngine::hides_turn(bool at_end) {
  if (X_.size() <= 2 || taken_ < shortest_with_turn * longest_step()) return false;
  const double change = speed_variation * slow_part * flow_.scales()[1];
  std::array<std::vector<double>, from_turn.size()> slopes;
  double speed = 0.0;
  for (std::size_t i = 0; i < from_turn.size(); ++i) {
    const double part = at_end ? 1.0 - from_turn[i] : from_turn[i];
    const double t = local_time_ + part * taken_;
    probe_.resize(X_.size());
    stepper_->at(part, probe_);
    flow_.evaluate(probe_, t, rates_);
    slopes[i] = rates_;
    const double before = probe_[1];
    if (i == 1) speed = std::abs(before);
    probe_[1] += friction::sign(direction_) * (change + speed_variation * std::abs(before));
    flow_.evaluate(probe_, t, rates_);
    for (std::size_t k = 0; k < rates_.size(); ++k)
      slopes[i][k] = (rates_[k] - slopes[i][k]) / (probe_[1] - before);
  }
  for (std::size_t k = 2; k < X_.size(); ++k) {
    double rest = slopes[0][k];
    for (std::size_t i = 0; i < parabola.size(); ++i) rest -= parabola[i] * slopes[i + 1][k];
    const double missed = std::abs(rest) * speed * from_turn[1] * taken_;
    const double clearly = sharp_change * flow_.scales()[k] / flow_.scales()[1];
    if (missed > allowed_[k] && std::abs(rest) * taken_ > clearly) return true;
  }
  return false;
}

/// Whether the step taken last, which ends by `found`, has to be repeated shorter since it hides a turn; `h_` says
/// how long.
bool SmoothEngine::passes_over_turn(bool at_stop) {
  if (direction_ == friction::Direction::none) return false;
  if (at_stop && hides_turn(true)) {
    h_ = 0.75 * taken_;
    return true;
  }
  if (X_[1] == 0.0 && hides_turn(false)) {
    h_ = 0.25 * taken_;
    return true;
  }
  return false;
}

}  // namespace dualdamp::sim
