#pragma once
/// Measured data from a CSV file.
///
/// The first row names the columns: `name` or `name [unit]`; names t (time), Y, x (position), sweep, and y, v, a,
/// force of histories, which no method reads yet. Comma, semicolon or tab; fields may be quoted; the decimal mark
/// is a point, whatever the separator, because `1,234` reads as two different numbers in different countries. A
/// byte order mark, CRLF line ends, blank lines at the end, and comment lines beginning with # above the header are
/// accepted. Unknown columns are ignored with a warning.
///
/// Errors: a ragged row, a field that is not a finite number, a missing or repeated column, an unknown unit, a unit
/// of the wrong dimension, a negative amplitude, a time that does not increase, no data, text that is not UTF-8:
/// `core::InputError` with file, line, column and source line, for the first 20 problems at once.
/// Cost: linear; more than 256 MiB, ten million lines or a thousand columns are refused.

#include <string>
#include <string_view>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct CsvRecord {
  Record record;
  std::vector<std::string> warnings;
};

/// Columns Y and x give pairs; a column x without Y (with or without t) gives the extremes of a free decay.
[[nodiscard]] CsvRecord read_csv(const std::string& path);

/// The same from text already in memory; `name` stands for the file in messages.
[[nodiscard]] CsvRecord parse_csv(std::string_view text, const std::string& name);

}  // namespace dualdamp::identify
