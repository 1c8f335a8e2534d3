#include "scenarios/analyses/shared/record_drive.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/experiments/drive_values.hpp"
#include "identify/statistics/finer_samples.hpp"
#include "identify/statistics/noise_level.hpp"
#include "scenarios/analyses/shared/short_blows.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/measurements/drives.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::History;

bool moves(const std::vector<double>& signal) {
  return !signal.empty() && std::ranges::min(signal) < std::ranges::max(signal);
}

std::string seconds(double t) { return core::format_number(t, 6) + " s"; }

/// Why the drive does not begin with the history; empty if it does.
std::string other_clock(const History& history, const sim::Excitation& drive, double drive_start) {
  const std::string begins = "the record begins at t = " + seconds(history.start);
  if (drive.is_chirp() && (history.start < 0.0 || history.start >= drive.chirp.duration))
    return begins + ", and the chirp lasts from 0 to " + seconds(drive.chirp.duration);
  const double start = drive.is_sampled() ? drive_start : 0.0;
  if (!(drive.is_sampled() || drive.is_noise()) || std::abs(history.start - start) * history.sample_rate <= 0.5)
    return {};
  return begins + ", and the drive at t = " + seconds(start) + ": both must begin at the same time";
}

/// Times of samples on the clock of the motion [s].
std::vector<double> times_at(double rate, std::size_t count) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = static_cast<double>(i) / rate;
  return times;
}

std::vector<double> driven_by(sim::Model model, const History& history, const std::vector<double>& times) {
  model.excitation = identify::drive_from(model.excitation, history.start, times.back());
  identify::DriveValues values = identify::drive_values(model, times);
  return std::move(model.excitation.moves_base() ? values.y : values.force);
}

/// Values minus their mean.
Eigen::VectorXd centred(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::VectorXd> all(values.data(), static_cast<Eigen::Index>(values.size()));
  return all.array() - all.mean();
}

/// rms of the difference between the measured drive and that of the model, over the rms of the measured one.
double difference(const sim::Model& model, const History& history, const std::vector<double>& measured,
                  bool phase_is_sought) {
  const std::vector<double> times = times_at(history.sample_rate, measured.size());
  const Eigen::VectorXd here = centred(measured);
  Eigen::VectorXd there = centred(driven_by(model, history, times));
  if (phase_is_sought && model.excitation.is_harmonic()) {
    // The phase that brings the drive of the model nearest to the measured one.
    sim::Model quarter = model;
    quarter.excitation.phase -= 0.5 * std::numbers::pi;
    const Eigen::VectorXd beside = centred(driven_by(quarter, history, times));
    const double turn = std::atan2(beside.dot(here), there.dot(here));
    there = std::cos(turn) * there + std::sin(turn) * beside;
  }
  const double noise = identify::noise_level(measured);
  const double square = (here - there).squaredNorm() / static_cast<double>(here.size());
  return std::sqrt(std::max(0.0, square - noise * noise) / (here.squaredNorm() / static_cast<double>(here.size())));
}

std::string other_drive(const History& history, const sim::Model& model, bool phase_is_sought,
                        const core::SettingWords& words) {
  const bool base = model.excitation.moves_base();
  const std::vector<double>& measured = base ? history.y : history.force;
  constexpr std::size_t least = 8;
  if (measured.size() < least || !moves(measured)) return {};
  // An amplitude that was set is not better known than this.
  constexpr double far = 0.1;
  const double miss = difference(model, history, measured, phase_is_sought);
  if (miss <= far) return {};
  const std::string column = base ? "y" : "force";
  return "the record holds " + column + ", and it differs from the drive by " + core::percent(miss, 2) + " of " +
         column + ": if it drove the mass, " + words(core::Setting::drive, column) + "; or leave out the column";
}

}  // namespace

