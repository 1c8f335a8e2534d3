#pragma once
/// Splits a universal file into its data sets 58 and 58b (IEEE floating point) that are time responses, with the
/// factors of the data set 164 before them. The reader interprets them.
///
/// Source: uff58.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::identify::universal_file {

/// An axis: records 8 and 9 of the data set.
struct Axis {
  int quantity = 0;
  std::string label;
  std::string unit;
};

/// A data set 58 over time.
struct Function {
  std::string title;  ///< ID line 1
  int type = 0;
  std::string entity;
  std::string place;  ///< node and direction of the response
  std::size_t count = 0;
  bool is_double = false;
  bool is_complex = false;
  bool is_even = false;
  double start = 0.0;
  double step = 0.0;
  Axis abscissa;
  Axis ordinate;
  std::optional<double> divisor;  ///< from data set 164: value / divisor is SI. None: the file states no unit
  int line = 0;                   ///< of the number of the data set
  std::vector<double> times;
  std::vector<double> values;
};

/// Whether the text begins with the mark and the number of a data set.
[[nodiscard]] bool begins_data_set(std::string_view text);

/// Number of lines above the first data set, where a data set 58 begins within the first 200 lines, in the fixed
/// columns of the format; nothing if there is none.
[[nodiscard]] std::optional<std::size_t> lines_above_data_set(std::string_view text);

/// The time responses in the order of the file; other functions are left out with a warning. `file`: its name in
/// messages. Errors: `core::InputError` with the line, for complex numbers, a data set with fewer or more values
/// than it states, a number that cannot be read.
[[nodiscard]] std::vector<Function> time_responses(std::string_view text, const std::string& file,
                                                   std::vector<std::string>& warnings);

}  // namespace dualdamp::identify::universal_file
