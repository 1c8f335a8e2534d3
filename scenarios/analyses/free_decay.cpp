#include "scenarios/analyses/free_decay.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenarios/format/common_keys.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/motion/free_decay.hpp"

namespace dualdamp::scenarios {

namespace {

ResultFields free_decay_fields() {
  return {
      {"peaks[].t", "s", "time of the extreme"},
      {"peaks[].x", "m", "its position, signed"},
      {"came_to_rest", "", "fewer extremes than wanted because the mass never moves again"},
      {"pauses", "",
       "fewer extremes than wanted because the mass has been held for 100 natural periods; what acts on it still "
       "changes, so that it may move again"},
      {"creeps", "", "fewer extremes than wanted because the motion did not turn again within 100 natural periods"},
      {"fades", "", "fewer extremes than wanted because further swings are below the error of the solver"}};
}

/// Leaves out the extremes after swings that are below ten times the error of the engine, which hold its rounding
/// errors. Are there any?
bool leave_out_faded(std::vector<sim::Extreme>& peaks, double accuracy) {
  double largest = 0.0;
  for (std::size_t i = 1; i < peaks.size(); ++i) {
    const double swing = std::abs(peaks[i].x - peaks[i - 1].x);
    largest = std::max(largest, swing);
    if (swing >= 10.0 * accuracy * largest) continue;
    peaks.resize(i);
    return true;
  }
  return false;
}

const char* reason_of_end(bool pauses, bool fades) {
  if (fades) return "further swings are below the error of the solver";
  if (pauses)
    return "the mass has been held for 100 natural periods; what acts on it still changes, so that it may move "
           "again, which 'simulate' shows";
  return "the motion does not turn any more within 100 natural periods";
}

std::unique_ptr<const Question> ask_free_decay(CheckedValues&& values) {
  return std::make_unique<FreeDecayQuestion>(values.analysis.at("peaks").get<int>());
}

}  // namespace

Answer FreeDecayQuestion::run(const RunContext& context) const {
  sim::FreeDecay decay = sim::free_decay(context.model, peaks_);
  if (!decay.outcome.ok()) return failed(decay.outcome.reason);
  const bool fades = leave_out_faded(decay.extremes, decay.accuracy);
  const bool creeps = decay.creeps && !fades;
  const bool pauses = decay.pauses && !fades;
  Answer answer;
  answer.result["peaks"] = nullptr;
  answer.result["came_to_rest"] = decay.came_to_rest;
  answer.result["pauses"] = pauses;
  answer.result["creeps"] = creeps;
  answer.result["fades"] = fades;
  if (creeps || pauses || fades)
    answer.warnings.push_back("only " + std::to_string(decay.extremes.size()) + " of " + std::to_string(peaks_) +
                              " extremes: " + reason_of_end(pauses, fades));
  answer.tables.push_back({.name = "peaks",
                           .columns = {column("t", "s", decay.extremes, &sim::Extreme::t),
                                       column("x", "m", decay.extremes, &sim::Extreme::x)},
                           .key = "peaks",
                           .is_complete = true,
                           .ends_with_accuracy = true});
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
