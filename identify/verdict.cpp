#include "identify/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

using Estimates = std::vector<const Estimate*>;

/// Whose numbers are stated where several methods stand by theirs: those that assume least come first.
constexpr std::array<std::string_view, 8> preference = {
    "output_error", "den_hartog_fit",          "energy_balance",   "resonance_within_sweep",
    "free_decay",   "resonance_least_squares", "resonance_deming", "acceleration_velocity_displacement"};

std::string number(double value) {
  constexpr int digits = 4;
  return core::format_number(value, digits);
}

std::string with_interval(double value, const std::optional<ParameterIntervals>& intervals,
                          std::array<double, 2> ParameterIntervals::* member, const std::string& unit) {
  std::string text = number(value) + unit;
  if (intervals) {
    const auto& [low, high] = (*intervals).*member;
    text += " (95 %: " + number(low) + " to " + number(high) + unit + ")";
  }
  return text;
}

/// "c = 203.5 N.s/m" where there is no spring to make it a damping ratio.
std::string numbers_of(const Estimate& estimate) {
  const bool spring = std::isfinite(estimate.value.zeta);
  const std::string damping =
      spring ? "zeta = " + with_interval(estimate.value.zeta, estimate.interval95, &ParameterIntervals::zeta, "")
             : "c = " + with_interval(estimate.value.c, estimate.interval95, &ParameterIntervals::c, " N.s/m");
  return damping + ", F0 = " + with_interval(estimate.value.F0, estimate.interval95, &ParameterIntervals::F0, " N");
}

std::string range(const std::vector<SubsetFit>& subsets, double ParameterSet::* member) {
  return number(subsets.front().value.*member) + " to " + number(subsets.back().value.*member);
}

std::string rejection(const Estimates& rejected, const std::vector<Estimate>& all) {
  std::string text = "Coulomb + viscous is rejected by these data: ";
  for (const Estimate* estimate : rejected)
    text += (estimate == rejected.front() ? "" : "; ") + estimate->method + " (" + estimate->lack_of_fit->test +
            ", p = " + core::format_number(estimate->lack_of_fit->p_value, 2) + ")";
  text += ".";
  const auto trend =
      std::ranges::find_if(rejected, [](const Estimate* estimate) { return estimate->subsets.size() > 1; });
  if (trend != rejected.end()) {
    const std::vector<SubsetFit>& subsets = (*trend)->subsets;
    text += " From " + subsets.front().label + " to " + subsets.back().label + " of the data zeta goes from " +
            range(subsets, &ParameterSet::zeta) + " and F0 from " + range(subsets, &ParameterSet::F0) + " N.";
  }
  const auto choice =
      std::ranges::find_if(all, [](const Estimate& estimate) { return !estimate.candidates.empty(); });
  if (choice != all.end() && choice->candidates.front().law != "coulomb_viscous")
    text += " Of the laws compared, " + choice->candidates.front().law + " describes them best (weight " +
            core::format_number(choice->candidates.front().weight, 2) + ").";
  return text + " No single zeta and F0 describes them.";
}

bool overlap(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return a[0] <= b[1] && b[0] <= a[1];
}

bool disagree(const Estimate& a, const Estimate& b) {
  if (!a.interval95 || !b.interval95) return false;
  return !overlap(a.interval95->c, b.interval95->c) || !overlap(a.interval95->F0, b.interval95->F0);
}

const Estimate& preferred(const Estimates& usable) {
  const auto rank = [](const Estimate* estimate) {
    return std::ranges::find(preference, std::string_view(estimate->method)) - preference.begin();
  };
  return **std::ranges::min_element(usable, {}, rank);
}

std::string acceptance(const Estimates& usable) {
  const Estimate& best = preferred(usable);
  const bool tested =
      std::ranges::any_of(usable, [](const Estimate* estimate) { return estimate->lack_of_fit.has_value(); });
  std::string text = tested ? "These data do not contradict Coulomb + viscous friction: "
                            : "These data cannot tell whether friction is Coulomb + viscous; if it is, ";
  text += numbers_of(best) + ", by " + best.method + ".";
  for (const Estimate* other : usable)
    if (disagree(best, *other)) text += " " + other->method + " disagrees: " + numbers_of(*other) + ".";
  return text;
}

}  // namespace

std::string verdict(const std::vector<Estimate>& estimates) {
  Estimates usable;
  Estimates rejected;
  const Estimate* first = nullptr;
  for (const Estimate& estimate : estimates) {
    if (!estimate.outcome.ok()) continue;
    if (first == nullptr) first = &estimate;
    if (estimate.usable) usable.push_back(&estimate);
    if (estimate.lack_of_fit && estimate.lack_of_fit->fired) rejected.push_back(&estimate);
  }
  if (!rejected.empty()) return rejection(rejected, estimates);
  if (!usable.empty()) return acceptance(usable);
  return first == nullptr ? "" : "No estimate is to be used: " + first->method + ": " + first->reason + ".";
}

}  // namespace dualdamp::identify
