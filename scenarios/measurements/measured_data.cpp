#include "scenarios/measurements/measured_data.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "core/uncertain_quantity.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/faults/sign_faults.hpp"
#include "identify/records/plausibility.hpp"
#include "identify/records/repeats.hpp"
#include "identify/records/short_blow.hpp"
#include "identify/records/sine_fit.hpp"
#include "identify/records/spikes.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/measurements/data_path.hpp"

namespace dualdamp::scenarios {

namespace {

/// What the scenario states about columns, for a file that does not state it.
identify::ReadOptions read_options(const Json& section, core::Coordinate coordinate, const std::string& name,
                                   const core::SettingWords& words) {
  identify::ReadOptions options;
  options.name = name;
  options.words = words;
  options.coordinate = coordinate;
  for (const auto& [key, map] :
       {std::pair{"units", &options.units}, {"columns", &options.columns}, {"scale", &options.scales}})
    if (section.contains(key))
      for (const auto& [column, text] : section.at(key).items()) map->emplace(column, text.get<std::string>());
  if (section.contains("decimal")) options.decimal = section.at("decimal").get<std::string>().front();
  options.no_header = section.value("no_header", false);
  options.sample_rate = section.value("sample_rate", 0.0);
  options.is_imposed = section.value("loop", false);
  return options;
}

/// From memory, if the caller has put it there.
identify::MeasuredRecord read(const DataTexts& texts, const std::string& path,
                              const identify::ReadOptions& options) {
  const auto text = texts.find(options.name);
  return text == texts.end() ? identify::read_record(path, options) : identify::parse_record(text->second, options);
}

/// If the scenario does not determine the coordinate, the units of the columns do.
identify::MeasuredRecord read_by_units(CheckedFile& file, const std::string& path, const std::string& name,
                                       const Json& section, bool by_force = false) {
  identify::ReadOptions options = read_options(section, file.coordinate(), name, file.words());
  options.force_levels = by_force;
  if (file.coordinate_source()) options.coordinate_reason = file.coordinate_source()->reason();
  try {
    return read(file.data_place().texts, path, options);
  } catch (const core::InputError& fault) {
    if (file.coordinate_source()) throw;
    options.coordinate = core::Coordinate::angle;
    try {
      identify::MeasuredRecord data = read(file.data_place().texts, path, options);
      file.tell_coordinate({options.coordinate, "the units of " + name});
      return data;
    } catch (const core::InputError&) {
      throw fault;
    }
  }
}

/// Whether a file that cannot be read with levels of a base motion can be read with levels of a force, Y [N].
bool holds_force_levels(CheckedFile& file, const std::string& path, const std::string& name, const Json& section) {
  try {
    return read_by_units(file, path, name, section, true).record.pairs.has_value();
  } catch (const core::InputError&) {
    return false;
  }
}

/// A text for each column that a data file may hold.
Field for_columns(std::string name, std::string meaning, bool numbers_only) {
  Section columns;
  for (const std::string_view column : identify::column_names(numbers_only))
    columns.fields.push_back(text(std::string(column), "for the column " + std::string(column)));
  return section(std::move(name), std::move(columns), std::move(meaning));
}

/// Hints on units and columns that follow from the constants.
void refuse_gross_faults(CheckedFile& file, identify::MeasuredRecord& data, double frequency,
                         const std::string& name) {
  if (file.has("system", "damper_to") && file.text_at("system", "damper_to") == "base") return;
  const identify::KnownConstants constants{file.number_at("system", "mass").value_or(identify::unknown),
                                           file.number_at("system", "stiffness").value_or(identify::unknown),
                                           frequency, file.coordinate()};
  file.take_over(identify::gross_faults(data.record, constants, data.units.assumed, name, file.words()));
  for (std::string& warning : identify::odd_readings(data.record, constants))
    data.warnings.push_back(std::move(warning));
}

std::string hertz(double omega) {
  constexpr int digits = 4;
  return core::format_number(omega / core::two_pi, digits) + " Hz";
}

/// A stated frequency that is not the drive's would be ignored: histories and pairs have their own.
void check_stated_frequency(CheckedFile& file, identify::MeasuredRecord& data, double frequency) {
  if (std::isnan(frequency)) return;
  const auto far = [&](double omega) { return std::abs(omega / frequency - 1.0) > 0.01; };
  if (data.record.pairs && data.record.histories.empty()) {
    for (const identify::Pair& pair : data.record.pairs->pairs) {
      if (std::isnan(pair.omega) || !far(pair.omega)) continue;
      file.complain("excitation.frequency",
                    "'excitation.frequency' is " + hertz(frequency) + ", and pair " + std::to_string(pair.number) +
                        " of the file was measured at " + hertz(pair.omega),
                    "leave out what the file states: it has a column omega (frequency)");
      return;
    }
    return;
  }
  if (!data.record.pairs && std::ranges::none_of(data.record.histories, &identify::History::has_drive)) {
    data.warnings.push_back("the stated frequency of " + hertz(frequency) +
                            " is not used: no drive was recorded, and a free vibration has no forcing frequency");
    return;
  }
  for (const identify::History& history : data.record.histories) {
    const double measured =
        history.y.empty() ? frequency : identify::guess_frequency(history.y, history.sample_rate);
    if (!(measured > 0.0) || !far(measured) || data.record.pairs) continue;
    data.warnings.push_back("at the stated frequency of " + hertz(frequency) +
                            " the histories give no steady state: y moves mainly at " + hertz(measured) +
                            ", and the methods take y as it is");
    return;
  }
}

/// An uncertainty of a scale is that of a gain: "2.5 mm/V ± 1 %".
void take_gain_uncertainties(CheckedFile& file) {
  if (!file.has("analysis", "scale")) return;
  const Json& analysis = file.values().at("analysis");
  Json scales = analysis.at("scale");
  Json gains = analysis.value("gain_uncertainty", Json::object());
  for (auto& [column, scale] : scales.items()) {
    const std::string path = "analysis.scale." + column;
    const auto text = scale.get<std::string>();
    core::SplitQuantityText split = core::split_uncertainty(text);
    if (!split.fault.empty()) file.complain(path, "'" + path + "': " + split.fault, "'2.5 mm/V +- 1 %'", text);
    if (!split.relative) continue;
    const std::string signal = column == "Y" ? "y" : column;
    if (!(*split.relative < 1.0))
      file.complain(path, "the uncertainty of '" + path + "' is too large", "less than 100 %", text);
    if (gains.contains(signal) || (signal == "y" && gains.contains("Y")))
      file.complain(path, "the uncertainty of the gain of " + signal + " is stated twice", "one of the two", text);
    scale = std::move(split.quantity);
    gains[signal] = *split.relative;
  }
  file.values()["analysis"]["scale"] = std::move(scales);
  if (!gains.empty()) file.fill_in("gain_uncertainty", std::move(gains));
}

}  // namespace

namespace {

/// Keys for information that a data file does not contain.
std::vector<Field> reading_fields() {
  return {
      for_columns("units", "units of columns for which the data file states none: {x: mm}", true),
      for_columns("columns", "names or numbers of the columns in the data file: {x: LVDT 2}", false),
      for_columns("scale",
                  "factors of the numbers of columns: {x: 2.5 mm/V}; the sensitivity of a sensor, {a: 100 mV/g}, "
                  "and a plain factor, {force: \"35.15\"}, are possible too",
                  true),
      words("decimal", {".", ","}, "decimal mark of a CSV file"),
      boolean("no_header", "the CSV file has no header; 'columns' holds the numbers of the columns"),
      quantity("sample_rate", {"1/s"}, "sample rate of a file that has no times").above(0)};
}

}  // namespace

std::vector<Field> data_fields() {
  std::vector<Field> fields = reading_fields();
  fields.insert(
      fields.begin(),
      text("data",
           "file with the measured data (CSV, MATLAB, universal file), in the scenario's directory or below"));
  return fields;
}

Field data_list(const std::string& name, std::string meaning) {
  std::vector<Field> fields = reading_fields();
  fields.insert(fields.begin(),
                text("file", "CSV, MATLAB or universal file, in the scenario's directory or below").required());
  fields.push_back(boolean("loop",
                           "true: a friction loop, in which force is what moves the mass along the measured "
                           "motion; otherwise force acts on the oscillator"));
  fields.push_back(words("drive", {"y", "force", "none"},
                         "what drove the histories of the file: its column y, the motion of the base, or force, on "
                         "the mass, by cubic splines; none: free vibration. By default that of 'excitation', or y, "
                         "if nothing else drives and the file holds no force"));
  for (const auto& [signal, unit] :
       {std::pair{"x", "m"}, {"v", "m/s"}, {"a", "m/s^2"}, {"force", "N"}, {"phase", "rad"}})
    fields.push_back(quantity(std::string("sigma_") + signal, {unit},
                              std::string("known standard deviation of the noise of ") + signal)
                         .above(0));
  Field field = section(name, {std::move(fields)}, std::move(meaning));
  field.listed = true;
  field.max_items = 64;
  field.short_for = "file";
  return field;
}

namespace {

/// A frequency that could not be resolved is still a word; it is reported elsewhere.
double stated_frequency(const CheckedFile& file) {
  const bool known = file.text_at("excitation", "frequency").ends_with("rad/s");
  return known ? *file.number_at("excitation", "frequency") : identify::unknown;
}

identify::KnownConstants constants_of(const CheckedFile& file) {
  return {file.number_at("system", "mass").value_or(identify::unknown),
          file.number_at("system", "stiffness").value_or(identify::unknown), stated_frequency(file),
          file.coordinate()};
}

/// Whether the file is a friction loop.
bool is_loop(const Json& analysis, const DataFile& file) {
  const Json& list = analysis.at(file.key);
  const Json& keys = list.is_array() ? list.at(file.item) : list;
  return keys.is_object() && keys.value("loop", false);
}

/// Refuses the same readings twice: they would count twice, or predict themselves.
void refuse_repeated(CheckedFile& file, const std::string& key, const identify::MeasuredRecord& data,
                     const Json& item) {
  const bool loop = item.value("loop", false);
  for (const DataFile& other : file.files) {
    // In a loop the force is compared, in a history the motion under the force.
    const bool other_is_loop = is_loop(file.values().at("analysis"), other);
    if (loop != other_is_loop || !identify::share_readings(other.data.record, data.record, loop)) continue;
    file.complain(key, "'" + key + "' holds the same data as " + other.name + " of 'analysis." + other.key + "'",
                  other.key == "data" && key.starts_with("analysis.validate") ? "a record that was not fitted"
                                                                              : "each record once");
    return;
  }
}

}  // namespace

void read_data_list(CheckedFile& file, const std::string& name) {
  if (!file.has("analysis", name)) return;
  Json list = file.values().at("analysis").at(name);
  const bool is_list = list.is_array();
  if (!is_list) list = Json::array({list});
  const bool by_force = excitation_type(file.text_at("excitation", "type")) == sim::ExcitationType::force_harmonic;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].contains("file")) continue;
    const std::string key = "analysis." + name + (is_list ? "[" + std::to_string(i) + "]" : "");
    const std::string data_name = list[i].at("file").get<std::string>();
    const auto path = path_of_data(file, key, data_name);
    if (!path) continue;
    try {
      identify::MeasuredRecord data = read_by_units(file, *path, data_name, list[i], by_force);
      file.note_units(data.units);
      refuse_repeated(file, key, data, list[i]);
      std::ranges::move(identify::repeated_readings(data.record), std::back_inserter(data.warnings));
      if (list[i].value("loop", false))
        file.take_over(identify::gross_faults_of_loops(data.record, constants_of(file), data_name, file.words()));
      else if (by_force && data.record.pairs)  // other checks of pairs compare x with the motion of the base
        file.take_over(
            identify::gross_faults_under_force(*data.record.pairs, constants_of(file), data_name, file.words()));
      else
        refuse_gross_faults(file, data, stated_frequency(file), data_name);
      file.files.push_back({data_name, name, i, std::move(data), {}, file.words()});
    } catch (const core::InputError& error) {
      if (!by_force && holds_force_levels(file, *path, data_name, list[i]))
        file.complain(key,
                      data_name +
                          ": Y in a unit of a force is the amplitude of a driving force, and no force drives "
                          "the steady states",
                      file.words()(core::Setting::value, "excitation", "{type: force_harmonic}"));
      else
        file.take_over(error.diagnostics());
    }
  }
}

