#pragma once
/// Measured data from a CSV file.
///
/// The first row names the columns: `name` or `name [unit]`; names t (time), Y, x (position), sweep. Comma,
/// semicolon or tab. Unknown columns are ignored with a warning. A ragged row, a field that is not a finite
/// number, a missing or repeated column, an unknown unit: `core::InputError` with file, line and column.

#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct CsvRecord {
  Record record;
  std::vector<std::string> warnings;
};

/// Columns Y and x give pairs; a single column x (with or without t) gives the extremes of a free decay.
[[nodiscard]] CsvRecord read_csv(const std::string& path);

}  // namespace dualdamp::identify