void refuse_other_drives(const std::vector<DataItem>& items, const std::string& key, const sim::Model& model,
                         double drive_start, const std::vector<std::string>& free,
                         std::vector<SetupFault>& faults) {
  const sim::Excitation& drive = model.excitation;
  if (drive.type == sim::ExcitationType::none) return;
  const bool phase_is_sought =
      std::ranges::any_of(free, [](const std::string& name) { return name == "phase" || name == "system.phase"; });
  for (std::size_t i = 0; i < items.size(); ++i) {
    const DataItem& item = items[i];
    if (item.is_loop()) continue;
    const std::string place = key + (items.size() > 1 ? "[" + std::to_string(i) + "]" : "");
    for (std::size_t h = 0; h < item.data.record.histories.size(); ++h) {
      if (item.drive_of(h) != nullptr) continue;
      const History& history = item.data.record.histories[h];
      const std::string name = item.file + (history.sweep.empty() ? "" : ", test '" + history.sweep + "'");
      std::string fault = other_clock(history, drive, drive_start);
      if (fault.empty()) fault = other_drive(history, model, phase_is_sought, item.words);
      if (!fault.empty()) faults.push_back({place, name + ": " + fault});
    }
  }
}

std::string idle_drive(const DataItem& item, const sim::Model& model) {
  if (!item.takes_drive_of_model() || model.excitation.type != sim::ExcitationType::none) return {};
  const std::vector<History>& histories = item.data.record.histories;
  const auto drive = [&](const std::string& column, const std::string& what) {
    return item.file + ": the file holds " + what +
           ", and nothing drives the model: " + item.words(core::Setting::drive, column);
  };
  const bool has_y = std::ranges::any_of(histories, [](const History& h) { return moves(h.y); });
  const bool has_force = std::ranges::any_of(histories, [](const History& h) { return moves(h.force); });
  if (has_y)
    return drive("y", "y, the motion of the base") +
           (has_force ? ", or " + item.words(core::Setting::drive, "force") +
                            ", if only one of the two drove the mass; or leave out y"
                      : "; 'drive: none' if y is to be ignored");
  if (has_force)
    return drive("force", "force") + "; or " + item.words(core::Setting::loop) + " for a friction loop";
  return {};
}

std::string lacking_spring(const DataItem& item, double stiffness) {
  if (stiffness != 0.0 || !item.is_motion()) return {};
  const bool has_force =
      std::ranges::any_of(item.data.record.histories, [](const History& h) { return !h.force.empty(); });
  return item.file + ": the motion of a history is simulated with a spring, and the stiffness is 0" +
         (has_force ? ": " + item.words(core::Setting::loop) +
                          " compares the force along the measured motion, and needs no spring"
                    : "");
}

