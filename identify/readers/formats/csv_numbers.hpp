#pragma once
/// Numbers from the fields of a CSV file: decimal numbers as laboratory programs print them, and times of day.

#include <optional>
#include <string_view>

namespace dualdamp::identify {

struct FieldNumber {
  std::optional<double> value;
  std::string_view fault;    ///< why there is no value; continues "the field of column x"
  std::string_view allowed;  ///< how a number is written
  bool has_comma = false;    ///< it would be a number if the decimal mark were a comma
};

/// A decimal number with the decimal mark `decimal`, a point or a comma: `12.5`, `+.5`, `1e-3`, `1.0D-03` of
/// Fortran. Thousands separators are refused: 1,234 means different numbers in different countries.
[[nodiscard]] FieldNumber read_field(std::string_view text, char decimal);

/// Whether a field says that nothing was measured: it is empty, NaN, or a word of pandas, Python or R for no value.
[[nodiscard]] bool is_unmeasured(std::string_view text);

/// A time stamp: days since 1970 (0 unless there is a date with the year first) and seconds since midnight.
struct Clock {
  int days = 0;
  double seconds = 0.0;
};

/// `12:30:01.25`, `2026-11-22T12:30:01.25`, `22.11.2026 12:30:01,25`. A Z or an offset at the end is ignored.
/// Nothing for other texts.
[[nodiscard]] std::optional<Clock> read_clock(std::string_view text, char decimal);

/// Whether the text looks like a number, valid or not, or like a time. Distinguishes rows of data from rows of
/// words.
[[nodiscard]] bool is_like_number(std::string_view text);

/// The number of significant digits of a decimal number, and the position of the last one.
struct Digits {
  int significant = 0;
  int decimals = 0;  ///< position of the last digit: 3 means thousandths
};
[[nodiscard]] Digits digits_of(std::string_view text, char decimal = '.');

}  // namespace dualdamp::identify
