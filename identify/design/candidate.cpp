#include "identify/design/candidate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

using States = std::vector<PlannedState>;

/// Levels that differ by less are one level, as it was reached.
constexpr double one_level = 1.05;

/// The measured frequency nearest to the natural one, among the states at about this level; among all, if none is.
double resonance_at(double level, const States& measured, double natural) {
  const auto far = [&](const PlannedState& state) {
    const bool elsewhere = std::max(state.Y, level) > one_level * std::min(state.Y, level);
    return std::pair(elsewhere, std::abs(state.omega - natural));
  };
  return std::ranges::min_element(measured, {}, far)->omega;
}

/// `counts[i]` states at level i.
States at_levels(const std::vector<double>& levels, const std::vector<int>& counts, const States& measured,
                 double natural) {
  States states;
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (int j = 0; j < counts[i]; ++j) states.push_back({levels[i], resonance_at(levels[i], measured, natural)});
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

/// Candidates in the order in which they are tried.
class CandidateList {
 public:
  explicit CandidateList(const DriveLimits& limits) : limits_(limits) {}

  /// Unless the same measurement is on the list, or the drive cannot do it.
  void add(CandidateMeasurement candidate) {
    const auto is_same = [&](const CandidateMeasurement& other) {
      return other.phases == candidate.phases && other.only_phases == candidate.only_phases &&
             other.plan == candidate.plan;
    };
    if (!limits_.allow(candidate.plan))
      found_.left_out.push_back(std::move(candidate.name));
    else if (std::ranges::none_of(found_.list, is_same))
      found_.list.push_back(std::move(candidate));
  }

  /// Steady states; as many as they are is their cost.
  void add(std::string name, States planned, bool phases, bool only_phases = false) {
    const auto cost = static_cast<double>(planned.size());
    add({std::move(name), std::move(planned), phases, only_phases, cost});
  }

  [[nodiscard]] Candidates take() { return std::move(found_); }

 private:
  DriveLimits limits_;
  Candidates found_;
};

/// The levels of a record.
struct Levels {
  double low = 0.0, middle = 0.0, high = 0.0;

  explicit Levels(const States& states) {
    const auto [least, most] = std::ranges::minmax(states, {}, &PlannedState::Y);
    low = least.Y;
    high = most.Y;
    middle = 0.5 * (low + high);
    if (are_one()) low = high = middle;
  }

  [[nodiscard]] bool are_one() const { return high < one_level * low; }
};

void add_repeated_levels(CandidateList& list, const Levels& levels, const States& same, double natural,
                         bool phases) {
  const auto count = static_cast<int>(same.size());
  if (levels.are_one()) {
    list.add("the level of the record at the frequency nearest to resonance, taken several times",
             at_levels({levels.middle}, {count}, same, natural), phases);
    return;
  }
  list.add("the lowest and the highest level, each taken several times",
           at_levels({levels.low, levels.high}, shared_out(count, 2), same, natural), phases);
  list.add("three levels: half of the states at the lowest, a quarter in the middle, a quarter at the highest",
           at_levels({levels.low, levels.middle, levels.high}, shared_out(count, 3), same, natural), phases);
}

void add_resonance_curves(CandidateList& list, const Levels& levels, double natural, double zeta, int count,
                          bool has_phase) {
  const auto curve = [&](double level) { return resonance_curve(level, natural, zeta, count); };
  const std::string start = "the resonance curve at the ";
  const std::string middle = start + (levels.are_one() ? "level of the record" : "middle level");
  if (!has_phase) list.add(middle, curve(levels.middle), false);
  list.add(middle + ", with phases", curve(levels.middle), true);
  list.add(start + "lowest level, with phases", curve(levels.low), true);
  list.add(start + "highest level, with phases", curve(levels.high), true);
}

/// By up to twice, as far as the drive can.
void add_higher_levels(CandidateList& list, const Levels& levels, const States& same, const DriveLimits& limits,
                       bool has_phase) {
  constexpr double usual = 2.0;
  constexpr double least = 1.1;
  const double reach = limits.level / levels.high;
  const double times = reach >= least ? std::min(usual, reach) : usual;
  const std::string name = "the same states at levels " +
                           (times == usual ? "twice" : core::format_number(times, 3) + " times") + " as high";
  const States higher = scaled(same, times, 1.0);
  if (!has_phase) list.add(name, higher, false);
  list.add(name + ", with phases", higher, true);
}

}  // namespace

bool DriveLimits::allow(const MeasurementPlan& plan) const {
  constexpr double rounding = 1.0 + 1e-9;
  const auto* states = std::get_if<States>(&plan);
  return states == nullptr || std::ranges::all_of(*states, [&](const PlannedState& state) {
           return state.Y <= level * rounding && state.omega <= frequency * rounding;
         });
}

Candidates candidates_after(const std::vector<Pair>& states, const KnownConstants& constants, double zeta,
                            const DriveLimits& limits) {
  const States same = same_levels(states);
  const Levels levels(same);
  const double natural = constants.natural_frequency();
  const auto count = static_cast<int>(same.size());
  const bool has_phase = std::ranges::any_of(states, [](const Pair& state) { return !std::isnan(state.phase); });
  CandidateList list(limits);
  if (!has_phase) list.add("record the phase of the same states", same, true, true);
  list.add("repeat the same states", same, has_phase);
  add_repeated_levels(list, levels, same, natural, has_phase);
  add_higher_levels(list, levels, same, limits, has_phase);
  const double aside = 1.0 + std::clamp(zeta, 0.01, 0.2);
  const States other_frequency = scaled(same, 1.0, aside);
  const std::string at_other = "the same levels at " + core::format_number(aside, 3) + " times the frequency";
  if (!has_phase) list.add(at_other, other_frequency, false);
  list.add(at_other + ", with phases", other_frequency, true);
  add_resonance_curves(list, levels, natural, zeta, std::max(count, 5), has_phase);
  const double largest_x = std::ranges::max_element(states, {}, &Pair::x)->x;
  list.add({"release the mass from the largest amplitude and read its extremes",
            PlannedDecay{largest_x, std::max(count, 8)}, false, false, 1.0});
  return list.take();
}

CandidateMeasurement first_levels(const std::vector<Pair>& states, const KnownConstants& constants,
                                  const DriveLimits& limits) {
  States measured;
  for (const Pair& state : states) measured.push_back({state.Y, frequency_of(state, constants)});
  const auto [least, most] = std::ranges::minmax(measured, {}, &PlannedState::Y);
  constexpr double wide = 1.5;   // of levels: friction and damping are told apart by their ratio
  constexpr double usual = 3.0;  // times the level at which the mass moves
  const double low = least.Y;
  const double high = most.Y >= wide * low ? most.Y : std::max(most.Y, std::min(usual * low, limits.level));
  constexpr int levels = 8;
  States planned;
  for (int i = 0; i < levels; ++i) {
    const double level = low + (high - low) * i / (levels - 1.0);
    const bool is_known = std::ranges::any_of(measured, [level](const PlannedState& state) {
      return std::max(state.Y, level) < one_level * std::min(state.Y, level);
    });
    if (!is_known) planned.push_back({level, resonance_at(level, measured, constants.natural_frequency())});
  }
  return {.name = "levels evenly spaced up to the highest",
          .plan = planned,
          .phases = true,
          .cost = static_cast<double>(planned.size())};
}

}  // namespace dualdamp::identify
