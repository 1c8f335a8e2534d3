#include "scenarios/analyses/shared/record_zeros.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "identify/records/derived_records.hpp"
#include "identify/records/sensor_zero.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::scenarios {

namespace {

/// Mean and amplitude of the drive of the model [m]; nothing if it does not oscillate or the spring is unknown.
std::optional<std::pair<double, double>> swing_of(const sim::Model& model) {
  const sim::Excitation& drive = model.excitation;
  double rest = drive.offset;
  double amplitude = drive.amplitude;
  if (drive.samples) {
    const std::vector<double>& y = drive.samples->values();
    rest = std::reduce(y.begin(), y.end()) / static_cast<double>(y.size());
    double square = 0.0;
    for (const double value : y) square += (value - rest) * (value - rest) / static_cast<double>(y.size());
    amplitude = std::sqrt(2.0 * square);
  } else if (!drive.is_harmonic() && !drive.is_chirp()) {
    return std::nullopt;
  }
  const double spring = drive.moves_base() ? 1.0 : model.oscillator.stiffness;
  if (!(spring > 0.0)) return std::nullopt;
  return std::pair{rest / spring, amplitude / spring};
}

std::string remove_zero_of(identify::History& history, const sim::Model& model) {
  if (history.has_drive()) return identify::remove_zero(history, model.oscillator.stiffness);
  if (model.excitation.type == sim::ExcitationType::none) {
    identify::DerivedDecay decay = identify::decay_of(history);
    return identify::remove_zero(history, decay.record);
  }
  const auto swing = swing_of(model);
  return swing ? identify::remove_zero(history, swing->first, swing->second) : std::string();
}

}  // namespace

std::vector<std::string> remove_zeros(std::vector<DataItem>& items, const sim::Model& model, const Sought& sought) {
  std::vector<std::string> warnings;
  // The numbers of records are those of experiments, which are not made yet.
  if (std::ranges::any_of(sought.free, [](const std::string& name) { return name.starts_with("offset"); }))
    return {};
  for (DataItem& item : items)
    for (std::size_t h = 0; h < item.data.record.histories.size(); ++h) {
      identify::History& history = item.data.record.histories[h];
      if (history.x.empty()) continue;
      sim::Model there = model;
      if (const RecordDrive* own = item.drive_of(h)) there.excitation = own->drive;
      const std::string done = remove_zero_of(history, there);
      if (done.empty()) continue;
      item.zeroed.push_back(h);
      warnings.push_back(item.file + ": " + (history.sweep.empty() ? "" : "test '" + history.sweep + "': ") + done +
                         "; the rest is fitted as offset");
    }
  return warnings;
}

}  // namespace dualdamp::scenarios
