#include "scenarios/measurements/measurement.hpp"

#include <algorithm>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/sensors.hpp"
#include "scenarios/measurements/work_checks.hpp"

namespace dualdamp::scenarios {

namespace {

/// Number of repetitions of the tests of a measurement, and the change of friction between them.
std::vector<Field> repetition() {
  return {
      integer("sweeps", "number of sweeps; each repeats all tests").with_fallback(1).at_least(1).at_most(10'000),
      section("friction_drift",
              {{quantity("rate", {"1"}, "change of all friction forces from sweep to sweep, relative to the first")
                    .with_fallback(0.0),
                quantity("walk", {"1"},
                         "standard deviation of a random change from sweep to sweep, relative to the first")
                    .with_fallback(0.0)
                    .at_least(0),
                seed()}},
              "friction that differs from sweep to sweep")};
}

Choice measurements() {
  std::vector<Field> curve = {amplitudes(), optional(frequencies())};
  std::vector<Field> response = {frequencies()};
  std::vector<Field> histories = {
      optional(amplitudes()), quantity("duration", {"s"}, "length of a record").above(0),
      quantity("cycles", {"1"}, "length of a record in forcing periods").above(0).at_most(max_periods),
      quantity("settle", {"s"}, "time from the initial state until the record begins")
          .with_fallback(0.0)
          .at_least(0),
      word_list("signals", {"x", "v", "a"}, "signals recorded in addition to the drive; default: all")};
  for (std::vector<Field>* fields : {&curve, &response, &histories})
    for (Field& field : repetition()) fields->push_back(std::move(field));
  return {"type",
          {{"xy_curve", "steady states at several amplitudes, at one frequency or several", {std::move(curve)}},
           {"frequency_response", "steady states at several frequencies", {std::move(response)}},
           {"free_decay", "extremes of a free vibration", {{peaks()}}},
           {"simulate",
            "time histories from the initial state, one for each amplitude",
            {std::move(histories), {{{"duration", "cycles"}, true}}}}}};
}

using core::two_pi;

std::optional<double> sensor_number(const CheckedFile& file, const std::string& key) {
  if (!file.has("analysis", "sensors") || !file.values().at("analysis").at("sensors").contains(key))
    return std::nullopt;
  return number(file.values().at("analysis").at("sensors").at(key));
}

/// 1 if the file is too faulty for it.
int sweeps(const CheckedFile& file) {
  return file.measurement()->contains("sweeps") ? file.measurement()->at("sweeps").get<int>() : 1;
}

/// Number of motions of a synthetic measurement.
double tests(const CheckedFile& file) {
  double count = sweeps(file);
  for (const char* key : {"amplitudes", "frequencies"})
    if (file.measurement()->contains(key)) count *= static_cast<double>(grid_size(file.measurement()->at(key)));
  return count;
}

/// Longest forcing period in a measurement [s]; 0 if it is not known yet.
double longest_period(const CheckedFile& file) {
  double slowest = file.number_at("excitation", "frequency").value_or(0.0);
  if (file.measurement()->contains("frequencies")) {
    const Json& grid = file.measurement()->at("frequencies");
    slowest = core::infinity;
    for (const Json& value : grid.is_array() ? grid : Json::array({grid.at("from"), grid.at("to")}))
      slowest = std::min(slowest, number(value));
  }
  return slowest > 0.0 ? two_pi / slowest : 0.0;
}

/// Whether time histories have a signal that may be left out: v or a.
bool records(const CheckedFile& file, const char* signal) {
  if (!file.measurement()->contains("signals")) return true;
  const Json& signals = file.measurement()->at("signals");
  return std::ranges::find(signals, signal) != signals.end();
}

void check_lags(CheckedFile& file) {
  if (!file.has("analysis", "sensors") || excitation_named(file.text_at("excitation", "type")).is_harmonic())
    return;
  for (const auto& [name, sensor] : file.values().at("analysis").at("sensors").items())
    if (sensor.is_object() && sensor.contains("phase_lag"))
      file.complain("analysis.sensors." + name + ".phase_lag",
                    "a phase lag needs a harmonic excitation: it is an angle at the forcing frequency", "a delay");
}

/// Signals of which a measurement takes readings; nothing if the file is too faulty for it.
std::vector<std::string> read_signals(const CheckedFile& file) {
  const auto type = file.measurement()->at("type").get<std::string>();
  if (type == "free_decay") return {"x"};
  const bool is_sampled = file.is_given("analysis.sensors.sample_rate");
  // Without samples, a sensor of v reads the mean square speed of a steady state.
  if (type != "simulate")
    return is_sampled ? std::vector<std::string>{"y", "x", "v", "a"} : std::vector<std::string>{"y", "x", "v"};
  const auto drive = file.text_at("excitation", "type");
  if (drive.empty() && file.node("excitation") != nullptr) return {};
  std::vector<std::string> signals = {"x"};
  if (moves_base(drive))
    signals.insert(signals.begin(), "y");
  else if (excitation_named(drive).type != sim::ExcitationType::none)
    signals.emplace_back("force");
  for (const char* signal : {"v", "a"})
    if (records(file, signal)) signals.emplace_back(signal);
  return signals;
}

/// Refuses sensors, and keys of sensors, that do not affect the record.
void check_sensors(CheckedFile& file) {
  const std::string path = "analysis.sensors";
  check_outliers(file, path);
  const std::vector<std::string> signals = read_signals(file);
  for (const char* signal : {"y", "x", "v", "a", "force"})
    if (const std::string sensor = path + "." + signal;
        file.is_given(sensor) && !signals.empty() && std::ranges::find(signals, signal) == signals.end())
      file.complain(sensor, "'" + sensor + "' has no effect: the measurement takes no readings of " + signal,
                    "sensors of " + core::joined(signals));
  const auto type = file.measurement()->at("type").get<std::string>();
  const bool is_curve = type != "free_decay" && type != "simulate";
  if (!is_curve && sensor_number(file, "average_cycles").value_or(1.0) != 1.0)
    file.complain(
        path + ".average_cycles",
        "'" + path + ".average_cycles' has no effect: the measurement reads no amplitudes of steady states",
        "a measurement 'xy_curve' or 'frequency_response'");
  if (type == "free_decay" && file.is_given(path + ".x.delay"))
    file.complain(path + ".x.delay", "'" + path + ".x.delay' has no effect: the times of extremes are exact",
                  "a measurement 'simulate' without excitation");
  for (const std::string& lag : {path + ".v.phase_lag", path + ".v.delay"})
    if (is_curve && file.is_given(lag) && !file.is_given(path + ".sample_rate"))
      file.complain(lag, "'" + lag + "' has no effect: without samples the sensor reads the mean square speed",
                    "with a sample_rate");
}

/// Refuses a drift between sweeps if there is only one.
void check_drift(CheckedFile& file) {
  const std::string path = "analysis.measurement.friction_drift";
  if (file.is_given(path) && !file.is_given("analysis.measurement.sweeps"))
    file.complain(path, "'" + path + "' has no effect: the measurement has one sweep", "with two or more 'sweeps'");
}

/// Refuses amplitudes if the drive has no amplitude.
void check_amplitudes(CheckedFile& file) {
  const Variant* drive = excitations().find(file.text_at("excitation", "type"));
  if (drive == nullptr || !file.measurement()->contains("amplitudes")) return;
  if (drive->section.find("amplitude") == nullptr)
    file.complain("analysis.measurement.amplitudes",
                  "'analysis.measurement.amplitudes' needs an excitation that has an amplitude",
                  "base_harmonic, force_harmonic, base_chirp, force_chirp", drive->name);
}

/// The outline has two different frequencies; their values have no meaning.
identify::PairRecord outline_pairs(const CheckedFile& file) {
  const auto count = [&](const char* key) {
    return file.measurement()->contains(key) ? grid_size(file.measurement()->at(key)) : std::size_t{1};
  };
  identify::PairRecord record;
  for (int sweep = 1; sweep <= sweeps(file); ++sweep)
    for (std::size_t i = 0; i < count("frequencies"); ++i)
      record.pairs.insert(record.pairs.end(), count("amplitudes"),
                          {.Y = 1.0,
                           .x = 1.0,
                           .sweep = sweeps(file) > 1 ? std::to_string(sweep) : "",
                           .omega = static_cast<double>(i + 1),
                           .phase = 0.0,
                           .fundamental = 1.0,
                           .mean_square_speed = 1.0});
  return record;
}

identify::History outline_history(const CheckedFile& file) {
  identify::History history{.sample_rate = 1.0};
  const auto type = file.text_at("excitation", "type");
  if (moves_base(type))
    history.y = {0.0};
  else if (excitation_named(type).type != sim::ExcitationType::none)
    history.force = {0.0};
  history.x = {0.0};
  if (records(file, "v")) history.v = {0.0};
  if (records(file, "a")) history.a = {0.0};
  return history;
}

}  // namespace

std::vector<Field> measurement_fields() {
  return {choice("measurement", measurements(), "a synthetic measurement of this scenario's system"),
          section("sensors", {sensor_fields()}, "sensors of a synthetic measurement; default: perfect ones")};
}

Measurement measurement_of(const Json& section, const sim::Model& model) {
  Measurement result;
  const auto type = section.at("type").get<std::string>();
  if (type == "free_decay") {
    result.kind = MeasurementKind::free_decay;
    result.peaks = section.at("peaks").get<int>();
    return result;
  }
  if (section.contains("amplitudes")) result.amplitudes = grid_values(section.at("amplitudes"));
  if (section.contains("frequencies")) result.frequencies = grid_values(section.at("frequencies"));
  result.sweeps = section.at("sweeps").get<int>();
  if (section.contains("friction_drift")) {
    const Json& drift = section.at("friction_drift");
    result.drift = {number(drift.at("rate")), number(drift.at("walk")), drift.at("seed").get<std::uint64_t>()};
  }
  if (type != "simulate") return result;
  result.kind = MeasurementKind::histories;
  result.duration = duration_of(section, model.excitation.frequency);
  result.settle = number(section.at("settle"));
  if (section.contains("signals")) {
    const Json& signals = section.at("signals");
    result.with_v = std::ranges::find(signals, "v") != signals.end();
    result.with_a = std::ranges::find(signals, "a") != signals.end();
  }
  return result;
}

void check_measurement(CheckedFile& file) {
  const std::string rate_path = "analysis.sensors.sample_rate";
  if (file.measurement() == nullptr) {
    if (file.stands_in_file("analysis", "sensors") && !file.stands_in_file("analysis", "measurement"))
      file.complain("analysis.sensors", "'analysis.sensors' belongs to a synthetic measurement, and there is none");
    return;
  }
  if (tests(file) > max_points)
    file.complain("analysis.measurement", "the measurement has too many points",
                  "at most " + core::format_number(max_points, 7) + " in all sweeps",
                  core::format_number(tests(file), 7));
  check_lags(file);
  check_sensors(file);
  check_drift(file);
  check_amplitudes(file);
  const auto type = file.measurement()->at("type").get<std::string>();
  const auto rate = sensor_number(file, "sample_rate");
  if (type == "simulate") {
    if (!file.is_given(rate_path))
      file.complain("analysis.measurement.type", "'" + rate_path + "' is missing: time histories are samples",
                    "a rate such as '1 kHz'");
    check_work(file, *file.measurement(), "analysis.measurement", {rate_path, rate, tests(file)});
  } else if (rate && type == "free_decay") {
    file.complain(rate_path, "extremes of a free vibration are read, not sampled",
                  "a measurement 'simulate' without excitation");
  } else if (rate) {
    check_rows(file, rate_path,
               tests(file) * sensor_number(file, "average_cycles").value_or(1.0) * *rate * longest_period(file));
  }
}

identify::Record outline(const CheckedFile& file) {
  identify::Record record;
  const auto type = file.measurement()->at("type").get<std::string>();
  if (type == "free_decay") {
    record.decay = identify::DecayRecord{{1.0}, {0.0}};
    return record;
  }
  if (sensor_number(file, "sample_rate"))
    record.histories.resize(static_cast<std::size_t>(tests(file)), outline_history(file));
  if (excitation_type(file.text_at("excitation", "type")) == sim::ExcitationType::base_harmonic)
    record.pairs = outline_pairs(file);
  return record;
}

}  // namespace dualdamp::scenarios
