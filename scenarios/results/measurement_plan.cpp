#include "scenarios/results/measurement_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "core/units.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::PlannedDecay;
using identify::PlannedState;

/// More states than this are told by their range.
constexpr std::size_t most_listed = 12;

/// Until the transient has fallen to a thousandth by viscous damping; friction makes it faster [s].
double settle_time(const PlannedRig& rig) {
  return rig.zeta > 0.0 ? std::log(1000.0) / (rig.zeta * rig.natural) : core::infinity;
}

/// An extreme is half a period behind the one before [s].
double duration_of(const PlannedDecay& decay, const PlannedRig& rig) {
  return std::numbers::pi * decay.extremes / rig.natural;
}

/// 100 samples in a period: the sample nearest to an extreme is then at most 0.05 % below it [1/s].
double rate_of(const PlannedRig& rig) { return 100.0 * rig.natural / core::two_pi; }

/// How often each state is taken, by frequency and level.
using Repeats = std::map<std::pair<double, double>, int>;

Repeats repeats_of(const std::vector<PlannedState>& states) {
  Repeats repeats;
  for (const PlannedState& state : states) ++repeats[{state.omega, state.Y}];
  return repeats;
}

/// Numbers in the units of the user; frequencies without one in Hz.
class InUnits {
 public:
  InUnits(const ShownUnits& units, core::Coordinate coordinate) : units_(units), coordinate_(coordinate) {}

  [[nodiscard]] std::string level(double Y) const { return text(Y, core::unit_for(coordinate_, "m")); }

  [[nodiscard]] std::string frequency(double omega) const {
    if (shown_unit(units_, "rad/s", omega)) return text(omega, "rad/s");
    return core::format_number(omega / core::two_pi, digits) + " Hz";
  }

 private:
  static constexpr int digits = 4;

  [[nodiscard]] std::string text(double value, const std::string& unit) const {
    const std::optional<ShownUnit> shown = shown_unit(units_, unit, std::abs(value));
    return core::format_number(value * (shown ? shown->factor : 1.0), digits) + " " + (shown ? shown->unit : unit);
  }

  const ShownUnits& units_;
  core::Coordinate coordinate_;
};

std::string seconds(double time) { return core::format_number(time, 2) + " s"; }

bool are_evenly_spaced(const std::vector<double>& values) {
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  constexpr double rounding = 1e-6;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (std::abs(values[i] - values[i - 1] - step) > rounding * step) return false;
  return values.size() > 2;
}

/// The different values, in order.
template <class Of>
std::vector<double> different(const Repeats& repeats, Of of) {
  std::vector<double> values;
  for (const auto& [state, times] : repeats) values.push_back(of(state));
  std::ranges::sort(values);
  const auto rest = std::ranges::unique(values);
  values.erase(rest.begin(), rest.end());
  return values;
}

/// "4 mm (3 times), 5 mm"
std::string levels_at(double omega, const Repeats& repeats, const InUnits& shown) {
  std::string text;
  for (const auto& [state, times] : repeats)
    if (state.first == omega)
      text += (text.empty() ? "" : ", ") + shown.level(state.second) +
              (times > 1 ? " (" + std::to_string(times) + " times)" : "");
  return text;
}

std::string range(const std::vector<double>& values, const auto& shown) {
  return values.size() == 1 ? shown(values.front()) : shown(values.front()) + " to " + shown(values.back());
}

std::string states_text(const Repeats& repeats, const InUnits& shown) {
  const std::vector<double> frequencies = different(repeats, [](const auto& state) { return state.first; });
  const std::vector<double> levels = different(repeats, [](const auto& state) { return state.second; });
  const auto level = [&](double Y) { return shown.level(Y); };
  const auto frequency = [&](double omega) { return shown.frequency(omega); };
  const bool is_once = std::ranges::all_of(repeats, [](const auto& one) { return one.second == 1; });
  if (levels.size() == 1 && is_once && are_evenly_spaced(frequencies))
    return "Y = " + level(levels.front()) + " at " + std::to_string(frequencies.size()) + " frequencies from " +
           frequency(frequencies.front()) + " to " + frequency(frequencies.back()) + ", evenly spaced";
  if (repeats.size() > most_listed)
    return "Y = " + range(levels, level) + " at " + range(frequencies, frequency) + ", all listed in 'states'";
  std::string text;
  for (const double omega : frequencies)
    text += (text.empty() ? "Y = " : "; ") + levels_at(omega, repeats, shown) + " at " + frequency(omega);
  return text;
}

}  // namespace

std::string instruction_of(const identify::CandidateMeasurement& candidate, const PlannedRig& rig,
                           const ShownUnits& units) {
  const InUnits shown(units, rig.coordinate);
  if (const auto* decay = std::get_if<PlannedDecay>(&candidate.plan))
    return "with the base at rest let the mass go from x = " + shown.level(decay->release) + "; read " +
           std::to_string(decay->extremes) + " extremes of x, which take " + seconds(duration_of(*decay, rig)) +
           ", at " + core::format_number(std::ceil(rate_of(rig)), 9) + " samples a second or more";
  const auto& states = std::get<std::vector<PlannedState>>(candidate.plan);
  const double wait = settle_time(rig);
  return std::to_string(states.size()) + (states.size() == 1 ? " state: " : " states: ") +
         states_text(repeats_of(states), shown) +
         (std::isfinite(wait) ? "; wait " + seconds(wait) + " after each change" : "") + "; read x" +
         (candidate.phases ? " and its phase to y" : "");
}

Json plan_json(const identify::CandidateMeasurement& candidate, const PlannedRig& rig) {
  if (const auto* decay = std::get_if<PlannedDecay>(&candidate.plan))
    return {{"release", decay->release},
            {"extremes", decay->extremes},
            {"duration", finite_or_null(duration_of(*decay, rig))},
            {"sample_rate", finite_or_null(rate_of(rig))}};
  Json states = Json::array();
  for (const auto& [state, times] : repeats_of(std::get<std::vector<PlannedState>>(candidate.plan)))
    states.push_back({{"Y", state.second}, {"omega", state.first}, {"times", times}});
  return {{"states", std::move(states)}, {"settle", finite_or_null(settle_time(rig))}};
}

}  // namespace dualdamp::scenarios
