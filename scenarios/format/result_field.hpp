#pragma once
/// A number that a result may hold. The reference page lists these fields, each `expect` is checked against them
/// before the run, and the printed summary uses their names and units.

#include <string>

namespace dualdamp::scenarios {

/// In place of the unit of an amplitude of the drive, which the scenario determines.
inline constexpr const char* unit_of_drive = "m or N";

struct ResultField {
  std::string path;  ///< into the result, with `[]` for any index
  std::string unit;  ///< SI; "1" for a plain number, empty for what is no number; or `unit_of_drive`
  std::string meaning;
  /// Read by other analyses only, such as the text of a scenario: not printed, and in no table of a sweep.
  bool is_for_programs = false;
};

}  // namespace dualdamp::scenarios