namespace {

/// What the file states about its drive: y, force, none; empty: nothing.
std::string stated_drive(const Json& keys) {
  return keys.is_object() && keys.contains("drive") ? keys.at("drive").get<std::string>() : std::string();
}

/// The column that drives a history; empty: nothing of its own.
std::string driving_column(const std::string& stated, const History& history, bool is_open) {
  if (stated == "none") return {};
  if (!stated.empty() && moves(stated == "y" ? history.y : history.force)) return stated;
  return is_open && moves(history.y) && !moves(history.force) ? "y" : "";
}

/// `excitation` of a scenario with this column of the file.
Json measured_section(const DataItem& item, const std::string& column) {
  Json drive = {{"type", column == "y" ? "measured_base" : "measured_force"},
                {"file", item.file},
                {"interpolation", "cubic"},
                {"repeat", false},
                {"detrend", "none"},
                {"offset", 0.0}};
  const auto take = [&](const char* key, const char* list, const std::string& of) {
    if (item.keys.is_object() && item.keys.contains(list) && item.keys.at(list).contains(of))
      drive[key] = item.keys.at(list).at(of);
  };
  take("column", "columns", column);
  take("unit", "units", column);
  take("scale", "scale", column);
  take("time_column", "columns", "t");
  take("time_unit", "units", "t");
  for (const char* key : {"decimal", "no_header", "sample_rate"})
    if (item.keys.is_object() && item.keys.contains(key)) drive[key] = item.keys.at(key);
  return drive;
}

bool begin_together(const History& history, double drive_start) {
  return std::abs(history.start - drive_start) * history.sample_rate <= 0.5;
}

RecordDrive drive_by(const std::string& column, std::shared_ptr<const sim::SampledSignal> samples, Json section) {
  return {{.type = column == "y" ? sim::ExcitationType::base_samples : sim::ExcitationType::force_samples,
           .samples = std::move(samples)},
          std::move(section)};
}

const std::vector<double>& samples_of(const History& history, const std::string& column) {
  return column == "y" ? history.y : history.force;
}

/// The drive from the samples of the history itself: those of a test among others, or of the part that was used,
/// or with others between them that a cubic spline needs (`finer_samples.hpp`).
RecordDrive listed_drive(CheckedFile& file, const DataItem& item, const History& history,
                         const std::string& column) {
  std::vector<double> values = samples_of(history, column);
  double rate = history.sample_rate;
  if (std::optional<identify::FinerSamples> finer = identify::finer_samples(values)) {
    values = std::move(finer->values);
    rate *= finer->factor;
  }
  std::vector<double> times = times_at(rate, values.size());
  Json section = {{"type", column == "y" ? "base_table" : "force_table"},
                  {"times", times},
                  {"values", values},
                  {"interpolation", "cubic"},
                  {"repeat", false}};
  if (static_cast<double>(values.size()) > max_table) {
    section = {{"type", column == "y" ? "measured_base" : "measured_force"},
               {"interpolation", "cubic"},
               {"repeat", false}};  // scenario_text() names the file that is written with the result
    file.warnings.push_back(item.file + ": a scenario lists at most " + core::format_number(max_table) +
                            " values of a drive, and this one has " + std::to_string(values.size()) +
                            ": the text of the fitted scenario in the result names a file beside it, which is "
                            "written with fitted.yaml");
  }
  return drive_by(
      column,
      std::make_shared<const sim::SampledSignal>(std::move(times), std::move(values), sim::Interpolation::cubic),
      std::move(section));
}

/// Whether a spline through the samples of the file would miss the drive between them.
bool needs_more_samples(const History& history, const std::string& column) {
  return identify::finer_samples(samples_of(history, column)).has_value();
}

/// Warns of samples that do not show the drive between them.
void warn_of_coarse_samples(CheckedFile& file, const DataItem& item, const History& history,
                            const std::string& column) {
  constexpr double much = 0.01;
  const identify::SplineError error = identify::spline_error(samples_of(history, column));
  if (!(error.miss > much) || error.is_resolved()) return;
  file.warnings.push_back(
      item.file + ": the samples of " + column +
      " do not show the drive between them: two ways to interpolate it differ by " + core::percent(error.miss, 2) +
      " of the drive, and the drive itself may differ by more. A drive with jumps, with noise, or with less than five "
      "samples in a period does so. The motion then holds what the model does not; a higher sample rate helps");
}

/// The drive of a history of several; its samples are those of its file, if it begins with the file.
RecordDrive own_drive(CheckedFile& file, const DataItem& item, const std::string& place, const History& history,
                      const std::string& column) {
  const bool in_memory = file.data_place().texts.contains(item.file);
  if (item.data.record.histories.size() > 1 || in_memory || needs_more_samples(history, column))
    return listed_drive(file, item, history, column);
  Json section = measured_section(item, column);
  const std::size_t warned = file.warnings.size();
  std::optional<identify::MeasuredSignal> signal = read_signal(file, place, section, column);
  // The reader of the record has given the same warnings.
  file.warnings.resize(std::min(warned, file.warnings.size()));
  if (!signal || !begin_together(history, signal->times.front())) return listed_drive(file, item, history, column);
  const double start = signal->times.front();
  for (double& time : signal->times) time -= start;
  return drive_by(column,
                  std::make_shared<const sim::SampledSignal>(std::move(signal->times), std::move(signal->values),
                                                             sim::Interpolation::cubic),
                  std::move(section));
}

/// The drive of the only history as the excitation of the scenario. False: it does not begin with its file.
bool take_as_excitation(CheckedFile& file, const DataItem& item, const History& history,
                        const std::string& column) {
  const Json before = file.values().value("excitation", Json());
  const auto samples_before = file.drive;
  const double start_before = file.drive_start;
  file.values()["excitation"] = measured_section(item, column);
  read_drive(file, true);
  if (file.drive == nullptr || begin_together(history, file.drive_start)) return true;
  if (before.is_null())
    file.values().erase("excitation");
  else
    file.values()["excitation"] = before;
  file.drive = samples_before;
  file.drive_start = start_before;
  return false;
}

/// One option states the drive for all files: the others need not hold it.
void refuse_idle_statements(CheckedFile& file, const std::vector<DataItem>& items,
                            const std::vector<std::string>& places) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].is_loop() && !stated_drive(items[i].keys).empty())
      file.complain(places[i],
                    items[i].file +
                        ": 'drive' is what drove a motion, and a loop compares the force along its "
                        "measured motion",
                    "one of drive and loop");
  for (const std::string column : {"y", "force"}) {
    const auto states = [&](const DataItem& item) { return stated_drive(item.keys) == column; };
    const auto holds = [&](const DataItem& item) {
      return states(item) && std::ranges::any_of(item.data.record.histories, [&](const History& history) {
               return moves(column == "y" ? history.y : history.force);
             });
    };
    const auto first = std::ranges::find_if(items, states);
    if (first == items.end() || std::ranges::any_of(items, holds)) continue;
    file.complain(places[static_cast<std::size_t>(first - items.begin())],
                  first->file + ": 'drive: " + column + "', and no history of the file has a column " + column +
                      " that changes",
                  "a file with " + column + ", or 'excitation'");
  }
}

}  // namespace

