#include "scenarios/analyses/frequency_branch.hpp"

#include "scenarios/analyses/shared/branches.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

std::unique_ptr<const Question> ask_frequency_branch(CheckedValues&& values) {
  const Json& range = values.analysis.at("frequencies");
  return std::make_unique<BranchQuestion>(sim::BranchParameter::frequency, number(range.at("from")),
                                          number(range.at("to")));
}

}  // namespace

const Analysis& frequency_branch_analysis() {
  static const Analysis analysis = {.name = "frequency_branch",
                                    .summary = "continuation of one orbit in frequency",
                                    .keys = {{range("frequencies", {"rad/s"}, "range of the forcing frequency")}},
                                    .needs = needs_of_steady_states({"amplitude"}),
                                    .results = branch_fields({"omega", "rad/s", "forcing frequency"}),
                                    .chart = {.table = "branch",
                                              .list = "points",
                                              .x = "omega",
                                              .y = "x",
                                              .x_label = "frequency",
                                              .y_label = "output amplitude x",
                                              .by = "stable"},
                                    .ask = ask_frequency_branch};
  return analysis;
}

}  // namespace dualdamp::scenarios
