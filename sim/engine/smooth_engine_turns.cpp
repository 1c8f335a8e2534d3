// Steps of the smooth engine that begin or end where the mass turns, and steps that are too many.

#include <array>
#include <cmath>
#include <complex>
#include <string>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "sim/engine/eigenvalues.hpp"
#include "sim/engine/law_name.hpp"
#include "sim/engine/smooth_engine.hpp"
#include "sim/engine/sticking_gate.hpp"

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

/// In one of the shortest periods: beyond that the motion changes too fast to be integrated in reasonable time.
constexpr long max_steps = 300'000;

/// At one instant to rounding: a creep is found within a few hundred.
constexpr long max_standing = 3'000;

/// Swings of a vibration in one of the shortest periods that a steady state can follow one by one. Damped as much
/// as this, a vibration is soon gone.
constexpr double many_swings = 1'000.0;
constexpr double soon_gone = 0.01;

/// Steps to a crossing, and the last correction of their length, as a part of it, where Newton's method converges.
constexpr int most_corrections = 5;
constexpr double settled = 1e-6;

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

/// What changes too fast: a vibration of its own that nearly nothing damps, or else friction.
std::string SmoothEngine::too_fast() const {
  const std::string vibration = standing_ > max_standing ? std::string() : fast_vibration();
  return vibration.empty() ? "friction changes too fast there to be integrated" : vibration;
}

std::string SmoothEngine::fast_vibration() const {
  if (X_.empty()) return {};
  const auto n = static_cast<Eigen::Index>(X_.size());
  std::vector<double> columns(X_.size() * X_.size());
  flow_.jacobian(X_, local_time_, columns);
  std::complex<double> fastest = 0.0;
  for (const std::complex<double>& value : eigenvalues_of(Eigen::Map<const Eigen::MatrixXd>(columns.data(), n, n)))
    if (std::abs(value.imag()) > fastest.imag()) fastest = {value.real(), std::abs(value.imag())};
  const double rate = std::abs(fastest);
  const double swings = rate * shortest_period() / core::two_pi;
  const bool is_damped = !(std::abs(fastest.real()) < soon_gone * rate);
  if (is_damped || !(swings > many_swings) || !std::isfinite(rate)) return {};
  const double slower = swings / many_swings;
  return "a second vibration at " + core::format_number(rate, 3) +
         " rad/s, which hardly anything damps, swings too often to be followed; it can be up to " +
         core::format_number(rate / slower, 3) + " rad/s (its mass " + core::format_number(slower * slower, 2) +
         " times as heavy, or its stiffness as many times smaller), or with a damping ratio of " +
         core::format_number(soon_gone, 2) + " or more";
}

/// False, with an outcome, when the motion takes more steps than anybody waits for; rejected ones count.
bool SmoothEngine::makes_headway() {
  if (time() >= counted_to_) {
    counted_to_ = time() + shortest_period();
    steps_ = 0;
  }
  const bool stands_still = time() == stood_at_;
  stood_at_ = time();
  standing_ = stands_still ? standing_ + 1 : 0;
  if (++steps_ <= max_steps && standing_ <= max_standing) return true;
  const std::string spent = standing_ > max_standing ? std::to_string(max_standing) + " steps at one instant, "
                                                     : std::to_string(max_steps) + " steps in one period before ";
  const bool away = has_run_away();
  outcome_ = {away ? core::OutcomeKind::not_finite : core::OutcomeKind::event_limit,
              "more than " + spent + "t = " + std::to_string(time()) + " s: " + (away ? ran_away : too_fast())};
  return false;
}

