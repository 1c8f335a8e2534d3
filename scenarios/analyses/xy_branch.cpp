#include "scenarios/analyses/xy_branch.hpp"

#include "scenarios/analyses/shared/branches.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

std::unique_ptr<const Question> ask_xy_branch(CheckedValues&& values) {
  const Json& range = values.analysis.at("amplitudes");
  return std::make_unique<BranchQuestion>(sim::BranchParameter::amplitude, number(range.at("from")),
                                          number(range.at("to")));
}

}  // namespace

const Analysis& xy_branch_analysis() {
  static const Analysis analysis = {
      .name = "xy_branch",
      .summary = "continuation of one orbit in amplitude, past folds and through orbits that do not attract",
      .keys = {{range("amplitudes", {"m", "N"}, "range of the excitation amplitude")}},
      .needs = needs_of_steady_states({"frequency"}),
      .results = branch_fields({"Y", unit_of_drive, "excitation amplitude"}),
      .chart = {.table = "branch",
                .list = "points",
                .x = "Y",
                .y = "x",
                .x_label = "input amplitude Y",
                .y_label = "output amplitude x",
                .by = "stable"},
      .ask = ask_xy_branch};
  return analysis;
}

}  // namespace dualdamp::scenarios
