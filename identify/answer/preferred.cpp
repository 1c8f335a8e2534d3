#include "identify/answer/preferred.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "core/constants.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

bool overlap(const Interval& a, const Interval& b) { return a[0] <= b[1] && b[0] <= a[1]; }

}  // namespace

double area(const Estimate& estimate) {
  if (!estimate.usable || !estimate.interval95) return core::infinity;
  const ParameterIntervals& at = *estimate.interval95;
  const double size = (at.c[1] - at.c[0]) * (at.F0[1] - at.F0[0]);
  return std::isfinite(size) ? size : core::infinity;
}

bool disagree(const Estimate& a, const Estimate& b) {
  if (!b.usable || !a.interval95 || !b.interval95) return false;
  return !overlap(a.interval95->c, b.interval95->c) || !overlap(a.interval95->F0, b.interval95->F0);
}

bool has_few_readings(const Ledger& ledger) { return ledger.data.empty() && !ledger.recorded.histories; }

namespace {

bool is_negative(const Estimate& estimate) { return estimate.value.c < 0.0 || estimate.value.F0 < 0.0; }

/// Do c and F0 of all estimates at these places agree with those of one of them, to the least change that matters?
bool agree(const std::vector<Estimate>& estimates, const std::vector<std::size_t>& places, std::size_t with) {
  const double share = LedgerOptions{}.least_change;
  return std::ranges::all_of(places, [&](std::size_t place) {
    const ParameterSet& a = estimates[place].value;
    const ParameterSet& b = estimates[with].value;
    return std::abs(a.c - b.c) <= share * std::abs(b.c) && std::abs(a.F0 - b.F0) <= share * std::abs(b.F0);
  });
}

/// Is zeta or F0 uncertain by more than its value?
bool is_vague(const Estimate& estimate) {
  const auto vague = [](double value, const Interval& interval) {
    return 0.5 * (interval[1] - interval[0]) > value;
  };
  return !estimate.interval95 || vague(estimate.value.c, estimate.interval95->c) ||
         vague(estimate.value.F0, estimate.interval95->F0);
}

/// The range over laws that says more than a joint fit more uncertain than its value; nothing if there is none. The
/// narrow interval of another method beside such a fit is narrow by chance.
std::optional<std::size_t> better_range(const std::vector<Estimate>& estimates, const Estimate& joint) {
  if (!is_vague(joint)) return std::nullopt;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    if (estimates[i].laws && (area(estimates[i]) < area(joint) || (is_negative(joint) && estimates[i].usable)))
      return i;
  return std::nullopt;
}

/// The one of these estimates with the smallest size. Methods that are the same for a record have the same size but
/// for rounding: the first by name counts.
std::size_t smallest(const std::vector<Estimate>& estimates, const std::function<double(const Estimate&)>& size) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < estimates.size(); ++i) {
    const double own = size(estimates[i]);
    const double least = size(estimates[best]);
    if (is_tie(own, least) ? estimates[i].method < estimates[best].method : own < least) best = i;
  }
  return best;
}

/// The widest of the estimates with intervals that do not contradict the one at `with`.
std::size_t widest_beside(const std::vector<Estimate>& estimates, std::size_t with) {
  return smallest(estimates, [&](const Estimate& one) {
    const bool counts = !one.laws && std::isfinite(area(one)) && !disagree(estimates[with], one);
    return counts ? -area(one) : core::infinity;
  });
}

/// Is the law that the joint fit has free the only explanation of what departs, and does it leave zeta and F0
/// known?
bool knows_its_law(const Ledger& ledger, const Estimate& joint) {
  return ledger.departures.size() == 1 && ledger.departures.front().size() == 1 && !is_vague(joint);
}

}  // namespace

std::optional<std::size_t> preferred(const std::vector<Estimate>& estimates, const Ledger& ledger) {
  const auto place = [&](auto found) { return static_cast<std::size_t>(found - estimates.begin()); };
  // It uses all data, and relaxes what is violated: another estimate has a narrower interval by chance.
  const auto joint = std::ranges::find(estimates, "joint_fit", &Estimate::method);
  if (joint != estimates.end() && std::isfinite(area(*joint))) {
    // Where something else explains the departure as well, a range over laws has more of what it may be. Where
    // nothing does, it only reads less of the record: steady states or extremes.
    const auto ranges = std::ranges::find_if(
        estimates, [](const Estimate& e) { return e.laws != nullptr && std::isfinite(area(e)); });
    if (ledger.frees_law && ranges != estimates.end() && !knows_its_law(ledger, *joint)) return place(ranges);
    const std::optional<std::size_t> better = better_range(estimates, *joint);
    return better ? *better : place(joint);
  }
  // Ranges over laws count only if nothing narrower can be used.
  const bool others = std::ranges::any_of(estimates, [](const Estimate& e) { return e.usable && !e.laws; });
  const auto size = [others](const Estimate& e) { return others && e.laws ? core::infinity : area(e); };
  if (estimates.empty()) return std::nullopt;
  const std::size_t narrowest = smallest(estimates, size);
  if (std::isfinite(size(estimates[narrowest])))
    return others && has_few_readings(ledger) ? widest_beside(estimates, narrowest) : narrowest;
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    if (estimates[i].usable && !estimates[i].laws) usable.push_back(i);
  if (usable.empty()) return std::nullopt;
  sort_with_ties(
      usable, [&](std::size_t i) { return -estimates[i].value.c; },
      [&](std::size_t a, std::size_t b) { return estimates[a].method < estimates[b].method; });
  const std::size_t middle = usable[usable.size() / 2];
  return agree(estimates, usable, middle) ? std::optional(middle) : std::nullopt;
}

}  // namespace dualdamp::identify