std::vector<double> marks_of_files(const Json& analysis, const std::vector<DataFile>& files) {
  std::vector<double> marks;
  for (const DataFile& file : files)
    if (file.key == "data")
      std::ranges::copy(identify::marks_of(file.data.record, is_loop(analysis, file)), std::back_inserter(marks));
  return marks;
}

void refuse_fitted(CheckedFile& file, const std::vector<double>& marks) {
  const Json& analysis = file.values().at("analysis");
  for (const DataFile& one : file.files) {
    if (!identify::share_marks(marks, identify::marks_of(one.data.record, is_loop(analysis, one)))) continue;
    const bool is_list = analysis.at(one.key).is_array();
    const std::string key = "analysis." + one.key + (is_list ? "[" + std::to_string(one.item) + "]" : "");
    file.complain(key, one.name + " holds readings that were fitted: the fit describes them, and predicts nothing",
                  "a record that was not fitted");
  }
}

void check_frequency(CheckedFile& file, const identify::Record& record) {
  const bool is_free = file.node("excitation") == nullptr ||
                       excitation_type(file.text_at("excitation", "type")) == sim::ExcitationType::none;
  const auto lacks_frequency = [](const identify::Pair& pair) { return std::isnan(pair.omega); };
  if (!is_free || !record.pairs || std::ranges::none_of(record.pairs->pairs, lacks_frequency)) return;
  std::string ignored;
  if (file.data)
    for (const std::string& warning : file.data->ignored) ignored += "; " + warning;
  file.complain(
      "analysis.data", "x-Y pairs need the forcing frequency at which they were measured" + ignored,
      file.words()(core::Setting::frequency) + ", or " + file.words()(core::Setting::column, "omega", "NAME"));
}

