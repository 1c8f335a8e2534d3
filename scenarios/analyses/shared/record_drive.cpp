#include "scenarios/analyses/shared/record_drive.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers.hpp"
#include "identify/fit/drive_values.hpp"
#include "identify/statistics/noise_level.hpp"
#include "scenarios/measurements/drives.hpp"

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

/// Times of the samples on the clock of the motion [s].
std::vector<double> times_of(const History& history, std::size_t count) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = static_cast<double>(i) / history.sample_rate;
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
  const std::vector<double> times = times_of(history, measured.size());
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

std::string other_drive(const DataItem& item, const History& history, const sim::Model& model,
                        bool phase_is_sought) {
  const bool base = model.excitation.moves_base();
  const std::vector<double>& measured = base ? history.y : history.force;
  constexpr std::size_t least = 8;
  if (measured.size() < least || !moves(measured)) return {};
  // An amplitude that was set is not better known than this.
  constexpr double far = 0.1;
  const double miss = difference(model, history, measured, phase_is_sought);
  if (miss <= far) return {};
  const std::string column = base ? "y" : "force";
  return "the record holds " + column + ", and it differs from the drive by " +
         core::format_number(100.0 * miss, 2) + " % of " + column + ": 'excitation: {type: measured_" +
         (base ? "base" : "force") + ", file: " + item.file + ", column: " + column +
         ", interpolation: cubic}', on the command line --set excitation='{...}', or leave out the column";
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
    if (item.keys.is_object() && item.keys.value("loop", false)) continue;
    const std::string place = key + (items.size() > 1 ? "[" + std::to_string(i) + "]" : "");
    for (const History& history : item.data.record.histories) {
      const std::string name = item.file + (history.sweep.empty() ? "" : ", test '" + history.sweep + "'");
      std::string fault = other_clock(history, drive, drive_start);
      if (fault.empty()) fault = other_drive(item, history, model, phase_is_sought);
      if (!fault.empty()) faults.push_back({place, name + ": " + fault});
    }
  }
}

std::string idle_drive(const DataItem& item, const sim::Model& model) {
  if (item.is_loop() || model.excitation.type != sim::ExcitationType::none) return {};
  const std::vector<History>& histories = item.data.record.histories;
  const auto drive = [&](const char* type, const char* column, const std::string& what) {
    return item.file + ": the file holds " + what + ", and nothing drives the model: 'excitation: {type: " + type +
           ", file: " + item.file + ", column: " + column +
           ", interpolation: cubic}', on the command line --set excitation='{...}'";
  };
  const bool has_y = std::ranges::any_of(histories, [](const History& h) { return moves(h.y); });
  const bool has_force = std::ranges::any_of(histories, [](const History& h) { return moves(h.force); });
  if ((has_y || has_force) && histories.size() > 1)
    return item.file + ": each of its " + std::to_string(histories.size()) + " tests holds a drive of its own, " +
           (has_y ? "y" : "force") + ", and a fit has one: keep one test in the file";
  if (has_y)
    return drive("measured_base", "y", "y, the motion of the base") + (has_force ? "; or leave out y" : "");
  if (has_force) return drive("measured_force", "force", "force") + "; or --loop for a friction loop";
  return {};
}

void take_recorded_drive(CheckedFile& file) {
  const std::vector<DataItem> items = items_of(file.values().at("analysis"), file.files, "data");
  if (items.size() != 1 || !items.front().is_motion()) return;
  const DataItem& item = items.front();
  const std::vector<History>& histories = item.data.record.histories;
  if (histories.size() != 1 || !moves(histories.front().y) || moves(histories.front().force)) return;
  Json drive = {{"type", "measured_base"}, {"file", item.file}, {"interpolation", "cubic"},
                {"repeat", false},         {"detrend", "none"}, {"offset", 0.0}};
  const auto take = [&](const char* key, const char* list, const char* column) {
    if (item.keys.is_object() && item.keys.contains(list) && item.keys.at(list).contains(column))
      drive[key] = item.keys.at(list).at(column);
  };
  take("column", "columns", "y");
  take("unit", "units", "y");
  take("scale", "scale", "y");
  take("time_column", "columns", "t");
  take("time_unit", "units", "t");
  for (const char* key : {"decimal", "no_header"})
    if (item.keys.is_object() && item.keys.contains(key)) drive[key] = item.keys.at(key);
  file.values()["excitation"] = std::move(drive);
  read_drive(file);
  const History& history = histories.front();
  if (file.drive != nullptr && std::abs(history.start - file.drive_start) * history.sample_rate > 0.5)
    file.complain(
        "analysis.data",
        item.file + ": only the rows from t = " + seconds(history.start) +
            " on are used, because the times have gaps, and y drives from t = " + seconds(file.drive_start) + " on",
        "a file that holds this part alone");
}

}  // namespace dualdamp::scenarios
