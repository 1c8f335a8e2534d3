#include "sim/orbit_account.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/observers.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Merges rest intervals into sticks; one that crosses the period boundary counts once and starts in the period
/// before.
void collect_stick(std::vector<Stick>& sticks, const Interval& interval, bool continues, double x) {
  if (continues && !sticks.empty()) {
    sticks.back().duration += interval.duration;
  } else {
    sticks.push_back({interval.begin, interval.duration, x});
  }
}

void join_across_boundary(std::vector<Stick>& sticks) {
  if (sticks.size() < 2) return;
  sticks.back().duration += sticks.front().duration;
  sticks.erase(sticks.begin());
}

}  // namespace

void account_for_orbit(const Model& model, PeriodMap& map, bool full, SteadyState& result) {
  Engine& engine = map.engine();
  engine.track_sensitivity(false);
  engine.restart(result.start);
  Extremes extremes;
  EnergyAudit energy(model.oscillator);
  Fundamental fundamental(model.excitation.frequency);
  result.peak = result.trough = result.start.x;
  bool resting = false;
  const bool rests_at_start = result.start.direction == Direction::rest;
  while (engine.cycle() == 0) {
    const Interval* interval = engine.next_in_period();
    if (interval == nullptr) break;
    // The velocity keeps its sign within an interval.
    result.peak = std::max(result.peak, engine.position());
    result.trough = std::min(result.trough, engine.position());
    if (full) {
      extremes.observe(*interval);
      energy.observe(*interval);
      fundamental.observe(*interval);
    }
    const bool rest = interval->direction == Direction::rest;
    if (rest) collect_stick(result.sticks, *interval, resting, engine.position());
    resting = rest;
    if (interval->ending == EventKind::stop) ++result.stops_per_cycle;
    if (interval->ending) result.sequence.push_back(*interval->ending);
  }
  if (resting && rests_at_start) join_across_boundary(result.sticks);
  result.amplitude = 0.5 * (result.peak - result.trough);
  if (result.sticks.size() == 1 && result.stops_per_cycle == 0) {
    result.warnings.emplace_back("the mass never moves: any rest position that friction can hold is steady too");
  }
  if (!full) return;
  result.max_speed = extremes.max_speed();
  result.energy = energy.account();
  const double lag = model.excitation.phase - std::arg(fundamental.coefficient());
  constexpr double turn = 2.0 * std::numbers::pi;
  result.phase = result.amplitude > 0.0 ? lag - turn * std::floor(lag / turn) : 0.0;
}

}  // namespace dualdamp::sim