/// The law whose force is not a number just ahead of the motion, and where; empty: there is none.
std::string SmoothEngine::infinite_force() {
  flow_.evaluate(X_, local_time_, rates_);
  const std::vector<double> ahead = rates_;
  std::vector<friction::Memory> memories = memories_;
  friction::Instant there = now();
  for (double s = 1e-15 * longest_step(); s < longest_step(); s *= 10.0) {
    probe_ = X_;
    for (std::size_t k = 0; k < probe_.size(); ++k) probe_[k] += s * ahead[k];
    flow_.scatter(probe_, memories);
    there.t = time() + s;
    there.x = probe_[0];
    there.v = probe_[1];
    for (std::size_t i = 0; i < memories.size(); ++i) {
      if (!std::isfinite(there.v) || std::isfinite(model_.friction[i].force(memories[i], there, direction_)))
        continue;
      return ": the force of " + name_in_list(model_, i) +
             " is not finite at x = " + core::format_number(there.x, 6) + " " + model_.unit("m") +
             ", v = " + core::format_number(there.v, 6) + " " + model_.unit("m/s");
    }
  }
  return {};
}

/// Repeats the step so that it ends at the crossing, and corrects its length by Newton's method. False: the shorter
/// step is not accurate; an implicit step that overran the crossing may have computed what only lies beyond it.
bool SmoothEngine::land(const Hit& hit) {
  const double whole = taken_;
  double h = hit.part * whole;
  if (h < EventSearch::shortest_part * longest_step()) {
    taken_ = 0.0;
    end_ = X_;
    return true;
  }
  const double zero = search_.zero(hit.guard, allowed_[1]);
  for (int i = 0;; ++i) {
    if (!stepper_->step(flow_, X_, local_time_, h, allowed_, end_, error_) || excess_error() > 1.0) return false;
    taken_ = h;
    const double value = search_.guards().value(hit.guard, end_, local_time_ + h);
    if (std::abs(value) <= zero) return true;
    const double correction = -value / search_.guards().rate(hit.guard, end_, local_time_ + h, h);
    const bool is_within_reach = std::abs(correction) < 0.1 * h;
    if (std::abs(correction) < 1e-16 * whole || (i == 0 && !is_within_reach)) return true;
    // Of a state that has died out, explicit steps at the limit of stability leave only their own swinging: its
    // zero recedes from each correction, past the crossings of other guards.
    if (i == most_corrections - 1 || !is_within_reach) return std::abs(correction) < settled * h;
    h += correction;
  }
}

/// Where a slip ends. Where the pull equals the limit within rounding, what both do next decides.
void SmoothEngine::settle() {
  using friction::Direction;
  const Direction slipped = direction_;
  change_direction(Direction::none);
  judge_.freeze(memories_, Direction::none, time() - local_time_);
  std::vector<double> X;
  judge_.gather(x_, 0.0, memories_, X);
  std::vector<double> rates(X.size());
  judge_.evaluate(X, local_time_, rates);
  const double pull = judge_.pull(X, local_time_);
  const double limit = judge_.limit(X, local_time_);
  const double parts = drive_.force_scale() + limit + model_.oscillator.stiffness * std::abs(x_);
  const double tolerance = Guards::equal * parts;
  const auto at_limit = [&] {
    double pull_then = pull;
    double limit_then = limit;
    for (const double part : {1e-6, 1e-4, 1e-2}) {
      const double later = part * longest_step();
      probe_ = X;
      for (std::size_t k = 2; k < probe_.size(); ++k) probe_[k] += later * rates[k];
      pull_then = judge_.pull(probe_, local_time_ + later);
      limit_then = judge_.limit(probe_, local_time_ + later);
      if (std::abs(std::abs(pull_then) - limit_then) > tolerance) break;
    }
    return direction_after_slip(pull_then, limit_then, tolerance, [&] {
      if (can_stick_) return Direction::none;
      // Without a law that holds it a mass that nothing moves slips, at no speed.
      return pull_then < 0.0 ? Direction::backward : Direction::forward;
    });
  };
  Direction direction = direction_after_slip(pull, limit, tolerance, at_limit);
  // Creep below the rounding of the velocity shows only where it leads: not in this direction.
  if (ended_at_once_ && limit == 0.0 && direction == slipped)
    direction = slipped == Direction::forward ? Direction::backward : Direction::forward;
  if (direction != Direction::none) change_direction(direction);
}

}  // namespace dualdamp::sim
