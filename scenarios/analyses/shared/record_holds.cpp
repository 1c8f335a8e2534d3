#include "scenarios/analyses/shared/record_holds.hpp"

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

/// `name`: of the history in warnings.
void leave_out_blow(identify::History& history, const std::string& name, std::vector<std::string>& warnings) {
  const std::optional<identify::ShortBlow> blow = identify::short_blow(history);
  if (!blow) return;
  for (const std::string& done : identify::leave_out_short_blow(history, *blow)) warnings.push_back(name + done);
}

}  // namespace

std::vector<std::string> leave_out_holds(std::vector<DataItem>& items, const sim::Model& model,
                                         bool initial_is_known) {
  std::vector<std::string> warnings;
  for (DataItem& item : items) {
    if (!item.is_motion()) continue;
    for (std::size_t h = 0; h < item.data.record.histories.size(); ++h) {
      identify::History& history = item.data.record.histories[h];
      const RecordDrive* own = item.drive_of(h);
      const std::string name = item.file + ": " + (history.sweep.empty() ? "" : "test '" + history.sweep + "': ");
      if (own != nullptr && own->follows_blow) {
        leave_out_blow(history, name, warnings);
        continue;
      }
      const sim::Excitation& drive = own == nullptr ? model.excitation : own->drive;
      if (drive.type != sim::ExcitationType::none) continue;
      const std::string done = initial_is_known ? hold_under_initial(history) : identify::leave_out_hold(history);
      if (!done.empty()) warnings.push_back(name + done);
    }
  }
  return warnings;
}

}  // namespace dualdamp::scenarios
