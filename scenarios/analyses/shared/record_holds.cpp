#include "scenarios/analyses/shared/record_holds.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/records/free_part.hpp"
#include "identify/records/short_blow.hpp"

namespace dualdamp::scenarios {

namespace {

/// The first state is that of the user: it is not moved to another sample.
std::string hold_under_initial(const identify::History& history) {
  const identify::FreePart part = identify::free_part(history);
  if (part.held == 0) return {};
  constexpr int digits = 4;
  return "the mass does not move until t = " + core::format_number(identify::end_of_hold(history, part), digits) +
         " s, and moves later although nothing drives it, and 'initial' states its first state: cut the record "
         "there, or leave out 'initial'";
}

std::string name_of(const DataItem& item, const identify::History& history) {
  return item.file + ": " + (history.sweep.empty() ? "" : "test '" + history.sweep + "': ");
}

/// Puts the free vibrations after short blows in the place of the histories that hold them, with the drive of each:
/// none.
void leave_out_blows(DataItem& item, std::vector<std::string>& warnings) {
  const auto follows = [](const std::optional<RecordDrive>& own) { return own && own->follows_blow; };
  if (std::ranges::none_of(item.drives, follows)) return;
  std::vector<identify::History> histories;
  std::vector<std::optional<RecordDrive>> drives;
  for (std::size_t h = 0; h < item.data.record.histories.size(); ++h) {
    identify::History& history = item.data.record.histories[h];
    const RecordDrive* own = item.drive_of(h);
    const std::string name = name_of(item, history);
    const std::optional<identify::ShortBlows> found =
        own != nullptr && own->follows_blow ? identify::short_blows(history) : std::nullopt;
    std::vector<std::string> done;
    if (found)
      std::ranges::move(identify::without_blows(history, *found, done), std::back_inserter(histories));
    else
      histories.push_back(std::move(history));
    drives.resize(histories.size(), own != nullptr ? std::optional(*own) : std::nullopt);
    for (const std::string& sentence : done) warnings.push_back(name + sentence);
  }
  item.data.record.histories = std::move(histories);
  item.drives = std::move(drives);
}

}  // namespace

std::vector<std::string> leave_out_holds(std::vector<DataItem>& items, const sim::Model& model,
                                         bool initial_is_known) {
  std::vector<std::string> warnings;
  for (DataItem& item : items) {
    if (!item.is_motion()) continue;
    leave_out_blows(item, warnings);
    for (std::size_t h = 0; h < item.data.record.histories.size(); ++h) {
      identify::History& history = item.data.record.histories[h];
      const RecordDrive* own = item.drive_of(h);
      if (own != nullptr && own->follows_blow) continue;
      const sim::Excitation& drive = own == nullptr ? model.excitation : own->drive;
      if (drive.type != sim::ExcitationType::none) continue;
      const std::string done = initial_is_known ? hold_under_initial(history) : identify::leave_out_hold(history);
      if (!done.empty()) warnings.push_back(name_of(item, history) + done);
    }
  }
  return warnings;
}

}  // namespace dualdamp::scenarios
