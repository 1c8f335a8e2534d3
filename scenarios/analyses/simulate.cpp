#include "scenarios/analyses/simulate.hpp"

#include <cmath>
#include <span>

#include "identify/statistics/noise_level.hpp"
#include "scenarios/analyses/shared/motion_chart.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/drives.hpp"
#include "scenarios/measurements/work_checks.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/motion/simulate.hpp"

namespace dualdamp::scenarios {

namespace {

Section measured_keys() {
  std::vector<Field> fields = signal_file("x", "m");
  fields.push_back(
      quantity("noise", {"m"}, "standard deviation of the sensor's noise; default: estimated from the samples")
          .above(0));
  return {std::move(fields)};
}

Section simulate_keys() {
  return {
      {quantity("duration", {"s"}, "time to simulate; default: that of a drive which ends").above(0),
       quantity("cycles", {"1"}, "time to simulate, in forcing periods").above(0).at_most(max_periods),
       quantity("sample_rate", {"1/s"}, "rows per second of history.csv; without this key the file is not written")
           .above(0),
       section("measured", measured_keys(),
               "a measured motion x to compare with the simulated one; its first sample is at t = 0, and "
               "history.csv has a row for each of its samples")},
      {{{"duration", "cycles"}, false}}};
}

ResultFields simulate_fields() {
  return joined({{"events[].t", "s", "time"},
                 {"events[].kind", "", "reversal, stop, release, grazing, switching"},
                 {"events[].x", "m", "position"},
                 {"events[].v", "m/s", "velocity"},
                 {"final.t", "s", "time at the end"},
                 {"final.x", "m", "position at the end"},
                 {"final.v", "m/s", "velocity at the end"},
                 {"residual.samples", "1", "measured samples within the duration; only with 'measured'"},
                 {"residual.rms", "m", "root mean square of measured less simulated position"},
                 {"residual.noise", "m", "standard deviation of the sensor's noise, stated or estimated"},
                 {"residual.noise_units", "1", "rms over noise; 1 if the residual is noise alone"}},
                joined(energy_fields(), certificate_fields()));
}

/// A motion for which no time is stated lasts as long as its drive, if that ends.
void take_time_of_drive(CheckedFile& file) {
  if (file.stands_in_file("analysis", "duration") || file.stands_in_file("analysis", "cycles")) return;
  const std::string type = file.text_at("excitation", "type");
  const bool is_chirp = excitation_named(type).is_chirp();
  const bool is_sampled = samples_of(type) != SamplesIn::nowhere;
  std::optional<double> end;
  if (is_chirp) end = file.number_at("excitation", "duration");
  if (is_sampled && file.drive != nullptr) end = file.drive->length();
  if ((is_chirp || is_sampled) && !end) return;  // it could not be read, which has been reported
  if (end && !(is_sampled && file.drive->repeats()))
    file.fill_in("duration", *end);
  else
    file.complain(file.node("analysis")->head(), "'analysis' needs one of duration, cycles",
                  "one of them; neither under a drive that ends: a chirp, or samples without 'repeat'");
}

void check_simulate(CheckedFile& file) {
  take_time_of_drive(file);
  check_work(file, file.values().at("analysis"), "analysis",
             {"analysis.sample_rate", file.number_at("analysis", "sample_rate")});
  if (!file.has("analysis", "measured")) return;
  if (file.has("analysis", "sample_rate"))
    file.complain("analysis.sample_rate",
                  "'analysis.sample_rate' beside 'analysis.measured': the rows are those of the measured samples",
                  "one of the two");
  file.compared = read_signal(file, "analysis.measured", file.values().at("analysis").at("measured"), "x");
  if (!file.compared) return;
  std::vector<double>& times = file.compared->times;
  const double start = times.front();
  for (double& time : times) time -= start;
  check_rows(file, "analysis.measured", static_cast<double>(times.size()));
}

MeasuredMotion measured_motion(CheckedValues& values) {
  if (!values.compared) return {};
  return {std::move(values.compared->times), std::move(values.compared->values),
          number_or(values.analysis.at("measured"), "noise", 0.0)};
}

std::unique_ptr<const Question> ask_simulate(CheckedValues&& values) {
  return std::make_unique<SimulateQuestion>(duration_of(values.analysis, values.model.excitation.frequency),
                                            number_or(values.analysis, "sample_rate", 0.0),
                                            measured_motion(values));
}

/// Differences of fourth order need equally spaced times.
bool is_even(std::span<const double> times) {
  const double step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - times[i - 1] - step) > 0.01 * step) return false;
  return true;
}

