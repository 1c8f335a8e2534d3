#include "identify/design/candidate.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

using States = std::vector<PlannedState>;

double cost_of(const States& states) { return static_cast<double>(states.size()); }

/// `counts[i]` states at level i.
States at_levels(const std::vector<double>& levels, const std::vector<int>& counts, double omega) {
  States states;
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (int j = 0; j < counts[i]; ++j) states.push_back({levels[i], omega});
  return states;
}

/// Divides `all` states among the levels as 1 : 1 or 2 : 1 : 1; the first gets the remainder.
std::vector<int> shared_out(int all, int levels) {
  const int each = levels == 2 ? all / 2 : all / 4;
  std::vector<int> counts(static_cast<std::size_t>(levels), std::max(each, 1));
  counts.front() = std::max(all - (levels - 1) * counts.back(), 1);
  return counts;
}

States same_levels(const std::vector<Pair>& states) {
  States planned;
  for (const Pair& state : states) planned.push_back({state.Y, state.omega});
  return planned;
}

States scaled(States states, double level, double frequency) {
  for (PlannedState& state : states) {
    state.Y *= level;
    state.omega *= frequency;
  }
  return states;
}

/// States across the resonance, to where the response has fallen to about half.
States resonance_curve(double Y, double natural, double zeta, int count) {
  States states;
  const double reach = std::clamp(2.0 * zeta, 0.01, 0.3);
  for (int i = 0; i < count; ++i) states.push_back({Y, natural * (1.0 + reach * (2.0 * i / (count - 1.0) - 1.0))});
  return states;
}

}  // namespace

std::vector<CandidateMeasurement> candidates_after(const std::vector<Pair>& states, const KnownConstants& constants,
                                                   double zeta) {
  const States same = same_levels(states);
  const auto [low, high] = std::ranges::minmax_element(same, {}, &PlannedState::Y);
  const double omega = same.front().omega;
  const double natural = constants.natural_frequency();
  const auto count = static_cast<int>(same.size());
  const double middle = 0.5 * (low->Y + high->Y);
  const bool has_phase = std::ranges::any_of(states, [](const Pair& state) { return !std::isnan(state.phase); });
  const double largest_x = std::ranges::max_element(states, {}, &Pair::x)->x;
  std::vector<CandidateMeasurement> list;
  const auto add = [&](std::string name, States planned, bool phases) {
    const double cost = cost_of(planned);
    list.push_back({std::move(name), std::move(planned), phases, false, cost});
  };
  if (!has_phase) list.push_back({"record the phase of the same states", same, true, true, cost_of(same)});
  add("repeat the same states", same, has_phase);
  add("the lowest and the highest level, each taken several times",
      at_levels({low->Y, high->Y}, shared_out(count, 2), omega), has_phase);
  add("three levels: half of the states at the lowest, a quarter in the middle, a quarter at the highest",
      at_levels({low->Y, middle, high->Y}, shared_out(count, 3), omega), has_phase);
  const States higher = scaled(same, 2.0, 1.0);
  if (!has_phase) add("the same states at levels twice as high", higher, false);
  add("the same states at levels twice as high, with phases", higher, true);
  const double aside = 1.0 + std::clamp(zeta, 0.01, 0.2);
  const States other_frequency = scaled(same, 1.0, aside);
  const States curve = resonance_curve(middle, natural, zeta, std::max(count, 5));
  const std::string at_other = "the same levels at " + core::format_number(aside, 3) + " times the frequency";
  if (!has_phase) add(at_other, other_frequency, false);
  add(at_other + ", with phases", other_frequency, true);
  if (!has_phase) add("the resonance curve at the middle level", curve, false);
  add("the resonance curve at the middle level, with phases", curve, true);
  add("the resonance curve at the lowest level, with phases",
      resonance_curve(low->Y, natural, zeta, std::max(count, 5)), true);
  add("the resonance curve at the highest level, with phases",
      resonance_curve(high->Y, natural, zeta, std::max(count, 5)), true);
  list.push_back({"release the mass from the largest amplitude and read its extremes",
                  PlannedDecay{largest_x, std::max(count, 8)}, false, false, 1.0});
  return list;
}

}  // namespace dualdamp::identify