bool leaves_drive_open(const CheckedFile& file) {
  if (file.entry("excitation") == nullptr) return true;
  return excitation_type(file.text_at("excitation", "type")) == sim::ExcitationType::base_harmonic &&
         !file.has("excitation", "amplitude");
}

void take_recorded_drives(CheckedFile& file, bool is_open) {
  const Json& analysis = file.values().at("analysis");
  std::vector<DataItem> items;
  std::vector<std::string> places;
  for (const DataFile& data : file.files) {
    const Json& list = analysis.at(data.key);
    items.push_back({data.name, list.is_array() ? list.at(data.item) : list, data.data});
    places.push_back("analysis." + data.key + (list.is_array() ? "[" + std::to_string(data.item) + "]" : ""));
  }
  refuse_idle_statements(file, items, places);
  const bool is_one = std::ranges::count(file.files, "data", &DataFile::key) == 1;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const DataItem& item = items[i];
    if (!item.is_motion()) continue;
    const std::string stated = stated_drive(item.keys);
    const std::vector<History>& histories = item.data.record.histories;
    std::vector<std::optional<RecordDrive>>& drives = file.files[i].drives;
    drives.resize(histories.size());
    for (std::size_t h = 0; h < histories.size(); ++h) {
      const std::string column = driving_column(stated, histories[h], is_open);
      // A table in memory has no name by which a scenario could find it later.
      const bool alone = is_one && histories.size() == 1 && !file.data_place().texts.contains(item.file) &&
                         file.files[i].key == "data" && is_open &&
                         excitation_type(file.text_at("excitation", "type")) != sim::ExcitationType::base_harmonic;
      if (stated == "none") {
        drives[h] = RecordDrive{{}, {{"type", "none"}}};
        file.files[i].data.record.histories[h].y.clear();
        file.files[i].data.record.histories[h].force.clear();
      } else if (std::optional<RecordDrive> after = drive_after_blow(file, file.files[i], h, column)) {
        drives[h] = std::move(after);
      } else if (!column.empty()) {
        warn_of_coarse_samples(file, item, histories[h], column);
        if (!alone || needs_more_samples(histories[h], column) ||
            !take_as_excitation(file, item, histories[h], column))
          drives[h] = own_drive(file, item, places[i], histories[h], column);
      }
    }
  }
  withdraw_idle_blow(file);
}

