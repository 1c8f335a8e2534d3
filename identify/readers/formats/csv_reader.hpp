#pragma once
/// Columns of a CSV file.
///
/// A row names the columns: `name`, `name [unit]`, `name (unit)`, `name_unit`; units may be in a row of their own
/// below it. Separators are commas, semicolons, tabs or blanks. Fields may be quoted. The decimal mark is a point
/// unless the caller states a comma; it is not guessed, because `1,234` means two different numbers in different
/// countries. Lines above the header, comments, blank lines and a first line `sep=;` are skipped. A repeated header
/// begins a new test. Times may be numbers or time stamps. Unknown columns are ignored with a warning.
///
/// Errors: added to `problems`, with line, column and source line: a row with a wrong number of fields, a field
/// that is not a finite number, a missing or repeated column, an unknown unit, a unit of the wrong dimension, no
/// data, text that is not UTF-8.

#include <string>
#include <string_view>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// `text` must outlive the table, whose messages quote lines of it.
[[nodiscard]] DataTable parse_csv(std::string_view text, const ReadOptions& options, Problems& problems,
                                  std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
