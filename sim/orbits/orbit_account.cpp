#include "sim/orbits/orbit_account.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/constants.hpp"
#include "sim/engine/engine.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Number of samples of the speed in a forcing period.
constexpr int samples = 1000;
/// Accuracy of x relative to the largest |x|, of the smooth engine relative to its tolerance.
constexpr double exact_accuracy = 1e-14;
constexpr double of_local_errors = 10.0;
/// A fundamental below this share of the amplitude has no phase to six digits: the motion is computed to twelve.
constexpr double least_fundamental = 1e-6;
/// Nor has one that is less than this many times the accuracy of x.
constexpr double clear_of_errors = 100.0;

}  // namespace

OrbitAccount::OrbitAccount(const Model& model, AccountParts parts)
    : detail_(parts.detail),
      drive_(model.excitation.amplitude),
      drive_phase_(model.excitation.phase),
      accuracy_(is_exact(model) ? exact_accuracy : of_local_errors * model.solver.tolerance),
      energy_(model.oscillator),
      fundamental_(model.excitation.frequency),
      sticks_by_speed_(parts.sticks_by_speed && !model.friction.empty() &&
                       std::ranges::none_of(model.friction, &friction::Law::holds_mass)),
      spacing_(core::two_pi / model.excitation.frequency / samples) {}

void OrbitAccount::begin(const State& start) {
  peak_ = trough_ = start.x;
  sticks_at_start_ = start.direction == Direction::none;
}

void OrbitAccount::observe(const Interval& interval, double x) {
  // The velocity keeps its sign within an interval.
  peak_ = std::max(peak_, x);
  trough_ = std::min(trough_, x);
  if (detail_ != OrbitDetail::extremes) fundamental_.observe(interval);
  if (detail_ == OrbitDetail::full) {
    extremes_.observe(interval);
    energy_.observe(interval);
  }
  if (sticks_by_speed_) collect_speeds(interval);
  const bool sticks = interval.direction == Direction::none;
  if (sticks) collect_stick(interval, x);
  sticking_ = sticks;
  if (interval.ending == EventKind::stop) ++stops_;
  if (interval.ending) sequence_.push_back(*interval.ending);
}

void OrbitAccount::collect_speeds(const Interval& interval) {
  for (;;) {
    const double t = static_cast<double>(speeds_.size()) * spacing_;
    if (t >= interval.end()) return;
    speeds_.push_back(std::abs(interval.state_at(std::max(t, interval.begin)).v));
  }
}

/// Number of times longer than `shortest_stick` of a forcing period at a speed below `stick_speed` times the
/// largest. The end of the period is joined to its start.
int OrbitAccount::slow_spans(double period) const {
  if (speeds_.empty()) return 0;
  const double slow = stick_speed * *std::ranges::max_element(speeds_);
  const auto fast = std::ranges::find_if(speeds_, [=](double speed) { return speed > slow; });
  if (fast == speeds_.end()) return 1;
  const auto begin = static_cast<std::size_t>(fast - speeds_.begin());
  int spans = 0;
  double length = 0.0;
  for (std::size_t i = 0; i <= speeds_.size(); ++i) {
    const bool is_slow = speeds_[(begin + i) % speeds_.size()] <= slow;
    if (!is_slow && length > shortest_stick * period) ++spans;
    length = is_slow ? length + spacing_ : 0.0;
  }
  return spans;
}

/// Merges intervals of sticking into sticks.
void OrbitAccount::collect_stick(const Interval& interval, double x) {
  if (sticking_ && !sticks_.empty()) {
    sticks_.back().duration += interval.duration;
  } else {
    sticks_.push_back({interval.begin, interval.duration, x});
  }
}

/// A stick across the end of the period counts once, and starts in the period before.
void OrbitAccount::join_stick_across_boundary() {
  if (!sticking_ || !sticks_at_start_ || sticks_.size() < 2) return;
  sticks_.back().duration += sticks_.front().duration;
  sticks_.erase(sticks_.begin());
}

/// A mass that friction finally holds creeps towards its rest position without end: the n-th slip is shorter than
/// the one before by the part 3/n. The mass counts as at rest once it sticks all the time except for slips below
/// rounding. The slips of several forcing periods add up.
bool OrbitAccount::is_at_rest(double period, int forcing_periods) const {
  constexpr double hidden = 1e-10;  // of the position, in a forcing period
  constexpr double held = 0.99;     // of the period
  double time = 0.0;
  for (const Stick& stick : sticks_) time += stick.duration;
  return stops_ > 0 && period > 0.0 && time > held * period &&
         peak_ - trough_ <= forcing_periods * hidden * std::max(std::abs(peak_), std::abs(trough_));
}

/// NaN where the excitation or x has no fundamental.
double OrbitAccount::lag(int forcing_periods) const {
  const double fundamental = std::abs(fundamental_.coefficient()) / forcing_periods;
  const double largest = std::max(std::abs(peak_), std::abs(trough_));
  const double least = std::max(least_fundamental * 0.5 * (peak_ - trough_), clear_of_errors * accuracy_ * largest);
  if (drive_ == 0.0 || !(fundamental > least)) return std::numeric_limits<double>::quiet_NaN();
  const double lag = drive_phase_ - std::arg(fundamental_.coefficient());
  return lag - core::two_pi * std::floor(lag / core::two_pi);
}

void OrbitAccount::write(SteadyState& result) {
  join_stick_across_boundary();
  const bool is_held = is_at_rest(result.period, result.period_ratio);
  if (is_held) {
    result.period /= result.period_ratio;
    result.period_ratio = 1;
    peak_ = trough_ = sticks_.front().position;
    sticks_ = {{.start = 0.0, .duration = result.period, .position = peak_}};
    sequence_.clear();
    stops_ = 0;
  }
  result.peak = peak_;
  result.trough = trough_;
  result.amplitude = 0.5 * (peak_ - trough_);
  result.stops_per_cycle = stops_;
  result.sticks = std::move(sticks_);
  result.stick_count = sticks_by_speed_ ? slow_spans(samples * spacing_) : static_cast<int>(result.sticks.size());
  result.sequence = std::move(sequence_);
  if (is_held) {
    result.warnings.emplace_back(
        "the motion creeps towards this rest position by ever smaller slips, and reaches it only in the limit; other "
        "rest positions that friction can hold are steady too");
  } else if (result.sticks.size() == 1 && stops_ == 0) {
    result.warnings.emplace_back("the mass never moves: any rest position that friction can hold is steady too");
  }
  if (detail_ == OrbitDetail::extremes) return;
  result.phase =
      is_held || result.never_moves() ? std::numeric_limits<double>::quiet_NaN() : lag(result.period_ratio);
  if (is_held) return;
  result.fundamental = std::abs(fundamental_.coefficient()) / result.period_ratio;
  if (detail_ == OrbitDetail::phase) return;
  result.max_speed = extremes_.max_speed();
  result.energy = energy_.account();
  result.mean_square_speed = energy_.square_speed() / result.period;
}

void account_for_orbit(const Model& model, PeriodMap& map, AccountParts parts, SteadyState& result) {
  OrbitAccount account(model, parts);
  (void)map.from(result.start, Monodromy::without, &account);
  account.write(result);
}

SteadyState outline_of_orbit(const Model& model, PeriodMap& map, const State& start, int period_ratio) {
  SteadyState state{.period = core::two_pi / model.excitation.frequency * period_ratio,
                    .period_ratio = period_ratio,
                    .start = start};
  account_for_orbit(model, map, {.detail = OrbitDetail::extremes}, state);
  return state;
}

}  // namespace dualdamp::sim