std::vector<std::string> undriven_warnings(const std::vector<DataItem>& items, const sim::Model& model) {
  std::vector<std::string> warnings;
  if (model.excitation.type != sim::ExcitationType::none) return warnings;
  const auto has_own = [](const DataItem& item) {
    return std::ranges::any_of(item.drives, [](const auto& own) { return own && own->drive.samples != nullptr; });
  };
  if (std::ranges::none_of(items, has_own)) return warnings;
  for (const DataItem& item : items)
    if (item.takes_drive_of_model())
      warnings.push_back(item.file +
                         ": the file holds no drive and is fitted as a free vibration, beside records with drives "
                         "of their own; 'drive: none' states that");
  return warnings;
}

namespace {

bool is_even(const std::vector<double>& times) {
  constexpr double most = 0.01;  // of the distance of samples
  const double width = times.back() / static_cast<double>(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - times[i - 1] - width) > most * width) return false;
  return true;
}

std::vector<std::string> spline_warnings(const sim::SampledSignal& samples) {
  if (!is_even(samples.times())) return {};
  const identify::SplineError error = identify::spline_error(samples.values());
  // The mean of the error is 8/15 of that half way between samples: s^2 (1 - s)^2 has the mean 1/30.
  const double mean = error.miss * 8.0 / 15.0;
  constexpr double least = 1e-5;  // 22 samples in a period
  if (!(mean > least) || !error.is_resolved()) return {};
  return {
      "cubics between the samples of the drive make it too small by " + core::percent(mean, 2) +
      " on average, and the estimates may be wrong by as much or more: give the drive more samples, by a "
      "band-limited interpolation; or state 'drive: y' or 'drive: force' for the data in place of 'excitation', "
      "which puts samples between them"};
}

}  // namespace

std::vector<std::string> drive_warnings(const std::vector<DataItem>& items, const sim::Model& model) {
  const auto& samples = model.excitation.samples;
  if (!samples || std::ranges::none_of(items, &DataItem::takes_drive_of_model)) return {};
  if (samples->interpolation() == sim::Interpolation::cubic) return spline_warnings(*samples);
  if (samples->interpolation() != sim::Interpolation::linear) return {};
  // The mean distance of a chord from a smooth curve is a twelfth of the second difference; noise also contributes
  // to it.
  const std::vector<double>& y = samples->values();
  const double noise = identify::noise_level(y);
  const double second = std::sqrt(identify::second_difference_gain) * identify::noise_level(y, 2);
  const double square_of_curve = second * second - identify::second_difference_gain * noise * noise;
  const double smooth = std::sqrt(std::max(0.0, square_of_curve)) / 12.0;
  const double mean = std::reduce(y.begin(), y.end()) / static_cast<double>(y.size());
  double square = 0.0;
  for (const double value : y) square += (value - mean) * (value - mean) / static_cast<double>(y.size());
  constexpr double least = 2e-4;
  if (!(smooth > least * std::sqrt(square))) return {};
  return {
      "straight lines between the samples of the drive miss it by " + core::percent(smooth / std::sqrt(square), 2) +
      " on average, and the estimates may be wrong by as much or more: if the drive is smooth, use interpolation: "
      "cubic"};
}

Json excitation_of(const identify::Experiment& experiment, const std::vector<DataItem>& items, const Json& shared) {
  if (!experiment.drive) return shared;
  for (const DataItem& item : items)
    for (const std::optional<RecordDrive>& own : item.drives)
      if (own && own->drive.samples == experiment.drive->samples) return own->section;
  return shared;
}

}  // namespace dualdamp::scenarios
