#pragma once
/// Decimal numbers as text: one strict grammar in, the shortest text that reads back to the same bits out.
///
/// Grammar (that of JSON):  -? (0 | [1-9][0-9]*) (. [0-9]+)? ([eE] [+-]? [0-9]+)?
/// So `5`, `-0.5`, `1e-3`, `1.0e-3` are numbers; `+1`, `010`, `.5`, `1.`, `0x10`, `nan`, `inf`, `1_000` are not,
/// and neither is a number that double precision turns into zero (`1e-400`) or infinity (`1e400`).

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::core {

struct NumberText {
  std::optional<double> value;
  std::size_t length = 0;  ///< characters of the text that belong to the number
  std::string fault;       ///< why there is no value: "has a leading zero"; reads after "the number"
};

/// The number at the beginning of `text`; the caller reads what follows it.
[[nodiscard]] NumberText read_number(std::string_view text);

/// Parses `text`, which must be a number as a whole.
[[nodiscard]] NumberText parse_number(std::string_view text);

/// Shortest text that reads back to the same bits. An exponent always comes with a point (`1.0e-05`): YAML 1.1
/// readers take `1e-05` for a word. Values that are not finite: `nan`, `inf`, `-inf`.
[[nodiscard]] std::string format_number(double value);

/// At most `digits` significant digits, for people to read.
[[nodiscard]] std::string format_number(double value, int digits);

/// "3 %" of a share of 0.03: at most `digits` significant digits, or whole percents where these have more.
[[nodiscard]] std::string percent(double share, int digits);

/// "+3 %" or "-3 %", for a change or an interval. A share of zero has a plus too.
[[nodiscard]] std::string signed_percent(double share, int digits);

/// Range of the sizes of numbers other than zero that the program computes with: their squares, and their products
/// with the constants of a rig, must be neither zero nor infinite.
inline constexpr double least_magnitude = 1e-60;
inline constexpr double most_magnitude = 1e60;
inline constexpr std::string_view magnitude_range = "1e-60 to 1e60";

}  // namespace dualdamp::core
