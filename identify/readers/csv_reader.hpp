#pragma once
/// Columns of a CSV file.
///
/// The first row names the columns: `name`, `name [unit]` or `name (unit)`. Comma, semicolon or tab; fields may be
/// quoted; the decimal mark is a point, whatever the separator, because `1,234` reads as two different numbers in
/// different countries. A byte order mark, LF, CRLF or CR line ends, a first line `sep=;`, blank lines at the end,
/// and comment lines beginning with # above the header are accepted. Unknown columns are ignored with a warning.
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
[[nodiscard]] DataTable parse_csv(std::string_view text, const std::string& file, const ReadOptions& options,
                                  Problems& problems, std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
