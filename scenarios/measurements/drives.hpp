#pragma once
/// Drives that a scenario takes from a file or lists itself, and signals of data files.

#include <optional>
#include <string>
#include <string_view>

#include "scenarios/format/checked_file.hpp"
#include "sim/excitation.hpp"

namespace dualdamp::scenarios {

/// The chirp of the section of an excitation with a frequency sweep.
[[nodiscard]] sim::Chirp chirp_of(const Json& section);

/// The signal that the section at `path` names by the keys of `signal_file()`; `column`: y, force or x. Nothing,
/// and problems in the file, if it cannot be read.
[[nodiscard]] std::optional<identify::MeasuredSignal> read_signal(CheckedFile& file, const std::string& path,
                                                                  const Json& section, std::string_view column);

/// Puts the samples of a measured or listed excitation into `file.drive`. `is_read`: its file was read as a record,
/// and what its reader warns of is known.
void read_drive(CheckedFile& file, bool is_read = false);

/// Checks whether the drive lasts as long as the motion, and the number of pieces this needs. `duration` [s].
void check_drive(CheckedFile& file, double duration);

}  // namespace dualdamp::scenarios
