#pragma once
/// The fields of a CSV file as numbers: decimal numbers as programs of laboratories print them, and times of day.

#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::identify {

struct FieldNumber {
  std::optional<double> value;
  std::string fault;    ///< why there is none; reads after "the field of column x"
  std::string allowed;  ///< what would be a number
};

/// A decimal number with the decimal mark `decimal`, a point or a comma: `12.5`, `+.5`, `1e-3`, `1.0D-03` of
/// Fortran. Thousands separators are refused: 1,234 means different numbers in different countries.
[[nodiscard]] FieldNumber read_field(std::string_view text, char decimal);

/// A time stamp: days of a calendar, 0 where there is no date with the year first, and seconds since midnight.
struct Clock {
  int days = 0;
  double seconds = 0.0;
};

/// `12:30:01.25`, `2026-11-22T12:30:01.25`, `22.11.2026 12:30:01,25`; a Z or an offset behind is left out of
/// account. Nothing for other texts.
[[nodiscard]] std::optional<Clock> read_clock(std::string_view text, char decimal);

/// Does it look like a number, good or bad, or like a time: what tells rows of data from rows of words.
[[nodiscard]] bool is_like_number(std::string_view text);

/// Significant digits and the place of the last one of a decimal number, written with or without exponent.
struct Digits {
  int significant = 0;
  int decimals = 0;  ///< of the last digit: 3 means thousandths
};
[[nodiscard]] Digits digits_of(std::string_view text, char decimal = '.');

}  // namespace dualdamp::identify
