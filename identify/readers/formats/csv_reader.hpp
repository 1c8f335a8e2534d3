#pragma once
/// Columns of a CSV file.
///
/// A row names the columns: `name`, `name [unit]`, `name (unit)`, `name_unit`; units may stand in a row of their
/// own below it. Separators are commas, semicolons, tabs or blanks; fields may be quoted; the decimal mark is what
/// the caller says, a point unless told otherwise, because `1,234` reads as two different numbers in different
/// countries. Lines above the header, comments, blank lines and a first line `sep=;` are left out; a header that
/// stands there again begins a new test. Times may be numbers or time stamps. Unknown columns are ignored with a
/// warning.
///
/// Errors: a ragged row, a field that is not a finite number, a missing or repeated column, an unknown unit, a unit
/// of the wrong dimension, no data, text that is not UTF-8: to `problems`, with line, column and source line.

#include <string>
#include <string_view>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// `text` must outlive the table, which shows lines of it in messages.
[[nodiscard]] DataTable parse_csv(std::string_view text, const ReadOptions& options, Problems& problems,
                                  std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