/// Noise level of the sensor [m]: stated, or estimated if the samples allow it; otherwise 0.
double noise_of(const MeasuredMotion& measured, std::size_t count) {
  constexpr std::size_t fewest = 20;
  if (measured.noise > 0.0) return measured.noise;
  if (count < fewest || !is_even(std::span(measured.times).first(count))) return 0.0;
  return identify::noise_level(std::span(measured.x).first(count));
}

/// Measured less simulated, as columns of the history and as numbers of the result.
void add_residual(const MeasuredMotion& measured, const std::vector<sim::Sample>& samples, Answer& answer) {
  Column signal{.name = "measured", .unit = "m"};
  Column residual{.name = "residual", .unit = "m"};
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    signal.numbers.push_back(measured.x[i]);
    residual.numbers.push_back(measured.x[i] - samples[i].x);
    sum += residual.numbers[i] * residual.numbers[i];
  }
  const double rms = std::sqrt(sum / static_cast<double>(samples.size()));
  const double noise = noise_of(measured, samples.size());
  Json& json = answer.result["residual"];
  json = {{"samples", samples.size()}, {"rms", rms}, {"noise", nullptr}, {"noise_units", nullptr}};
  if (noise > 0.0) {
    json["noise"] = noise;
    json["noise_units"] = rms / noise;
  } else {
    answer.warnings.emplace_back(
        "the noise of the sensor is not known: its estimate needs 20 evenly spaced samples that are not all equal; "
        "'noise' states it");
  }
  for (Column* column : {&signal, &residual}) answer.tables.back().columns.push_back(std::move(*column));
}

Table event_table(const std::vector<sim::Event>& events) {
  return {.name = "events",
          .columns = {column("t", "s", events, &sim::Event::t),
                      text_column("kind", events, [](const sim::Event& event) { return sim::name_of(event.kind); }),
                      column("x", "m", events, &sim::Event::x), column("v", "m/s", events, &sim::Event::v)},
          .key = "events",
          .is_complete = true};
}

}  // namespace

Answer SimulateQuestion::run(const RunContext& context) const {
  sim::SimulateOptions options;
  options.duration = duration_;
  options.sample_rate = sample_rate_;
  options.times = measured_.times;
  constexpr long max_events = 3'000'000;  // each is an item of the result; some 450 MB of memory
  options.max_events = max_events;
  const sim::History history = sim::simulate(context.model, options);
  if (!history.outcome.ok()) return failed(history.outcome.reason);
  Answer answer;
  answer.result["events"] = nullptr;
  answer.result["final"] = {{"t", history.final.t}, {"x", history.final.x}, {"v", history.final.v}};
  answer.final_acceleration = history.final.a;
  answer.result["energy"] = energy_json(history.energy);
  add_certificate(answer.result, context.model, history.certificate);
  answer.tables.push_back(event_table(history.events));
  if (!history.samples.empty())
    answer.tables.push_back(history_table("history", history.samples, context.model.excitation));
  if (!measured_.times.empty()) add_residual(measured_, history.samples, answer);
  return answer;
}

const Analysis& simulate_analysis() {
  static const Analysis analysis = {.name = "simulate",
                                    .summary = "the motion from its initial state",
                                    .keys = simulate_keys(),
                                    .needs = {{"", excitations().names(), {"amplitude", "frequency"}, true, ""}},
                                    .results = simulate_fields(),
                                    .main = {"final.x", "final.v", "energy.friction"},
                                    .chart = motion_chart("history", "analysis.sample_rate"),
                                    .verifiable = true,
                                    .check = check_simulate,
                                    .ask = ask_simulate};
  return analysis;
}

}  // namespace dualdamp::scenarios
