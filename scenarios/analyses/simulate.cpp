#include "scenarios/analyses/simulate.hpp"

#include "scenarios/format/excitations.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/work_checks.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/motion/simulate.hpp"

namespace dualdamp::scenarios {

namespace {

Section keys() {
  return {{quantity("duration", {"s"}, "time to simulate").above(0),
           quantity("cycles", {"1"}, "time to simulate, in forcing periods").above(0).at_most(max_periods),
           quantity("sample_rate", {"1/s"}, "rows of history.csv in a second; without it the file is not written")
               .above(0)},
          {{{"duration", "cycles"}, true}}};
}

ResultFields fields() {
  return joined({{"events[].t", "s", "time"},
                 {"events[].kind", "", "reversal, stop, release, grazing, switching"},
                 {"events[].x", "m", "position"},
                 {"events[].v", "m/s", "velocity"},
                 {"final.t", "s", "time at the end"},
                 {"final.x", "m", "position at the end"},
                 {"final.v", "m/s", "velocity at the end"}},
                joined(energy_fields(), certificate_fields()));
}

void check(CheckedFile& file) {
  check_work(file, file.values().at("analysis"), "analysis",
             {"analysis.sample_rate", file.number_at("analysis", "sample_rate")});
}

std::unique_ptr<const Question> ask(CheckedValues&& values) {
  return std::make_unique<SimulateQuestion>(duration_of(values.analysis, values.model.excitation.frequency),
                                            number_or(values.analysis, "sample_rate", 0.0));
}

Table event_table(const std::vector<sim::Event>& events) {
  return {.name = "events",
          .columns = {column("t", "s", events, &sim::Event::t),
                      text_column("kind", events, [](const sim::Event& event) { return sim::name(event.kind); }),
                      column("x", "m", events, &sim::Event::x), column("v", "m/s", events, &sim::Event::v)},
          .key = "events",
          .is_complete = true};
}

}  // namespace

Answer SimulateQuestion::run(const RunContext& context) const {
  sim::SimulateOptions options;
  options.duration = duration_;
  options.sample_rate = sample_rate_;
  constexpr long max_events = 1'000'000;  // each is an item of the result
  options.max_events = max_events;
  const sim::History history = sim::simulate(context.model, options);
  if (!history.outcome.ok()) return failed(history.outcome.reason);
  Answer answer;
  answer.result["events"] = nullptr;
  answer.result["final"] = {{"t", history.final.t}, {"x", history.final.x}, {"v", history.final.v}};
  answer.result["energy"] = energy_json(history.energy);
  add_certificate(answer.result, context.model, history.certificate);
  answer.tables.push_back(event_table(history.events));
  if (!history.samples.empty())
    answer.tables.push_back(history_table("history", history.samples, context.model.excitation));
  return answer;
}

const Analysis& simulate_analysis() {
  static const Analysis analysis = {.name = "simulate",
                                    .summary = "the motion from its initial state",
                                    .keys = keys(),
                                    .needs = {{"", excitations().names(), {"amplitude", "frequency"}, true, ""}},
                                    .results = fields(),
                                    .main = {"final.x", "final.v", "energy.friction"},
                                    .verifiable = true,
                                    .check = check,
                                    .ask = ask};
  return analysis;
}

}  // namespace dualdamp::scenarios
