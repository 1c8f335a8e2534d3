#include "scenarios/measurements/drives.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/numbers.hpp"
#include "core/units.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/data_path.hpp"
#include "sim/engine/drive_pieces.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr std::string_view section_name = "excitation";

std::string with_unit(const CheckedFile& file, double value, std::string_view unit) {
  return core::format_number(value, 4) + " " + core::unit_for(file.coordinate(), unit);
}

sim::Interpolation interpolation_of(const Json& section) {
  const auto word = section.at("interpolation").get<std::string>();
  if (word == "step") return sim::Interpolation::step;
  return word == "cubic" ? sim::Interpolation::cubic : sim::Interpolation::linear;
}

/// The keys beside 'file' of a signal, which has one column and its times.
std::string key_of_signal(core::Setting setting, std::string_view name, std::string_view value) {
  const bool is_time = name == "t";
  if (setting == core::Setting::unit) return is_time ? "'time_unit'" : "'unit' beside 'column'";
  if (setting == core::Setting::column) return is_time ? "'time_column'" : "'column'";
  if (setting == core::Setting::scale && !is_time) return "'scale'";
  return core::key_of_setting(setting, name, value);
}

/// An unknown unit is reported at its place.
bool is_unit(CheckedFile& file, const std::string& path, const Json& section, const std::string& key,
             std::string_view si) {
  if (!section.contains(key)) return true;
  const auto unit = section.at(key).get<std::string>();
  const core::QuantityText factor = core::unit_factor(unit, si, file.coordinate());
  if (factor.value) return true;
  file.complain(path + "." + key, "'" + path + "." + key + "': " + factor.fault,
                core::describe_dimension(si, file.coordinate()), unit, factor.suggestion);
  return false;
}

/// Subtracts the mean or the least-squares line from the values, and adds the offset.
void treat(const Json& section, const std::vector<double>& times, std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const auto detrend = section.at("detrend").get<std::string>();
  double mean = 0.0;
  double slope = 0.0;
  const double middle = std::accumulate(times.begin(), times.end(), 0.0) / count;
  if (detrend != "none") mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  if (detrend == "line") {
    double square = 0.0;
    double product = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      square += (times[i] - middle) * (times[i] - middle);
      product += (times[i] - middle) * (values[i] - mean);
    }
    slope = product / square;
  }
  const double offset = number(section.at("offset"));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += offset - mean - slope * (times[i] - middle);
}

struct Samples {
  std::vector<double> times;
  std::vector<double> values;
};

/// From a data file: time counts from its first sample.
std::optional<Samples> measured_samples(CheckedFile& file, const Json& section, bool is_base, bool is_read) {
  const std::size_t warned = file.warnings.size();
  auto signal = read_signal(file, std::string(section_name), section, is_base ? "y" : "force");
  if (is_read) file.warnings.resize(warned);
  if (!signal) return std::nullopt;
  file.drive_start = signal->times.front();
  for (double& time : signal->times) time -= file.drive_start;
  treat(section, signal->times, signal->values);
  return Samples{std::move(signal->times), std::move(signal->values)};
}

/// From the lists of the scenario.
std::optional<Samples> listed_samples(CheckedFile& file, const Json& section) {
  const std::vector<double> times = grid_values(section.at("times"));
  const std::vector<double> values = grid_values(section.at("values"));
  const auto place = [](std::size_t i) { return "excitation.times[" + std::to_string(i) + "]"; };
  bool is_valid = true;
  const auto complain = [&](const std::string& path, const std::string& what, const std::string& allowed,
                            const std::string& found) {
    file.complain(path, what, allowed, found);
    is_valid = false;
  };
  if (times.size() != values.size())
    complain("excitation.values", "'excitation.values' has another length than 'excitation.times'",
             std::to_string(times.size()) + " values", std::to_string(values.size()));
  if (times.front() != 0.0)
    complain(place(0), "the first time of the drive is not 0", "0 s", with_unit(file, times.front(), "s"));
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    complain(place(i), "the times of the drive do not increase", "> " + with_unit(file, times[i - 1], "s"),
             with_unit(file, times[i], "s"));
    break;
  }
  if (!is_valid) return std::nullopt;
  return Samples{times, values};
}

/// Refuses a base that jumps, also at a repetition.
void check_jumps(CheckedFile& file, const sim::SampledSignal& drive, bool is_base) {
  const bool in_steps = drive.interpolation() == sim::Interpolation::step;
  const bool by_repeat = !in_steps && drive.repeats() && drive.gap() != 0.0;
  const std::string gap = with_unit(file, drive.gap(), is_base ? "m" : "N");
  const bool has_damper = is_base && file.text_at("system", "damper_to") == "base";
  if (has_damper && (in_steps || by_repeat)) {
    const std::string key = in_steps ? "interpolation" : "repeat";
    file.complain("excitation." + key,
                  "'excitation." + key + "': a base that jumps makes an infinite force in a damper to the base",
                  in_steps ? "linear, cubic" : "false, or a drive that ends where it begins",
                  in_steps ? "step" : "a jump of " + gap);
  } else if (by_repeat) {
    file.warnings.push_back("the drive does not end where it begins: where it repeats it jumps by " + gap);
  }
}

