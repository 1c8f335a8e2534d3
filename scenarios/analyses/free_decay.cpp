#include "scenarios/analyses/free_decay.hpp"

#include "scenarios/format/common_keys.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/motion/simulate.hpp"

namespace dualdamp::scenarios {

namespace {

ResultFields free_decay_fields() {
  return {{"peaks[].t", "s", "time of the extreme"},
          {"peaks[].x", "m", "its position, signed"},
          {"came_to_rest", "", "fewer extremes than wanted because the mass sticks"},
          {"creeps", "",
           "fewer extremes than wanted because the motion did not turn again within 100 natural periods"}};
}

std::unique_ptr<const Question> ask_free_decay(CheckedValues&& values) {
  return std::make_unique<FreeDecayQuestion>(values.analysis.at("peaks").get<int>());
}

}  // namespace

Answer FreeDecayQuestion::run(const RunContext& context) const {
  const sim::FreeDecay decay = sim::free_decay(context.model, peaks_);
  if (!decay.outcome.ok()) return failed(decay.outcome.reason);
  Answer answer;
  answer.result["peaks"] = nullptr;
  answer.result["came_to_rest"] = decay.came_to_rest;
  answer.result["creeps"] = decay.creeps;
  if (decay.creeps)
    answer.warnings.push_back("only " + std::to_string(decay.peaks.size()) + " of " + std::to_string(peaks_) +
                              " extremes: the motion does not turn any more within 100 natural periods");
  answer.tables.push_back({.name = "peaks",
                           .columns = {column("t", "s", decay.peaks, &sim::Extreme::t),
                                       column("x", "m", decay.peaks, &sim::Extreme::x)},
                           .key = "peaks",
                           .is_complete = true});
  return answer;
}

const Analysis& free_decay_analysis() {
  static const Analysis analysis = {
      .name = "free_decay",
      .summary = "extremes of the free vibration from the initial state",
      .keys = {{peaks()}},
      .needs = {needs_of_free_vibrations("")},
      .results = free_decay_fields(),
      .chart = {.table = "peaks", .list = "peaks", .x = "t", .y = "x", .x_label = "time t", .y_label = "extreme x"},
      .verifiable = true,
      .ask = ask_free_decay};
  return analysis;
}

}  // namespace dualdamp::scenarios