void read_data(CheckedFile& file) {
  if (!file.has("analysis", "data")) {
    for (const char* key : {"units", "columns", "scale", "decimal", "no_header", "sample_rate"})
      if (file.stands_in_file("analysis", key))
        file.complain(std::string("analysis.") + key,
                      std::string("'analysis.") + key + "' says how to read a data file, and there is none");
    return;
  }
  const std::string name = file.text_at("analysis", "data");
  const auto path = path_of_data(file, "analysis.data", name);
  if (!path) return;
  take_gain_uncertainties(file);
  try {
    identify::MeasuredRecord data = read_by_units(file, *path, name, file.values().at("analysis"));
    file.note_units(data.units);
    const Json& analysis = file.values().at("analysis");
    // Before the spikes: a blow of one sample looks like one.
    std::ranges::move(identify::leave_out_short_blows(data.record.histories), std::back_inserter(data.warnings));
    for (std::string& sentence : identify::treat_spikes(data.record.histories, analysis.value("robust", false)))
      data.warnings.push_back(std::move(sentence));
    const double frequency = stated_frequency(file);
    for (std::string& warning : identify::complete(
             data.record, frequency, file.number_at("system", "stiffness").value_or(identify::unknown)))
      data.warnings.push_back(std::move(warning));
    check_stated_frequency(file, data, frequency);
    refuse_gross_faults(file, data, frequency, name);
    std::ranges::move(identify::repeated_readings(data.record), std::back_inserter(data.warnings));
    file.data = std::move(data);
  } catch (const core::InputError& error) {
    file.take_over(error.diagnostics());
  }
}

}  // namespace dualdamp::scenarios
