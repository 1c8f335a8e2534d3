#include "scenarios/analyses/shared/short_blows.hpp"

#include <algorithm>
#include <cmath>

#include "identify/records/short_blow.hpp"
#include "scenarios/format/excitations.hpp"

namespace dualdamp::scenarios {

namespace {

bool is_freed(const CheckedFile& file, const std::string& name) {
  const Json& analysis = file.values().at("analysis");
  if (!analysis.contains("free")) return false;
  return std::ranges::any_of(analysis.at("free"),
                             [&](const Json& free) { return free == name || free == "system." + name; });
}

/// Whether the motion after a blow does not do without its force.
bool needs_force(const CheckedFile& file, const DataFile& data) {
  const auto is_known = [&](const std::string& name) { return file.has("system", name) && !is_freed(file, name); };
  if (!is_known("mass") && !is_known("stiffness")) return true;
  return data.key == "data" && file.values().contains("initial");
}

/// The stated force at the samples of a history; empty if it has other samples, or is no force.
std::vector<double> stated_force(const CheckedFile& file, const identify::History& history) {
  const bool is_force = excitation_type(file.text_at("excitation", "type")) == sim::ExcitationType::force_samples;
  if (!is_force || file.drive == nullptr || file.drive->repeats()) return {};
  const std::size_t count = std::max({history.x.size(), history.v.size(), history.a.size()});
  const std::vector<double>& times = file.drive->times();
  const std::vector<double>& values = file.drive->values();
  if (count < 2 || times.size() < count) return {};
  constexpr double near = 0.01;  // of a sample
  const auto is_at = [&](std::size_t i) {
    const double time = history.start - file.drive_start + static_cast<double>(i) / history.sample_rate;
    return std::abs(times[i] - time) * history.sample_rate < near;
  };
  if (!is_at(0) || !is_at(1) || !is_at(count - 1)) return {};
  return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

std::optional<RecordDrive> drive_after_blow(CheckedFile& file, DataFile& data, std::size_t h,
                                            const std::string& column) {
  identify::History& history = data.data.record.histories[h];
  if (!column.empty() && column != "force") return std::nullopt;
  std::vector<double> force = column.empty() ? stated_force(file, history) : history.force;
  std::swap(history.force, force);
  const std::optional<identify::ShortBlows> found = identify::short_blows(history);
  if (found && !found->vibrations.empty() && !needs_force(file, data))
    return RecordDrive{{}, {{"type", "none"}}, true};
  if (found)
    file.warnings.push_back(data.name + ": " + (history.sweep.empty() ? "" : "test '" + history.sweep + "': ") +
                            identify::impulse_warning(history, *found));
  std::swap(history.force, force);
  return std::nullopt;
}

void withdraw_idle_blow(CheckedFile& file) {
  bool follows = false;
  for (const DataFile& data : file.files)
    for (std::size_t h = 0; h < data.data.record.histories.size(); ++h) {
      if (h >= data.drives.size() || !data.drives[h]) return;  // under the stated force
      follows = follows || data.drives[h]->follows_blow;
    }
  if (!follows || excitation_type(file.text_at("excitation", "type")) != sim::ExcitationType::force_samples) return;
  file.values().erase("excitation");
  file.drive = nullptr;
  file.drive_start = 0.0;
}

}  // namespace dualdamp::scenarios
