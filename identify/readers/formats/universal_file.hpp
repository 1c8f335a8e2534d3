#pragma once
/// The text of a universal file taken apart: its data sets 58 and 58b (IEEE floating point) that are time
/// responses, with the factors of the data set 164 before them. What they mean is said by the reader.
///
/// Source: uff58.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::identify::universal_file {

/// What an axis is: records 8 and 9 of the data set.
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
  double divisor = 1.0;  ///< from data set 164: value / divisor is SI
  int line = 0;          ///< of its number
  std::vector<double> times;
  std::vector<double> values;
};

/// The text begins with the mark of a data set and its number.
[[nodiscard]] bool begins_data_set(std::string_view text);

/// The time responses in their order; other functions are left out with a warning. `file` is named in messages.
/// Errors: `core::InputError` with the line, for complex numbers, a data set that ends early or goes on behind its
/// values, a number that cannot be read.
[[nodiscard]] std::vector<Function> time_responses(std::string_view text, const std::string& file,
                                                   std::vector<std::string>& warnings);

}  // namespace dualdamp::identify::universal_file