/// Warns of a spline that leaves its samples: one doubled or jittered time is enough.
void check_overshoot(CheckedFile& file, const sim::SampledSignal& drive, bool is_base) {
  constexpr double large = 1.0;  // of the range of the samples
  const sim::Overshoot overshoot = drive.largest_overshoot();
  const auto [least, most] = std::ranges::minmax(drive.values());
  if (!(overshoot.size > large * (most - least))) return;
  const std::string unit = is_base ? "m" : "N";
  file.warnings.push_back("the cubic drive leaves the range of its samples, " + with_unit(file, least, unit) +
                          " to " + with_unit(file, most, unit) + ", by " + with_unit(file, overshoot.size, unit) +
                          " at t = " + with_unit(file, overshoot.t, "s") +
                          ": some samples are much closer to each other in time than others; with "
                          "'interpolation: linear' the drive stays within its samples");
}

double pieces_within(const sim::SampledSignal& drive, double duration) {
  const auto count = static_cast<double>(drive.times().size() - 1);
  return drive.repeats() ? count * std::max(1.0, duration / drive.length()) : count;
}

/// Whether these keys are there; one that could not be read has been reported.
bool has_all(const Json& section, std::initializer_list<const char*> keys) {
  return std::ranges::all_of(keys, [&](const char* key) { return section.contains(key); });
}

}  // namespace

sim::Chirp chirp_of(const Json& section) {
  return {.from = number(section.at("from")),
          .to = number(section.at("to")),
          .duration = number(section.at("duration")),
          .law = section.at("spacing") == "log" ? sim::ChirpLaw::exponential : sim::ChirpLaw::linear};
}

std::optional<identify::MeasuredSignal> read_signal(CheckedFile& file, const std::string& path, const Json& section,
                                                    std::string_view column) {
  const std::string name(column);
  const std::string_view si = column == "force" ? "N" : "m";
  const bool are_units = is_unit(file, path, section, "unit", si) && is_unit(file, path, section, "time_unit", "s");
  if (!section.contains("file") || !are_units) return std::nullopt;
  identify::ReadOptions options;
  options.name = section.at("file").get<std::string>();
  options.coordinate = file.coordinate();
  options.words = key_of_signal;
  const auto take = [&](const char* key, std::map<std::string, std::string>& map, const std::string& of) {
    if (section.contains(key)) map.emplace(of, section.at(key).get<std::string>());
  };
  take("column", options.columns, name);
  take("time_column", options.columns, "t");
  take("unit", options.units, name);
  take("time_unit", options.units, "t");
  take("scale", options.scales, name);
  if (section.contains("decimal")) options.decimal = section.at("decimal").get<std::string>().front();
  options.no_header = section.value("no_header", false);
  options.sample_rate = section.value("sample_rate", 0.0);
  const auto target = path_of_data(file, path + ".file", options.name);
  if (!target) return std::nullopt;
  try {
    const auto text = file.data_place().texts.find(options.name);
    identify::MeasuredSignal signal = text == file.data_place().texts.end()
                                          ? identify::read_signal(*target, column, options)
                                          : identify::parse_signal(text->second, column, options);
    std::ranges::copy(signal.warnings, std::back_inserter(file.warnings));
    if (std::ranges::find(file.sha256, signal.sha256) == file.sha256.end()) file.sha256.push_back(signal.sha256);
    return signal;
  } catch (const core::InputError& error) {
    file.take_over(error.diagnostics());
    return std::nullopt;
  }
}

void read_drive(CheckedFile& file, bool is_read) {
  const std::string name(section_name);
  const std::string type = file.text_at(name, "type");
  const SamplesIn samples_in = samples_of(type);
  if (samples_in == SamplesIn::nowhere) return;
  const bool is_listed = samples_in == SamplesIn::scenario;
  const Json& section = file.values().at(name);
  if (!has_all(section, {"interpolation", "repeat"})) return;
  if (is_listed ? !has_all(section, {"times", "values"}) : !has_all(section, {"detrend", "offset"})) return;
  const bool is_base = moves_base(type);
  auto samples = is_listed ? listed_samples(file, section) : measured_samples(file, section, is_base, is_read);
  if (!samples) return;
  file.drive =
      std::make_shared<const sim::SampledSignal>(std::move(samples->times), std::move(samples->values),
                                                 interpolation_of(section), section.at("repeat").get<bool>());
  check_jumps(file, *file.drive, is_base);
  check_overshoot(file, *file.drive, is_base);
}

void check_drive(CheckedFile& file, double duration) {
  const std::string name(section_name);
  const std::string type = file.text_at(name, "type");
  const sim::Excitation drive = excitation_named(type);
  double pieces = 0.0;
  double end = duration;
  if (drive.is_noise()) pieces = duration * file.number_at(name, "bandwidth").value_or(0.0) / std::numbers::pi;
  if (drive.is_chirp() && has_all(file.values().at(name), {"from", "to", "duration", "spacing"})) {
    const sim::Chirp chirp = chirp_of(file.values().at(name));
    pieces = sim::chirp_pieces(chirp);
    end = chirp.duration;
  }
  if (file.drive != nullptr) {
    pieces = pieces_within(*file.drive, duration);
    if (!file.drive->repeats()) end = file.drive->length();
  }
  if (pieces > max_nodes)
    file.complain(drive.is_noise() ? "excitation.bandwidth" : "excitation", "the drive has too many pieces",
                  "at most " + core::format_number(max_nodes, 8) + " pieces", core::format_number(pieces, 6));
  // After its end a table keeps its last value. A motion and a drive of the same decimal duration may differ in the
  // last binary digit.
  if (samples_of(type) != SamplesIn::scenario && end < duration * (1.0 - 1e-9))
    file.warnings.push_back("the drive ends at t = " + core::format_number(end, 6) + " s, the motion at " +
                            core::format_number(duration, 6) + " s: in between the drive keeps its last value");
}

}  // namespace dualdamp::scenarios
